// Area light: soft shadows from a regular grid of lamps, without jitter.
#version 3.7;
global_settings { assumed_gamma 1.0 }
#default { finish { ambient 0.1 diffuse 0.75 } }

camera { location <0.4, 4.2, -8> look_at <0.2, 0.55, 0> angle 36 }
light_source {
  <-7, 8, -2> color srgb <1, 0.95, 0.86> * 1.15
  area_light 4 * x, 4 * z, 9, 9 adaptive 1
}

plane { y, 0 pigment { color srgb <0.93, 0.89, 0.82> } }
torus {
  0.75, 0.2
  pigment { color srgb <0.88, 0.38, 0.28> }
  rotate 90 * x
  rotate -35 * y
  translate <-1.3, 0.95, 0.3>
}
cylinder { <0.35, 0, 0.9>, <0.35, 1.7, 0.9>, 0.22 pigment { color srgb <0.96, 0.76, 0.34> } }
sphere { <1.35, 0.55, -0.4>, 0.55 pigment { color srgb <0.22, 0.54, 0.60> } }
