// Three glazed balls on a tiled floor: a quick first render.
#version 3.7;
global_settings { assumed_gamma 1.0 }
#default { finish { ambient 0.08 diffuse 0.75 } }

camera { location <0, 2.9, -8> look_at <0, 0.9, 0> angle 38 }
light_source { <-6, 9, -7> color srgb <1, 0.96, 0.88> parallel point_at 0 }
light_source { <8, 4, -6> color srgb <0.45, 0.55, 0.75> * 0.6 shadowless parallel point_at 0 }
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

disc { 0, y, 13 pigment { checker srgb <0.93, 0.90, 0.84> srgb <0.42, 0.54, 0.62> } }

#macro Ball(Place, Radius, Colour)
  sphere {
    Place + Radius * y, Radius
    pigment { color Colour }
    finish { specular 0.7 roughness 0.008 reflection { 0.04, 0.35 fresnel on } }
    interior { ior 1.5 }
  }
#end

Ball(<-1.75, 0, 0.3>, 0.85, srgb <0.88, 0.32, 0.24>)
Ball(<0.15, 0, 0.9>, 1.25, srgb <0.98, 0.76, 0.28>)
Ball(<1.75, 0, -0.4>, 0.7, srgb <0.20, 0.56, 0.60>)
Ball(<-0.55, 0, -1.5>, 0.38, srgb <0.52, 0.36, 0.66>)
