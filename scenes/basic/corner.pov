// A glowing nebula in one corner of a quiet sky: nearly all of the cost in an eighth of the image.
#version 3.7;
global_settings { assumed_gamma 1.0 max_trace_level 5 }
#default { finish { ambient 0.04 diffuse 0.8 } }

camera { location <0, 1.2, -9> look_at <0, 1.9, 0> angle 48 }
light_source { <30, 22, -16> color srgb <1, 0.86, 0.72> * 1.2 parallel point_at 0 }

// Night sky: stars over a blue glow at the horizon.
sky_sphere {
  pigment {
    gradient y
    color_map {
      [0.00 srgb <0.52, 0.42, 0.54>]
      [0.12 srgb <0.20, 0.24, 0.44>]
      [0.50 srgb <0.03, 0.05, 0.14>]
    }
  }
  pigment {
    granite
    color_map { [0.00 rgbt <1, 1, 1, 0.1>] [0.12 rgbt 1] [1.00 rgbt 1] }
    scale 0.06
  }
}

plane {
  y, 0
  pigment {
    bozo
    turbulence 0.6
    color_map { [0 srgb <0.40, 0.33, 0.40>] [1 srgb <0.56, 0.43, 0.42>] }
    scale <2.5, 1, 0.8>
  }
}
sphere { <-2.2, 1, 1.5>, 1 pigment { color srgb <0.88, 0.50, 0.34> } }
sphere { <-0.6, 0.45, -0.8>, 0.45 pigment { color srgb <0.30, 0.60, 0.66> } }

// The costly corner: many fixed samples of a turbulent density, no jitter.
sphere {
  0, 1
  pigment { color rgbt 1 }
  hollow
  interior {
    media {
      method 3
      intervals 1
      samples 640, 640
      emission rgb <0.5, 0.42, 0.5>
      absorption 0.3
      density {
        spherical
        warp { turbulence 0.7 octaves 7 lambda 2.2 omega 0.55 }
        density_map {
          [0.00 rgb 0]
          [0.22 rgb <0.05, 0.10, 0.40>]
          [0.50 rgb <0.75, 0.28, 0.50>]
          [1.00 rgb <2.60, 1.70, 0.90>]
        }
      }
    }
  }
  scale <2.5, 2.0, 1.5>
  translate <4.75, 5.2, 3>
}
