// Hard: values from 6e4 down to 6e-8 and their negatives, which half floats just hold.
#version 3.7;
global_settings { assumed_gamma 1.0 }

camera { orthographic location <64, 48, -10> right 128 * x up 96 * y direction z }

// From left to right just below 2^16, the end of half floats, to 2^-26, a quarter of their smallest.
// Below it red and blue are negative.
#default { finish { emission 1 ambient 0 diffuse 0 } }
#for (I, 0, 63)
  #local V = pow(2, 16 - 42 * I / 63) * 0.99;
  box { <2 * I, 48, 0>, <2 * I + 2, 96, 1> pigment { color rgb <V, V * 0.7, V / 3> } }
  box { <2 * I, 0, 0>, <2 * I + 2, 48, 1> pigment { color rgb <-V, V * 0.7, -V / 3> } }
#end
