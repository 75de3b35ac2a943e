// teapot8.pov - [Okumura Fig. 8]: the teapot on a car's roof that drives down a street, one frame.  street.sh makes what
// it asks for: street_001.exr, ..., by street.pov, and street_001.pe.exr, ...:
//
//     prefenv bake street_%03d.exr --frames 1-48 -o street_%03d.pe.exr --method layers
//     povray-prefenv +Iteapot8.pov +Oteapot8_.png +KFI1 +KFF695 +SF1 +EF48 ...

#version unofficial 3.7;
#declare Street_Frame = concat("street_", str(frame_number, -3, 0));
#declare Environment_File = concat(Street_Frame, ".exr");
#declare Frame = transform { scale <-1, 1, 1> rotate -90*y } // we look ahead
#declare View_Angle = 65;
#declare Lower = function { y < 3.15 / 2 };
#macro Teapot_Reflection()
  reflection {
    1
    prefiltered_environment {
      exr concat(Street_Frame, ".pe.exr")
      lambda 1, 0.1 function { Lower(x, y, z) }
      transform Frame
    }
  }
#end
#include "teapot_scene.inc"
