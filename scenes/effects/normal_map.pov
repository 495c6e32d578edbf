// Normals: the surfaces are smooth, and only their shading has bumps, ripples and dents.
#version 3.7;
global_settings { assumed_gamma 1.0 }
#default { finish { ambient 0.1 diffuse 0.75 } }

camera { location <0, 4.2, -7> look_at <0, 0.7, 0> angle 36 }
light_source { <-6, 6, -5> color srgb <1, 0.95, 0.88> * 1.1 parallel point_at 0 }

plane {
  y, 0
  pigment { color srgb <0.86, 0.80, 0.70> }
  normal { ripples 0.5 frequency 2.5 scale 0.9 translate <0, 0, 3> }
}
sphere {
  <-1.15, 1, 0>, 1
  pigment { color srgb <0.88, 0.42, 0.30> }
  normal {
    gradient y
    normal_map { [0.35 bumps 1.0 scale 0.10] [0.65 dents 1.5 scale 0.15] }
    scale 2
  }
  finish { specular 0.5 roughness 0.02 }
}
sphere {
  <1.15, 1, 0>, 1
  pigment { color srgb <0.28, 0.58, 0.64> }
  normal { quilted 1.4 control0 0.5 control1 1 scale 0.3 rotate <20, 30, 0> }
  finish { specular 0.5 roughness 0.02 }
}
