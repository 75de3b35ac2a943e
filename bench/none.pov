// none.pov - the bunny without a reflection: the cost of finding out where it is.

#version unofficial 3.7;
#macro Bunny_Reflection()
  emission 0.5
#end
#include "bunny_scene.inc"
