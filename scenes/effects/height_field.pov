// Height field: mountains from a ridged function, coloured by height.
#version 3.7;
#include "functions.inc"
global_settings { assumed_gamma 1.0 }
#default { finish { ambient 0.1 diffuse 0.85 } }

camera { location <0, 3.6, -6.5> look_at <0, 0.3, 0.4> angle 40 }
light_source { <-8, 5, -2> color srgb <1, 0.90, 0.76> * 1.2 parallel point_at 0 }
light_source { <5, 8, -6> color srgb <0.45, 0.6, 0.9> * 0.3 shadowless }
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

height_field {
  function 256, 256 {
    min(1, max(0, 0.42 * f_ridged_mf(3 * x + 1.3, 3 * y + 4.1, 0.5, 0.9, 2.1, 7, 0.9, 2, 1)))
  }
  smooth
  pigment {
    gradient y
    color_map {
      [0.00 srgb <0.24, 0.40, 0.36>]
      [0.25 srgb <0.46, 0.54, 0.36>]
      [0.45 srgb <0.62, 0.50, 0.40>]
      [0.62 srgb <0.96, 0.96, 0.98>]
    }
  }
  translate <-0.5, 0, -0.5>
  scale <11, 2, 11>
  translate 1.6 * z
}
