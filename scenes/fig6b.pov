// fig6b.pov - [Motegi Fig. 6b]: the single-scattering reference, by Monte Carlo at every point.

#version unofficial 3.7;
#include "prefenv.inc"
#macro Bunny_Reflection()
  #ifndef (Samples) #declare Samples = 1024; #end
  reflection {
    1
    prefiltered_environment { Environment_Image() roughness 0.1 samples Samples transform Frame }
  }
#end
#include "bunny_scene.inc"
