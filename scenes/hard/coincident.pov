// Hard: surfaces in the same place, of which rounding decides at every point which one is seen.
#version 3.7;
global_settings { assumed_gamma 1.0 }
#default { finish { ambient 0.15 diffuse 0.75 } }

camera { location <1.3, 3.1, -6.7> look_at <0, 0.5, 0> angle 42 }
light_source { <-5, 8, -6> color srgb <1, 0.96, 0.9> }

// Two floors at the same height.
plane { y, 0 pigment { checker srgb <0.9, 0.86, 0.8> srgb <0.8, 0.74, 0.66> } }
box {
  <-20, -1, -20> / 3, <20, 0, 20> / 3
  pigment { color srgb <0.35, 0.55, 0.68> }
  rotate 20 * y scale 3
}

// The same faces, by way of other sizes: other digits.
#declare Turn = <13, 31, 7>;
box { <-2, 0, -1>, <0, 1.6, 1> pigment { color srgb <0.86, 0.36, 0.3> } rotate Turn }
box {
  <-1, 0.4, -1> / 3, <0.8, 1.2, 1> / 3
  pigment { color srgb <0.3, 0.6, 0.5> }
  rotate Turn scale 3
}
sphere { <1.9, 0.8, 0>, 0.8 pigment { color srgb <0.94, 0.74, 0.36> } rotate 41 * y }
sphere { <1.9, 0.8, 0>, 0.8 pigment { color srgb <0.3, 0.42, 0.66> } rotate 41 * y }
difference {
  box { -0.5, 0.5 }
  box { <-0.25, -0.25, -0.5>, <0.25, 0.25, 0.5> }  // cut out with faces that coincide
  pigment { color srgb <0.7, 0.66, 0.6> }
  rotate Turn
  translate <0.6, 0.6, -2.4>
}
