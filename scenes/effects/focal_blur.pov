// Focal blur: a row of balls of which only the middle one is in focus.
#version 3.7;
global_settings { assumed_gamma 1.0 }
#default { finish { ambient 0.1 diffuse 0.75 } }

camera {
  location <-2.9, 2.3, -6.4> look_at <0, 0.45, 0> angle 38
  aperture 0.5
  focal_point <0, 0.5, -0.4>
  blur_samples 37
  confidence 0.95
  variance 1 / 2000
}
light_source { <-5, 8, -6> color srgb <1, 0.96, 0.90> * 1.1 parallel point_at 0 }
sky_sphere {
  pigment {
    gradient y
    color_map {
      [0.5 srgb <0.97, 0.91, 0.83>]
      [0.7 srgb <0.60, 0.76, 0.90>]
      [1.0 srgb <0.25, 0.45, 0.75>]
    }
    scale 2
    translate -y
  }
}

disc { 0, y, 13 pigment { checker srgb <0.93, 0.90, 0.84> srgb <0.62, 0.67, 0.74> scale 0.6 } }
#declare Colours = array[5] {
  srgb <0.50, 0.36, 0.64>, srgb <0.86, 0.34, 0.30>, srgb <0.97, 0.72, 0.28>,
  srgb <0.26, 0.60, 0.52>, srgb <0.22, 0.44, 0.66>
}
#for (I, 0, 4)
  sphere {
    <(I - 2) * 1.15, 0.5, (I - 2) * 1.35>, 0.5
    pigment { color Colours[I] }
    finish { specular 0.6 roughness 0.02 }
  }
#end
