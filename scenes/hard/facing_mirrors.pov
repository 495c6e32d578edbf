// Hard: mirrors that face each other, max_trace_level 100 and adc_bailout 0: every ray is followed.
#version 3.7;
global_settings { assumed_gamma 1.0 max_trace_level 100 adc_bailout 0 }
#default { finish { ambient 0.15 diffuse 0.75 } }

camera { location <0.3, 1.2, -3.4> look_at <-0.1, 0.9, 0> angle 55 }
light_source { <0, 3.4, -2> color srgb <1, 0.96, 0.9> }

#declare Mirror = texture { pigment { color rgb 0.01 } finish { ambient 0 diffuse 0.1 reflection 0.98 } }
plane { -z, -4 texture { Mirror } }
plane { z, -4 texture { Mirror } }
plane { y, 0 pigment { checker srgb <0.9, 0.86, 0.8> srgb <0.45, 0.55, 0.62> } }
plane { -y, -4 pigment { color srgb <0.8, 0.84, 0.9> } finish { ambient 0.5 } }
sphere { <-0.8, 0.7, 0>, 0.7 texture { Mirror } }
sphere { <0.8, 0.5, 0.4>, 0.5 pigment { color srgb <0.86, 0.36, 0.3> } }
