// fig6e.pov - [Motegi Fig. 6e]: Eq. 7 with a = 50.

#version unofficial 3.7;
#include "prefenv.inc"
#macro Bunny_Reflection()
  reflection { 1 prefiltered_environment { exr "maps.exr" method Prefenv_Weighted exponent 50 transform Frame } }
#end
#include "bunny_scene.inc"
