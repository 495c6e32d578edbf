// A jittered area light in a narrow spot: its grainy soft shadow shows in one small corner only.
#version 3.7;
global_settings { assumed_gamma 1.0 }
#default { finish { ambient 0.1 diffuse 0.8 } }

camera { location <0, 4.4, -8> look_at <0, 0.25, 0> angle 37 }
light_source { <-6, 8, -7> color srgb <0.84, 0.89, 1> * 0.85 parallel point_at 0 }
// Outside the spot's cone the light is not asked for, so nothing random happens there.
light_source {
  <4.2, 5, -0.2> color srgb <1, 0.78, 0.48> * 1.5
  spotlight
  point_at <1.95, 0, -1.45>
  radius 6.5
  falloff 8
  area_light 1.2 * x, 1.2 * z, 4, 4 jitter
}

plane { y, 0 pigment { checker srgb <0.90, 0.88, 0.84> srgb <0.60, 0.68, 0.74> } }
sphere { <-1.5, 0.8, 0.6>, 0.8 pigment { color srgb <0.86, 0.40, 0.32> } }
box {
  <-0.6, 0, -0.6>, <0.6, 1.2, 0.6>
  pigment { color srgb <0.24, 0.54, 0.60> }
  rotate 25 * y
  translate <0.6, 0, 1>
}
sphere { <2.05, 0.28, -1.45>, 0.28 pigment { color srgb <0.96, 0.80, 0.42> } }
