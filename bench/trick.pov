// trick.pov - how POV-Ray users blur a reflection: a texture averaged over many mirrors, each with bumps of its own.
//
// Declare=Count=256: how many.  Declare=Alone=1: the bunny does not see itself, as it does not in a prefiltered
// reflection, so that the pictures may be compared.  The bumps are as strong as comes nearest to roughness 0.1.

#version unofficial 3.7;
#ifndef (Count) #declare Count = 16; #end
#ifndef (Alone) #declare Alone = 0; #end
#macro Bunny_Texture()
  texture {
    average
    texture_map {
      #local I = 0;
      #while (I < Count)
        [1
          pigment { rgb 1 }
          normal { bumps 0.27 scale 0.001 translate I * <17, 31, 53> }
          finish { ambient 0 diffuse 0 reflection { 1 } }
        ]
        #local I = I + 1;
      #end
    }
  }
  #if (Alone) no_reflection #end
#end
#include "bunny_scene.inc"

// Each level deeper would trace Count times as many rays; 2 is a mirror in a mirror.
global_settings { max_trace_level 2 }
