// Hard: all of it lies 1e7 from the origin, where a double has 9 digits left behind the point.
#version 3.7;
global_settings { assumed_gamma 1.0 }
#default { finish { ambient 0.15 diffuse 0.75 } }

#declare Far = <1e7, -1e7, 1e7>;
camera { location Far + <0.5, 2.2, -6> look_at Far + <0, 0.8, 0> angle 42 }
light_source { Far + <-5, 8, -6> color srgb <1, 0.96, 0.9> }

plane { y, 0 pigment { checker srgb <0.9, 0.86, 0.8> srgb <0.45, 0.55, 0.62> } translate Far }
sphere {
  <-1.3, 1, 0>, 1
  pigment { color srgb <0.86, 0.36, 0.3> }
  finish { reflection 0.3 }
  translate Far
}
torus {
  0.7, 0.25
  pigment { color srgb <0.94, 0.74, 0.36> }
  rotate -50 * x
  translate Far + <1.2, 0.8, 0>
}
// Not moved there, but given by numbers that lie there.
cylinder {
  Far + <0.1, 0, -1.6>, Far + <0.1, 1.2, -1.6>, 0.25
  pigment { color srgb <0.3, 0.6, 0.5> }
}
