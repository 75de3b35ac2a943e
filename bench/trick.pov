// trick.pov - how POV-Ray users blur a reflection: a texture averaged over 16 mirrors, each with bumps of its own.

#version unofficial 3.7;
#macro Bunny_Texture()
  texture {
    average
    texture_map {
      #local I = 0;
      #while (I < 16)
        [1
          pigment { rgb 1 }
          normal { bumps 0.2 scale 0.001 translate I * <17, 31, 53> }
          finish { ambient 0 diffuse 0 reflection { 1 } }
        ]
        #local I = I + 1;
      #end
    }
  }
#end
#include "bunny_scene.inc"

// Each level deeper would trace 16 times as many rays; 2 is a mirror in a mirror.
global_settings { max_trace_level 2 }
