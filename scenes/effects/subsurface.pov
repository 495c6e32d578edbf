// Subsurface: wax and jade, through which the light from behind bleeds.
#version 3.7;
global_settings {
  assumed_gamma 1.0
  mm_per_unit 10
  subsurface { samples 48, 24 }
}

camera { location <0, 2.6, -7> look_at <0, 0.72, 0> angle 36 }
light_source { <4, 6, 3> color srgb <1, 0.92, 0.78> * 1.5 }
light_source { <-5, 6, -6> color srgb <0.7, 0.8, 1> * 0.5 }

plane {
  y, 0
  pigment { color srgb <0.58, 0.54, 0.54> }
  finish { ambient 0.04 diffuse 0.8 }
}
#macro Waxy(Colour, Translucency)
  pigment { color Colour }
  finish {
    ambient 0
    diffuse 0.8
    specular 0.5
    roughness 0.02
    subsurface { translucency Translucency }
  }
  interior { ior 1.3 }
#end
torus {
  0.62, 0.24
  Waxy(srgb <0.62, 0.86, 0.70>, <1.0, 2.4, 1.4>)
  rotate 90 * x
  rotate 30 * y
  translate <-0.95, 0.87, 0.1>
}
sphere { <0.95, 0.72, 0>, 0.72 Waxy(srgb <0.96, 0.76, 0.58>, <3.0, 1.6, 1.0>) }
