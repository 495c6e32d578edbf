// Hard: shapes scaled by 1e-4 : 1 : 1e4, so that one transformation holds eight orders of size.
#version 3.7;
global_settings { assumed_gamma 1.0 }
#default { finish { ambient 0.15 diffuse 0.75 } }

camera { location <2.4, 2.2, -6> look_at <0, 0.5, 0> angle 42 }
light_source { <-5, 8, -6> color srgb <1, 0.96, 0.9> }
background { color srgb <0.6, 0.74, 0.86> }

#declare Stretch = <1e-4, 1, 1e4>;
plane { y, 0 pigment { checker srgb <0.9, 0.86, 0.8> srgb <0.45, 0.55, 0.62> } }
// Blades that are as long as the world.
sphere { <0, 1, 0>, 0.8 scale Stretch pigment { color srgb <0.86, 0.36, 0.3> } translate -2 * x }
torus {
  0.8, 0.3 rotate 90 * z scale Stretch
  pigment { color srgb <0.94, 0.74, 0.36> } rotate 12 * y translate <0.6, 1, 0>
}
// Made small before and stretched back: 1e-4 times 1e4.
sphere {
  0, 1
  scale <1e4, 1, 1e-4> scale Stretch scale 0.7
  pigment { checker srgb <0.3, 0.6, 0.5> srgb <0.9, 0.86, 0.8> scale 0.3 }
  translate <0.6, 0.7, -1.4>
}
blob {
  threshold 0.5
  sphere { <-4e3, 0, 0>, 9e3, 1 }
  sphere { <4e3, 0.5, 0>, 9e3, 1 }
  scale <1e-4, 1e-4, 1e-4>
  pigment { color srgb <0.5, 0.42, 0.62> }
  translate <2.2, 0.7, 0>
}
