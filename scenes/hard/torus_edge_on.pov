// Hard: rays in the plane of a torus and along faces: double and fourfold roots, hits of no depth.
#version 3.7;
global_settings { assumed_gamma 1.0 }
#default { finish { ambient 0.15 diffuse 0.75 } }

// 128 x 96 pixels are 4 x 3 units: edges at multiples of 1/64 go through the middles of pixels.
camera { orthographic location <0, 0, -6> right 4 * x up 3 * y direction z }
light_source { <-5, 8, -9> color srgb <1, 0.96, 0.9> }
background { color srgb <0.6, 0.74, 0.86> }

torus { 1.1, 0.234375 pigment { color srgb <0.94, 0.74, 0.36> } translate 0.984375 * y }
torus { 0.3, 0.3 pigment { color srgb <0.86, 0.36, 0.3> } translate <-1.2, -0.015625, 0> }
torus { 0.4, 0.000001 pigment { color srgb <0.3, 0.3, 0.4> } translate <0, 0.015625, 0> }
cylinder { <1.2, -0.2, -3>, <1.2, -0.2, 3>, 0.40625 pigment { color srgb <0.3, 0.6, 0.5> } }
// Faces along the rays, seen from the edge.
box { <-1.6, -1.2, -1>, <-0.609375, -0.796875, 1> pigment { color srgb <0.5, 0.42, 0.62> } }
disc { <0.2, -0.609375, 0>, y, 0.7 pigment { color srgb <0.2, 0.2, 0.2> } }
cone { <1.1, -1.0, 3>, 0.4, <1.1, -1.0, -3>, 0 pigment { color srgb <0.7, 0.66, 0.6> } }
