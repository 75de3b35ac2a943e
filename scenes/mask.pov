// mask.pov - the bunny white on black: the pixels that the table of Fig. 6 counts.

#version unofficial 3.7;
#declare Background = 0;
#macro Bunny_Reflection()
  emission 1
#end
#include "bunny_scene.inc"
