// Hard: lines far thinner than a pixel before a transparent background: alpha of a sample or none.
#version 3.7;
global_settings { assumed_gamma 1.0 max_trace_level 12 }
#default { finish { ambient 0.2 diffuse 0.75 } }

camera { location <0, 0, -7> look_at 0 angle 42 }
light_source { <-5, 7, -8> color srgb <1, 0.97, 0.92> }

// From a third of a pixel down to a hundredth.
#for (I, 0, 23)
  cylinder {
    <0, 0.4, 0>, <0, 2.4, 0>, 0.008 * pow(0.86, I)
    pigment { color srgb <0.86, 0.36, 0.3> transmit 0.04 * I }
    rotate I * 15 * z
  }
#end
torus { 0.3, 0.003 rotate 90 * x pigment { color srgb <0.3, 0.42, 0.66> } }
// Nearly and quite transparent sheets.
box { <-2.6, -1.9, 0.5>, <-0.6, -0.7, 0.51> pigment { color srgb <0.3, 0.6, 0.5> transmit 0.999 } }
box { <0.6, -1.9, 0.5>, <2.6, -0.7, 0.51> pigment { color srgb <0.94, 0.74, 0.36> filter 1 } }
