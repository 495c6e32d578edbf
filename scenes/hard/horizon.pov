// Hard: a checker to the horizon: within a pixel its squares, and the digits of its place, run out.
#version 3.7;
global_settings { assumed_gamma 1.0 }

camera { location <0.3, 1, 0.2> look_at <0.9, 1, 10> angle 60 }
light_source { <-50, 80, -60> color rgb 1 shadowless }
sky_sphere { pigment { gradient y color_map { [0 srgb <0.97, 0.91, 0.83>] [0.4 srgb <0.4, 0.6, 0.85>] } } }

plane {
  y, 0
  pigment { checker srgb <0.95, 0.92, 0.86> srgb <0.2, 0.25, 0.32> }
  finish { ambient 0.3 diffuse 0.7 }
}
