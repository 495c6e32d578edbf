// Hard: an isosurface whose max_gradient is a third of the true one: rays step over the surface.
#version 3.7;
global_settings { assumed_gamma 1.0 }
#default { finish { ambient 0.15 diffuse 0.75 } }

#ifndef (Gradient) #declare Gradient = 1.6; #end
camera { location <0, 2, -5> look_at <0, 0, 0> angle 38 }
light_source { <-5, 8, -6> color srgb <1, 0.96, 0.9> }
background { color srgb <0.6, 0.74, 0.86> }

isosurface {
  function { x * x + y * y + z * z - 1 + 0.2 * sin(14 * x) * sin(14 * y) * sin(14 * z) }
  contained_by { sphere { 0, 1.4 } }
  accuracy 0.001
  max_gradient Gradient
  pigment { color srgb <0.86, 0.36, 0.3> }
}
