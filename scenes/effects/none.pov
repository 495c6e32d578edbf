// The control: matt shapes in plain light, and no effect at all.
#version 3.7;
global_settings { assumed_gamma 1.0 }
#default { finish { ambient 0.1 diffuse 0.75 } }

camera { location <0, 3.0, -7.5> look_at <0, 0.75, 0> angle 38 }
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

disc { 0, y, 13 pigment { checker srgb <0.92, 0.88, 0.80> srgb <0.62, 0.68, 0.66> } }
sphere { <-1.6, 0.8, 0>, 0.8 pigment { color srgb <0.86, 0.36, 0.28> } }
cone { <0, 0, 0.6>, 0.75, <0, 1.9, 0.6>, 0 pigment { color srgb <0.96, 0.76, 0.34> } }
box {
  <-0.6, 0, -0.6>, <0.6, 1.1, 0.6>
  pigment { color srgb <0.24, 0.52, 0.60> }
  rotate 28 * y
  translate <1.6, 0, -0.2>
}
