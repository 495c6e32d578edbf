// Hard: light of 1e30 and its negative, whose products no float holds: infinities, and no numbers.
#version 3.7;
global_settings { assumed_gamma 1.0 }
#default { finish { ambient 0.1 diffuse 0.7 } }

camera { location <0.5, 2.2, -6> look_at <0, 0.8, 0> angle 42 }
light_source { <-5, 8, -6> color rgb 1 }
light_source { <0, 6, 3> color rgb 1e30 spotlight point_at <-1.6, 0, 0.8> radius 5 falloff 9 }
light_source { <3, 6, -3> color rgb -1e30 spotlight point_at <-0.4, 0, -0.6> radius 6 falloff 12 }

plane { y, 0 pigment { checker rgb <1e10, 1, 0> rgb <0.2, 1e10, 0> } }
sphere { <-1.3, 1, 0>, 1 pigment { color rgb 1e10 } finish { reflection 1e10 } }
sphere { <1.2, 0.6, 0>, 0.6 pigment { color rgb <1, 0.7, 0.3> } }
