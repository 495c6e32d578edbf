// Hard: polynomials of degree 3 to 6 with double roots and singular points, seen from afar; with Sturm=1 by `sturm`.
#version 3.7;
global_settings { assumed_gamma 1.0 }
#default { finish { ambient 0.15 diffuse 0.7 specular 0.3 } }

#ifndef (Sturm) #declare Sturm = no; #end
// From afar the coefficients are large, and what tells the roots apart lies in their last digits.
camera { location <0, 37.4, -200> look_at <0, -0.1, 0> angle 1.68 }
light_source { <-5, 8, -8> color srgb <1, 0.96, 0.9> }
background { color srgb <0.6, 0.74, 0.86> }

#macro Solver() #if (Sturm) sturm #end #end
// A drop with a cusp: 4 x^4 - 4 x^3 + y^2 + z^2 = 0.
polynomial {
  4, xyz(4, 0, 0): 4, xyz(3, 0, 0): -4, xyz(0, 2, 0): 1, xyz(0, 0, 2): 1
  Solver()
  pigment { color srgb <0.86, 0.36, 0.3> }
  scale 2 rotate <0, 25, 60> translate <-1.6, -0.4, 0>
}
// Steiner's surface, which crosses itself along three lines.
intersection {
  polynomial {
    4, xyz(2, 2, 0): 1, xyz(0, 2, 2): 1, xyz(2, 0, 2): 1, xyz(1, 1, 1): -1
    Solver()
  }
  sphere { 0, 0.6 }
  pigment { color srgb <0.94, 0.74, 0.36> }
  scale 2.2 rotate <10, 30, 0> translate <0.2, 0.8, 0>
}
// (x^2 + y^2 + z^2 - 1)^3 - x^2 z^3 - 9/80 y^2 z^3 = 0: the heart, of degree 6.
polynomial {
  6,
  xyz(6, 0, 0): 1, xyz(0, 6, 0): 1, xyz(0, 0, 6): 1,
  xyz(4, 2, 0): 3, xyz(4, 0, 2): 3, xyz(2, 4, 0): 3, xyz(0, 4, 2): 3, xyz(2, 0, 4): 3,
  xyz(0, 2, 4): 3, xyz(2, 2, 2): 6,
  xyz(4, 0, 0): -3, xyz(0, 4, 0): -3, xyz(0, 0, 4): -3,
  xyz(2, 2, 0): -6, xyz(2, 0, 2): -6, xyz(0, 2, 2): -6,
  xyz(2, 0, 0): 3, xyz(0, 2, 0): 3, xyz(0, 0, 2): 3, xyz(0, 0, 0): -1,
  xyz(2, 0, 3): -1, xyz(0, 2, 3): -0.1125
  Solver()
  pigment { color srgb <0.8, 0.3, 0.42> }
  rotate -90 * x rotate 30 * y scale 0.8 translate <2.3, 0.6, 0>
}
// Thin tori, a lathe and a prism of cubic splines: the solvers that users meet.
torus { 0.4, 0.01 Solver() pigment { color srgb <0.3, 0.3, 0.4> } rotate 70 * x translate <1.1, -0.6, 0> }
torus { 0.4, 0.39 Solver() pigment { color srgb <0.3, 0.6, 0.5> } rotate 75 * x translate <0, -1.2, 0> }
lathe {
  cubic_spline 6, <0.5, -0.4>, <0.3, 0>, <0.7, 0.3>, <0.2, 0.7>, <0.02, 1>, <0, 1.4>
  Solver()
  pigment { color srgb <0.5, 0.42, 0.62> }
  translate <2.2, -1.9, 0>
}
sor {
  5, <0, -0.3>, <0.6, 0>, <0.2, 0.5>, <0.5, 0.9>, <0, 1.3>
  Solver()
  pigment { color srgb <0.45, 0.55, 0.62> }
  translate <-1.2, -1.9, -0.5>
}
