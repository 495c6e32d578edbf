// Hard: all of it is 1e-6 in size, below the distances that POV-Ray calls too near to count.
#version 3.7;
global_settings { assumed_gamma 1.0 }
#default { finish { ambient 0.15 diffuse 0.75 } }

// From closer than 1e-4 nothing would be seen at all.
#declare Size = 1e-6;
camera {
  orthographic
  location <0.05, 0.04, -0.1> look_at 0
  right 5.4 * Size * x up 4.05 * Size * y
}
light_source { <-5, 8, -6> color srgb <1, 0.96, 0.9> * 0.6 }
light_source { <-2, 2, -6> * Size color srgb <1, 0.96, 0.9> * 0.6 }
background { color srgb <0.6, 0.74, 0.86> }

union {
  box {
    <-2.4, -1.1, -2>, <2.4, -1, 2>
    pigment { checker srgb <0.9, 0.86, 0.8> srgb <0.45, 0.55, 0.62> }
  }
  sphere { <-1, 0, 0>, 1 pigment { color srgb <0.86, 0.36, 0.3> } finish { reflection 0.3 } }
  torus { 0.7, 0.25 pigment { color srgb <0.94, 0.74, 0.36> } rotate -50 * x translate <1.2, -0.2, 0> }
  cylinder { <0.1, -1, -1.3>, <0.1, 0, -1.3>, 0.25 pigment { color srgb <0.3, 0.6, 0.5> } }
  triangle { <-2.4, -1, 1>, <2.4, -1, 1>, <0, 1.6, 1> pigment { color srgb <0.5, 0.42, 0.62> } }
  scale Size
}
