// A lattice of thin rods over a fine checker: antialiased edges in every part of the image.
#version 3.7;
global_settings { assumed_gamma 1.0 }
#default { finish { ambient 0.08 diffuse 0.75 } }

camera { location <2.6, 4.4, -6.5> look_at <0, 0.55, 0> angle 46 }
light_source { <-7, 10, -5> color srgb <1, 0.95, 0.86> * 1.1 parallel point_at 0 }
light_source { <6, 5, -8> color srgb <0.5, 0.6, 0.8> * 0.35 shadowless }
background { color srgb <0.75, 0.85, 0.93> }

plane {
  y, 0
  pigment {
    checker srgb <0.95, 0.93, 0.88> srgb <0.20, 0.29, 0.40>
    scale 0.5
    rotate 15 * y
  }
}

#declare Step = 0.8;
#declare Half = 7 * Step;
#macro Rod(From, To, Radius, Colour)
  cylinder {
    From, To, Radius
    pigment { color Colour }
    finish { specular 0.5 roughness 0.02 }
  }
#end

union {
  #for (I, -7, 7)
    Rod(<I * Step, 0.7, -Half>, <I * Step, 0.7, Half>, 0.045, srgb <0.90, 0.42, 0.22>)
    Rod(<-Half, 1.1, I * Step>, <Half, 1.1, I * Step>, 0.045, srgb <0.16, 0.58, 0.60>)
    #for (K, -7, 7)
      Rod(<I * Step, 0, K * Step>, <I * Step, 1.3, K * Step>, 0.03, srgb <0.97, 0.86, 0.52>)
    #end
  #end
  rotate 27 * y
}
