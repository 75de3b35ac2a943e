// cylinder.pov - [Motegi Fig. 7b]: a cylinder turned on a lathe.  Its grooves run round it, so it is rough along its
// axis and smooth around it: highlights are drawn out along the axis.
//
//     prefenv bake courtyard.exr -o brushed.pe.exr --alpha 0.1,0.03 --direction 0,1,0
//
// The first alpha is along the direction given, here the axis, and the second across it, along the grooves; brushed along
// y it would be --alpha 0.03,0.1.  The maps hold for this direction, however the environment is turned about y.

#version unofficial 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 0, -6> right x up y angle 30 look_at 0 }
#declare Frame = transform { scale <-1, 1, 1> rotate 210*y }
sky_sphere { pigment { prefiltered_environment { exr "courtyard.exr" transform Frame } } }
cylinder {
  -1.1*y, 1.1*y, 0.8
  open
  pigment { rgb <0.95, 0.93, 0.9> }
  finish {
    ambient 0 diffuse 0
    reflection { 1 metallic prefiltered_environment { exr "brushed.pe.exr" transform Frame } }
  }
}
