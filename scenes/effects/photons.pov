// Photons: a polished ring throws a caustic on the table.
#version 3.7;
global_settings {
  assumed_gamma 1.0
  photons { count 40000 }
}

camera { location <0.3, 5.6, -5.4> look_at <0.2, 0, 0.1> angle 35 }
light_source { <-4.4, 6.2, 3.4> color srgb <1, 0.92, 0.78> * 1.05 }
background { color srgb <0.42, 0.36, 0.38> }

plane {
  y, 0
  pigment { color srgb <0.82, 0.76, 0.70> }
  finish { ambient 0.08 diffuse 0.7 }
}
difference {
  cylinder { 0, 0.6 * y, 1.45 }
  cylinder { -0.1 * y, 0.7 * y, 1.38 }
  pigment { color srgb <0.96, 0.78, 0.42> }
  finish { ambient 0.04 diffuse 0.2 specular 0.6 roughness 0.01 reflection { 0.75 metallic } }
  photons { target reflection on refraction off }
}
