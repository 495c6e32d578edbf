// A spiral of glazed spheres round a glass orb: the showpiece.
#version 3.7;
global_settings { assumed_gamma 1.0 max_trace_level 8 }
#default { finish { ambient 0.05 diffuse 0.7 } }

camera { location <0, 5.2, -9.6> look_at <0, 0.62, 0> angle 44 }
light_source {
  <-9, 12, -5> color srgb <1, 0.94, 0.84> * 1.25
  area_light 3 * x, 3 * z, 5, 5 adaptive 1
}
light_source { <10, 7, -4> color srgb <0.50, 0.62, 0.9> * 0.5 shadowless }

sky_sphere {
  pigment {
    gradient y
    color_map {
      [0.00 srgb <0.99, 0.80, 0.60>]
      [0.20 srgb <0.86, 0.66, 0.68>]
      [0.50 srgb <0.36, 0.48, 0.72>]
      [1.00 srgb <0.12, 0.22, 0.46>]
    }
  }
}

plane {
  y, 0
  pigment { color srgb <0.30, 0.36, 0.46> }
  finish { reflection { 0.08, 0.8 fresnel on } }
  interior { ior 1.7 }
}

#declare Palette = function {
  pigment {
    gradient x
    color_map {
      [0.0 srgb <0.99, 0.84, 0.40>]
      [0.3 srgb <0.95, 0.52, 0.26>]
      [0.5 srgb <0.86, 0.28, 0.34>]
      [0.7 srgb <0.55, 0.32, 0.64>]
      [1.0 srgb <0.14, 0.58, 0.68>]
    }
  }
}

// Each sphere a golden angle on from the one before, as seeds in a sunflower.
#declare Count = 230;
#for (I, 7, Count)
  #local T = I / Count;
  #local Radius = 0.17 + 0.10 * T;
  #local Colour = Palette(0.995 * T, 0, 0);
  sphere {
    <4.7 * sqrt(T), Radius + 0.5 * pow(1 - T, 3), 0>, Radius
    pigment { color rgb <Colour.red, Colour.green, Colour.blue> }
    finish { specular 0.8 roughness 0.006 reflection { 0.03, 0.5 fresnel on } }
    interior { ior 1.5 }
    rotate 137.50776 * I * y
  }
#end

sphere {
  1.55 * y, 0.95
  pigment { color rgbf <0.96, 0.99, 1.0, 0.97> }
  finish { ambient 0 diffuse 0.02 specular 0.9 roughness 0.003 reflection { 0.02, 1 fresnel on } }
  interior { ior 1.5 }
}
