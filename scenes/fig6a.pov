// fig6a.pov - [Motegi Fig. 6a]: every bounce, by rays traced from every point; Declare=Samples=N of them.

#version unofficial 3.7;
#include "prefenv.inc"
#macro Bunny_Reflection()
  #ifndef (Samples) #declare Samples = 256; #end
  reflection {
    1
    prefiltered_environment { Environment_Image() roughness 0.1 samples Samples traced transform Frame }
  }
#end
#include "bunny_scene.inc"
global_settings { max_trace_level 16 } // of light, what goes on beyond is 0.6 % (RMSE); beyond 5 it would be 1.6 %
