// Isosurface: a gyroid shell, cut to a ball.
#version 3.7;
global_settings { assumed_gamma 1.0 }
#default { finish { ambient 0.1 diffuse 0.75 } }

camera { location <0, 3.0, -6.4> look_at <0, 1.0, 0> angle 38 }
light_source { <-5, 8, -6> color srgb <1, 0.95, 0.88> * 1.05 parallel point_at 0 }
light_source { <6, 3, -5> color srgb <0.5, 0.65, 0.9> * 0.5 shadowless }
sky_sphere {
  pigment {
    gradient y
    color_map {
      [0.5 srgb <0.97, 0.91, 0.83>]
      [0.7 srgb <0.60, 0.76, 0.90>]
      [1.0 srgb <0.25, 0.45, 0.75>]
    }
    scale 2
    translate -y
  }
}

plane { y, 0 pigment { color srgb <0.90, 0.86, 0.80> } }

#declare K = 5.5;
isosurface {
  function {
    abs(sin(K * x) * cos(K * y) + sin(K * y) * cos(K * z) + sin(K * z) * cos(K * x)) - 0.35
  }
  contained_by { sphere { 0, 1.2 } }
  accuracy 0.002
  max_gradient 9
  all_intersections
  pigment {
    gradient y
    color_map {
      [0.0 srgb <0.20, 0.48, 0.62>]
      [0.5 srgb <0.92, 0.72, 0.42>]
      [1.0 srgb <0.86, 0.34, 0.30>]
    }
    scale 2.5
    translate -1.25 * y
  }
  finish { specular 0.4 roughness 0.03 }
  rotate <12, 25, 8>
  translate 1.22 * y
}
