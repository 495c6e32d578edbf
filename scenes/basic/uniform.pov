// A quilt of glazed buttons under a fine area light: every part of the image costs the same.
#version 3.7;
global_settings { assumed_gamma 1.0 max_trace_level 6 }
#default { finish { ambient 0.06 diffuse 0.75 } }

// Straight down on a pattern whose period is smaller than any section.
camera { orthographic sky z right 10.6667 * x up 8 * z location 10 * y look_at 0 }
light_source {
  <-14, 16, 11> color srgb <1, 0.96, 0.9> * 1.15
  area_light 5 * x, 5 * z, 6, 6
}

plane { y, 0 pigment { color srgb <0.94, 0.91, 0.86> } }

#declare Palette = function {
  pigment {
    gradient x
    color_map {
      [0.00 srgb <0.89, 0.33, 0.28>]
      [0.25 srgb <0.97, 0.62, 0.26>]
      [0.50 srgb <0.95, 0.84, 0.50>]
      [0.75 srgb <0.28, 0.64, 0.62>]
      [1.00 srgb <0.22, 0.36, 0.62>]
    }
  }
}

#declare Pitch = 0.5;
#for (Row, -10, 10)
  #for (Column, -12, 12)
    #local X = Pitch * (Column + 0.5 * mod(abs(Row), 2));
    #local Z = Pitch * 0.866 * Row;
    #local Place = 0.5 + 0.06 * X - 0.04 * Z + 0.16 * sin(1.1 * X + 0.4) * cos(1.3 * Z);
    #local Colour = Palette(max(0.01, min(0.99, Place)), 0, 0);
    union {
      torus { 0.16, 0.055 translate 0.07 * y }
      sphere { 0, 0.11 scale <1, 0.9, 1> translate 0.03 * y }
      pigment { color rgb <Colour.red, Colour.green, Colour.blue> }
      finish { specular 0.5 roughness 0.02 reflection 0.12 }
      translate <X, 0, Z>
    }
  #end
#end
