// Hard: radiosity whose error_bound of 0.001 lets no sample serve a second point.
#version 3.7;
global_settings {
  assumed_gamma 1.0
  radiosity {
    pretrace_start 0.08 pretrace_end 0.04 count 8 nearest_count 1 error_bound 0.001
    recursion_limit 1 low_error_factor 1 minimum_reuse 0.00001 brightness 1
  }
}
#default { finish { ambient 0 diffuse 0.7 } }

camera { location <0, 1, -3.4> look_at <0, 0.9, 0> angle 52 }
box {
  <-1.5, 0, -3.5>, <1.5, 2.2, 1.5>
  pigment { gradient x color_map { [0.3 srgb <0.86, 0.36, 0.3>] [0.7 srgb <0.3, 0.6, 0.5>] } scale 3 translate -1.5 * x }
}
disc { <0, 2.19, 0>, -y, 0.5 pigment { color rgb 1 } finish { emission 6 } }
sphere { <-0.5, 0.5, 0.2>, 0.5 pigment { color srgb <0.9, 0.86, 0.8> } }
box { <0.2, 0, -0.4>, <0.9, 0.9, 0.3> pigment { color srgb <0.9, 0.86, 0.8> } rotate 14 * y }
