// fig7_mask.pov - the cylinder white on black: the pixels that the table of Fig. 7 counts.

#version unofficial 3.7;
#declare Background = 0;
#macro Cylinder_Reflection()
  emission 1
#end
#include "fig7_scene.inc"
