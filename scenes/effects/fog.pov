// Fog: columns fade into a morning haze that thins out towards the top.
#version 3.7;
global_settings { assumed_gamma 1.0 }
#default { finish { ambient 0.1 diffuse 0.75 } }

camera { location <-0.6, 1.7, -5.6> look_at <0.6, 1.6, 6> angle 50 }
light_source { <-8, 9, -6> color srgb <1, 0.92, 0.80> * 1.2 parallel point_at 0 }
background { color srgb <0.56, 0.70, 0.84> }

fog {
  fog_type 2
  distance 11
  fog_offset 0.4
  fog_alt 0.9
  color srgb <0.94, 0.89, 0.83>
}

plane { y, 0 pigment { checker srgb <0.66, 0.58, 0.50> srgb <0.40, 0.42, 0.40> } }
#declare Column = union {
  cylinder { 0, 2.6 * y, 0.26 }
  box { <-0.4, 0, -0.4>, <0.4, 0.22, 0.4> }
  box { <-0.4, 2.6, -0.4>, <0.4, 2.85, 0.4> }
};
#for (I, 0, 7)
  object { Column translate <-2, 0, I * 2.4> pigment { color srgb <0.84, 0.40, 0.28> } }
  object { Column translate <1.9, 0, I * 2.4> pigment { color srgb <0.24, 0.48, 0.58> } }
#end
