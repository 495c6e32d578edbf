// Hard: meshes with needles, triangles without area, faces that are there twice, edges shared by many.
#version 3.7;
global_settings { assumed_gamma 1.0 }
#default { finish { ambient 0.2 diffuse 0.75 } }

camera { location <0, 2, -6> look_at <0, 0.2, 0> angle 42 }
light_source { <-5, 8, -6> color srgb <1, 0.96, 0.9> }
background { color srgb <0.6, 0.74, 0.86> }

// A fan of needles, of which the last are 1e-9 wide.
mesh {
  #for (I, 0, 40)
    #local W = pow(10, -I / 4.5);
    triangle { <0, 1.4, 0>, <-2.2 + I * 0.03, -0.6, 0>, <-2.2 + I * 0.03 + W * 0.05, -0.6, 0> }
  #end
  // Without area: a point twice, three in a line, all the same.
  triangle { <0, 0, -1>, <0, 0, -1>, <1, 1, -1> }
  triangle { <0, 0, -1>, <0.5, 0.5, -1>, <1, 1, -1> }
  triangle { <0.5, 0.5, -1>, <0.5, 0.5, -1>, <0.5, 0.5, -1> }
  pigment { color srgb <0.86, 0.36, 0.3> }
}
triangle { <-1, 1, 0>, <1, 1, 0>, <0, 1, 0> pigment { color rgb 1 } }

// The same faces three times, once turned over, with other colours.
#declare Corners = array[4] { <0.2, -0.5, 0.4>, <2.2, -0.5, -0.4>, <2.1, 1.3, 0.1>, <0.3, 1.2, 0.6> };
mesh {
  triangle { Corners[0], Corners[1], Corners[2] }
  triangle { Corners[0], Corners[2], Corners[3] }
  triangle { Corners[2], Corners[1], Corners[0] }
  pigment { color srgb <0.3, 0.6, 0.5> }
}
mesh {
  triangle { Corners[1], Corners[2], Corners[0] }
  triangle { Corners[2], Corners[3], Corners[0] }
  pigment { color srgb <0.94, 0.74, 0.36> }
}
// Smooth ones whose normals are opposed, parallel to the face, or all but nothing.
mesh {
  smooth_triangle { <-1.2, -1, -1>, y, <0, -1, -1>, -y, <-0.6, 0.2, -1>, z }
  smooth_triangle { <0.2, -1, -1>, x, <1.4, -1, -1>, -x, <0.8, 0.2, -1>, 1e-9 * y }
  pigment { color srgb <0.5, 0.42, 0.62> }
}
mesh2 {
  vertex_vectors { 5, <-2, -1, 1>, <2, -1, 1>, <0, 1.9, 1>, <0, 1.9, 1>, <2, -1, 1> }
  face_indices { 4, <0, 1, 2>, <0, 4, 3>, <1, 4, 2>, <2, 3, 0> }
  pigment { color srgb <0.45, 0.55, 0.62> }
}
