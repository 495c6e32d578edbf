// Media: a spotlight draws its beam in dusty air, and the balls cast their shadows through it.
#version 3.7;
global_settings { assumed_gamma 1.0 }
#default { finish { ambient 0.03 diffuse 0.8 } }

camera { location <0, 1.9, -7.5> look_at <0, 1.6, 0> angle 42 }
light_source {
  <-3.4, 5.4, 1.5> color srgb <1, 0.84, 0.60> * 1.7
  spotlight point_at <0.4, 0, 0> radius 16 falloff 20 tightness 1
}
light_source { <5, 7, -8> color srgb <0.4, 0.5, 0.8> * 0.5 media_interaction off }

media {
  method 3
  intervals 1
  samples 24, 24
  scattering { 1, rgb 0.055 extinction 0.4 }
}

plane { y, 0 pigment { color srgb <0.70, 0.66, 0.64> } }
plane { -z, -5 pigment { color srgb <0.36, 0.44, 0.62> } }
sphere { <-0.8, 1.7, 0.5>, 0.4 pigment { color srgb <0.88, 0.30, 0.24> } }
sphere { <0.45, 1.0, 0.3>, 0.45 pigment { color srgb <0.96, 0.72, 0.30> } }
sphere { <-0.45, 0.35, -0.5>, 0.35 pigment { color srgb <0.20, 0.56, 0.60> } }
