// fig7a.pov - [Motegi Fig. 7a]: the single-scattering reference, by Monte Carlo at every point.

#version unofficial 3.7;
#include "prefenv.inc"
#macro Cylinder_Reflection()
  #ifndef (Samples) #declare Samples = 1024; #end
  reflection {
    1
    prefiltered_environment { exr "environment.exr" roughness 0.1, 0.03 samples Samples transform Frame }
  }
#end
#include "fig7_scene.inc"
