// Alpha: a transparent background (+UA), soft edges, and petals that fade out towards their tips.
#version 3.7;
global_settings { assumed_gamma 1.0 max_trace_level 12 }
#default { finish { ambient 0.12 diffuse 0.75 } }

camera { location <0, 0, -7.6> look_at 0 angle 42 }
light_source { <-5, 7, -8> color srgb <1, 0.97, 0.92> * 1.1 }

#declare Colours = array[2] { srgb <0.90, 0.36, 0.34>, srgb <0.96, 0.66, 0.30> }
#for (I, 0, 9)
  sphere {
    0, 1
    pigment {
      gradient x
      color_map {
        [0.4 color Colours[mod(I, 2)]]
        [1.0 color Colours[mod(I, 2)] transmit 1]
      }
      scale 2
      translate -1 * x
    }
    scale <0.95, 0.32, 0.12>
    translate 1.05 * x
    rotate <18, 0, I * 36 + 9>
  }
#end
sphere {
  0, 0.55
  pigment { color srgb <0.28, 0.42, 0.52> }
  finish { specular 0.6 roughness 0.02 }
}
