// Hard: a medium so thin that each sample adds 1e-7, summed over a way of 1e4.
#version 3.7;
global_settings { assumed_gamma 1.0 }
#default { finish { ambient 0.1 diffuse 0.7 } }

camera { location <0, 2, -10> look_at <0, 1.5, 0> angle 50 }
light_source { <-50, 80, -20> color srgb <1, 0.96, 0.9> }
background { color rgb <0.02, 0.03, 0.05> }

sphere {
  0, 1e4
  hollow
  pigment { color rgbt 1 }
  interior {
    media {
      method 3 samples 4, 4
      scattering { 1, rgb <2, 3, 5> * 1e-6 extinction 0.5 }
      absorption rgb 1e-7
      emission rgb <1, 0.6, 0.3> * 1e-6
      density { spherical scale 1e4 color_map { [0 rgb 0.2] [1 rgb 1] } }
    }
  }
}
plane { y, 0 hollow pigment { checker srgb <0.9, 0.86, 0.8> srgb <0.45, 0.55, 0.62> scale 3 } }
sphere { <-1.6, 1.2, 0>, 1.2 hollow pigment { color srgb <0.86, 0.36, 0.3> } }
cylinder { <2, 0, 60>, <2, 30, 60>, 3 hollow pigment { color srgb <0.3, 0.6, 0.5> } }
