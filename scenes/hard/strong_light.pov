// Hard: a lamp of 1e6, one of -0.7, and one of -1e6 that takes it away again in its place.
#version 3.7;
global_settings { assumed_gamma 1.0 }
#default { finish { ambient 0.1 diffuse 0.7 } }

camera { location <0.5, 2.2, -6> look_at <0, 0.8, 0> angle 42 }
light_source { <-5, 8, -6> color rgb 1 }
light_source { <2.5, 3, -4> color rgb <0.7, 0.7, 0.4> * -1 }
light_source { <0, 6, 3> color rgb 1e6 spotlight point_at <-1.6, 0, 0.8> radius 5 falloff 9 }
light_source { <3, 6, -3> color rgb 1e6 spotlight point_at <1.3, 0, -1.4> radius 4 falloff 9 }
light_source { <3, 6, -3> color rgb -1e6 spotlight point_at <1.3, 0, -1.4> radius 4 falloff 9 }

plane { y, 0 pigment { checker srgb <0.9, 0.86, 0.8> srgb <0.45, 0.55, 0.62> } }
sphere { <-1.3, 1, 0>, 1 pigment { color srgb <0.86, 0.36, 0.3> } finish { reflection 0.3 specular 0.5 } }
sphere { <1.2, 0.6, 0>, 0.6 pigment { color srgb <0.94, 0.74, 0.36> } }
