// Hard: media so dense that what comes through is exp(-1000): nothing but rounding and underflow.
#version 3.7;
global_settings { assumed_gamma 1.0 max_trace_level 8 }
#default { finish { ambient 0.1 diffuse 0.7 } }

camera { location <0.5, 2.2, -6> look_at <0, 0.8, 0> angle 42 }
light_source { <-5, 8, -6> color srgb <1, 0.96, 0.9> }
background { color srgb <0.6, 0.74, 0.86> }

plane { y, -0.001 pigment { checker srgb <0.9, 0.86, 0.8> srgb <0.45, 0.55, 0.62> } }
#macro Cloud(Place, Medium)
  sphere { 0, 1 hollow pigment { color rgbt 1 } interior { media { Medium } } translate Place }
#end
Cloud(<-1.5, 1, 0>, media { method 3 samples 3, 3 absorption rgb <500, 1000, 2000> })
Cloud(<0.9, 1, 0.6>, media { method 3 samples 3, 3 scattering { 1, rgb <300, 600, 900> extinction 1 } })
Cloud(<0, 1, -1.8>, media {
  method 3 samples 3, 3
  emission rgb <2000, 800, 100> absorption rgb 800
  density { spherical color_map { [0 rgb 0] [0.6 rgb 1e-5] [1 rgb 1] } }
})
