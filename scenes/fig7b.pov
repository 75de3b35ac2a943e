// fig7b.pov - [Motegi Fig. 7b]: 42 maps and Eq. 7 with a = 50.

#version unofficial 3.7;
#include "prefenv.inc"
#macro Cylinder_Reflection()
  reflection { 1 prefiltered_environment { exr "brushed42.exr" method Prefenv_Weighted exponent 50 transform Frame } }
#end
#include "fig7_scene.inc"
