// Hard: an isosurface of a function that is nearly a step: its slope is 1e6 within a millionth, else 0.
#version 3.7;
global_settings { assumed_gamma 1.0 }
#default { finish { ambient 0.15 diffuse 0.75 } }

#ifndef (Gradient) #declare Gradient = 12; #end
camera { location <0, 2, -5> look_at <0, 0, 0> angle 38 }
light_source { <-5, 8, -6> color srgb <1, 0.96, 0.9> }
background { color srgb <0.6, 0.74, 0.86> }

#declare Height = function (x, z) { 0.16 * floor(2.5 * sin(2.3 * x) * cos(1.9 * z)) }
isosurface {
  function { max(-1, min(1, 1e6 * (y - Height(x, z)))) }
  contained_by { box { <-1.6, -0.7, -1.6>, <1.6, 0.7, 1.6> } }
  accuracy 1e-5
  max_gradient Gradient
  pigment { color srgb <0.3, 0.6, 0.5> }
}
