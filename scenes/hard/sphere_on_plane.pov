// Hard: balls that touch a plane and each other in one point, lit along the plane and past them.
#version 3.7;
global_settings { assumed_gamma 1.0 }
#default { finish { ambient 0.15 diffuse 0.75 } }

camera { location <0, 0.6, -5> look_at <0, 0.5, 0> angle 40 }
// In the plane itself, and one whose rays are tangent to the balls' tops.
light_source { <-8, 0, -2> color srgb <1, 0.7, 0.4> }
light_source { <8, 1, 0> color srgb <0.4, 0.6, 1> }
light_source { <0, 9, -6> color rgb 0.5 }
background { color srgb <0.6, 0.74, 0.86> }

plane { y, 0 pigment { color srgb <0.86, 0.82, 0.76> } }
#for (I, -2, 2)
  sphere {
    <I * 1, 0.5, 0>, 0.5
    pigment { color srgb <0.9, 0.86, 0.8> }
    finish { phong 0.6 phong_size 60 }
  }
#end
// Shells that touch from inside.
sphere { <0, 1.4, 0>, 0.4 pigment { color srgb <0.8, 0.9, 1> filter 0.8 } interior { ior 1.3 } }
sphere { <0, 1.2, 0>, 0.2 pigment { color srgb <0.86, 0.36, 0.3> } }
