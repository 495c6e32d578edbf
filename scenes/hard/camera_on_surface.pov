// Hard: the camera lies exactly in a plane and on the end of a cone: rays begin on what they hit.
#version 3.7;
global_settings { assumed_gamma 1.0 }
#default { finish { ambient 0.15 diffuse 0.75 } }

camera { location <0, 0, -5> look_at <0, 0.35, 0> angle 50 }
light_source { <-5, 8, -6> color srgb <1, 0.96, 0.9> }
background { color srgb <0.6, 0.74, 0.86> }

plane { y, 0 pigment { checker srgb <0.9, 0.86, 0.8> srgb <0.45, 0.55, 0.62> } }
cone {
  <0, 0, -5>, 0, <0.4, 0.8, -3>, 0.3
  pigment { gradient y color_map { [0 srgb <0.86, 0.36, 0.3>] [1 srgb <1, 0.85, 0.7>] } scale 0.2 }
}
box { <-1.6, 0, -0.5>, <-0.6, 1, 0.5> pigment { color srgb <0.3, 0.6, 0.5> } }
sphere { <1.1, 0.7, 0>, 0.7 pigment { color srgb <0.94, 0.74, 0.36> } finish { reflection 0.3 } }
