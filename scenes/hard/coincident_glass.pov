// Hard: photons through two blocks of glass with one face in common: in and out at the same depth.
#version 3.7;
global_settings { assumed_gamma 1.0 max_trace_level 12 photons { count 6000 } }
#default { finish { ambient 0.08 diffuse 0.75 } }

camera { location <1, 3.2, -6> look_at <0, 0.5, 0> angle 40 }
light_source {
  <-5, 7, -1> color srgb <1, 0.96, 0.9> * 1.1
  photons { refraction on reflection on }
}
plane { y, 0 pigment { color srgb <0.9, 0.86, 0.8> } }

#macro Block(From, To, Colour, Ior)
  box {
    From, To
    pigment { color Colour filter 0.9 }
    finish { ambient 0 diffuse 0 reflection { 0.02, 1 fresnel on } conserve_energy }
    interior { ior Ior }
    photons { target refraction on reflection on }
  }
#end
union {
  Block(<-1, 0, -0.8>, <0, 1, 0.8>, <0.7, 1, 0.9>, 1.5)
  Block(<0, 0, -0.8>, <1, 1, 0.8>, <1, 0.9, 0.6>, 1.5)  // touches the one before
  Block(<-1, 1, -0.8>, <1, 1.5, 0.8>, <0.8, 0.9, 1>, 1.33)  // lies on both
  rotate 33 * y
  translate 0.4 * y
}
