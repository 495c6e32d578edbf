// Hard: each column differs from the next by exactly the antialiasing threshold, 0.25 (+A0.25).
#version 3.7;
global_settings { assumed_gamma 1.0 }
#default { finish { emission 1 ambient 0 diffuse 0 } }

// 128 x 96 pixels are 128 x 96 units: a pixel is a square, its middle an odd multiple of a half.
camera { orthographic location <64, 48, -10> right 128 * x up 96 * y direction z }

// Red of 0, 1, 2, 1 times a step: upper half 0.25, below it by 2^-20 more on the left and less on the
// right. What is supersampled shows: each column has a greenish edge, which first samples miss.
#for (I, 0, 127)
  #local Red = abs(mod(I, 4) - 2);
  box { <I, 48, 0>, <I + 1, 96, 1> pigment { color rgb <0.25 * Red, 0, 0> } }
  #local Off = (I < 64 ? 1 : -1) * pow(2, -20);
  box { <I, 0, 0>, <I + 1, 48, 1> pigment { color rgb <(0.25 + Off) * Red, 0, 0> } }
  box { <I + 0.7, 0, -1>, <I + 1, 96, 0> pigment { color rgb <0, 0.5, 0> } }
#end
