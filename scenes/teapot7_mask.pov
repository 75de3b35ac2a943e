// teapot7_mask.pov - the teapot white on black: the pixels that Table 4 counts.

#version unofficial 3.7;
#declare Background = 0;
#macro Teapot_Reflection()
  emission 1
#end
#include "teapot_scene.inc"
