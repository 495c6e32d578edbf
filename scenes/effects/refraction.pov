// Refraction: glass balls turn the columns behind them upside down.
#version 3.7;
global_settings { assumed_gamma 1.0 max_trace_level 10 }
#default { finish { ambient 0.1 diffuse 0.75 } }

camera { location <0, 2.2, -7> look_at <0, 0.95, 0> angle 38 }
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

disc { 0, y, 13 pigment { checker srgb <0.94, 0.91, 0.84> srgb <0.42, 0.56, 0.64> } }
#for (I, -4, 4)
  cylinder {
    <I * 0.9, 0, 3>, <I * 0.9, 2.4 - 0.05 * I * I, 3>, 0.22
    pigment { color srgb <0.88 - 0.12 * abs(I), 0.42 + 0.05 * I, 0.30 + 0.06 * abs(I)> }
  }
#end
// Spheres only: a ray that got into one gets out again, so nothing is reflected inside.
union {
  sphere { <-0.95, 1, 0.2>, 1 }
  sphere { <1.15, 0.75, -0.2>, 0.75 }
  sphere { <0.15, 0.4, -1.2>, 0.4 }
  pigment { color rgbf <0.95, 0.98, 1.0, 0.95> }
  finish { ambient 0 diffuse 0 specular 0.8 roughness 0.004 }
  interior { ior 1.5 }
}
