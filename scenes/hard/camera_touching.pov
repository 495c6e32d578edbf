// Hard: the camera touches a ball and a mirror from outside, which it must not see through.
#version 3.7;
global_settings { assumed_gamma 1.0 }
#default { finish { ambient 0.15 diffuse 0.75 } }

camera { location <0, 1, -5> look_at <0, 0.9, 0> angle 75 }
light_source { <-5, 8, -6> color srgb <1, 0.96, 0.9> }
background { color srgb <0.6, 0.74, 0.86> }

// Its uppermost point is the camera's place.
sphere {
  <0, 0.2, -5>, 0.8
  pigment { gradient z color_map { [0 srgb <0.86, 0.36, 0.3>] [1 srgb <1, 0.9, 0.8>] } scale 0.1 }
}
// A wall beside the camera, in whose surface it lies.
box { <0, -1, -4.9>, <0.5, 3, 2> pigment { color rgb 0.1 } finish { reflection 0.8 } }
plane { y, -0.6 pigment { checker srgb <0.9, 0.86, 0.8> srgb <0.45, 0.55, 0.62> } }
torus { 0.9, 0.3 pigment { color srgb <0.94, 0.74, 0.36> } rotate 60 * x translate <-1.2, 1, 0> }
