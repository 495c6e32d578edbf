// Crand: the grain of rough plaster, made of random numbers.
#version 3.7;
global_settings { assumed_gamma 1.0 }
#default { finish { ambient 0.1 diffuse 0.75 crand 0.15 } }

camera { location <0, 2.9, -7> look_at <0, 0.72, 0> angle 38 }
light_source { <-5, 8, -6> color srgb <1, 0.96, 0.90> * 1.1 parallel point_at 0 }
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

plane { y, 0 pigment { color srgb <0.84, 0.74, 0.62> } }
cylinder { 0, 1.5 * y, 0.6 pigment { color srgb <0.86, 0.42, 0.32> } translate <-1.4, 0, 0.3> }
sphere { <0.2, 0.75, 0.5>, 0.75 pigment { color srgb <0.93, 0.90, 0.84> } }
cone { <1.6, 0, -0.2>, 0.7, <1.6, 1.3, -0.2>, 0.15 pigment { color srgb <0.34, 0.54, 0.60> } }
