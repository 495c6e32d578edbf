// Hard: the camera is inside of everything: in glass within a room within fog, with no way out.
#version 3.7;
global_settings { assumed_gamma 1.0 max_trace_level 12 }
#default { finish { ambient 0.15 diffuse 0.7 } }

camera { location 0 look_at <0.2, -0.1, 1> angle 80 }
light_source { <-1.5, 1.7, -1> color srgb <1, 0.96, 0.9> }
fog { distance 12 color srgb <0.75, 0.82, 0.9> }

sphere {
  <0.1, 0, 0.1>, 0.5
  pigment { color srgb <0.95, 1, 0.98> filter 0.92 }
  finish { reflection { 0.02, 0.6 fresnel on } conserve_energy }
  interior { ior 1.45 }
}
box {
  -2, 2
  pigment { checker srgb <0.86, 0.5, 0.36> srgb <0.9, 0.86, 0.8> scale 0.5 translate 0.13 }
}
torus { 1.2, 0.2 pigment { color srgb <0.3, 0.6, 0.5> } rotate 70 * x translate 1.1 * z }
