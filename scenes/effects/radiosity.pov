// Radiosity: a lamp in the ceiling lights a room, whose red and green walls colour the white ones.
#version 3.7;
global_settings {
  assumed_gamma 1.0
  radiosity {
    pretrace_start 0.08
    pretrace_end 0.01
    count 120
    nearest_count 8
    error_bound 0.5
    recursion_limit 2
    brightness 1
  }
}
#default {
  pigment { color srgb <0.93, 0.91, 0.87> }
  finish { ambient 0 diffuse 0.85 }
}

camera { location <0, 1.5, -5.6> look_at <0, 1.48, 0> angle 42 }

plane { y, 0 }
plane { -y, -3 }
plane { -z, -2 }
plane { z, -6 }
plane { x, -2 pigment { color srgb <0.90, 0.34, 0.26> } }
plane { -x, -2 pigment { color srgb <0.30, 0.68, 0.62> } }
box { <-0.9, 2.97, -0.9>, <0.9, 3, 0.9> finish { emission rgb <1, 0.9, 0.76> * 12 } }

sphere { <-0.85, 0.65, 0.7>, 0.65 }
box { <-0.5, 0, -0.5>, <0.5, 1.5, 0.5> rotate 20 * y translate <0.85, 0, 0.4> }
