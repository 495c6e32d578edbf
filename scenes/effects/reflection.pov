// Reflection: two chrome spheres that mirror each other, the floor and three coloured balls.
#version 3.7;
global_settings { assumed_gamma 1.0 max_trace_level 10 }
#default { finish { ambient 0.1 diffuse 0.75 } }

camera { location <0, 2.5, -7> look_at <0, 0.8, 0> angle 38 }
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

disc { 0, y, 13 pigment { checker srgb <0.92, 0.88, 0.80> srgb <0.60, 0.38, 0.40> } }
union {
  sphere { <-1.05, 1, 0.4>, 1 }
  sphere { <1.05, 1, 0.4>, 1 }
  pigment { color srgb <0.90, 0.92, 0.95> }
  finish { ambient 0 diffuse 0.08 specular 0.8 roughness 0.004 reflection 0.82 }
}
sphere { <-0.75, 0.33, -1.3>, 0.33 pigment { color srgb <0.90, 0.35, 0.25> } }
sphere { <0.05, 0.28, -1.7>, 0.28 pigment { color srgb <0.98, 0.78, 0.30> } }
sphere { <0.85, 0.33, -1.3>, 0.33 pigment { color srgb <0.20, 0.58, 0.60> } }
