// mirror.pov - the bunny as a plain mirror, traced: what any reflection costs without Prefenv.

#version unofficial 3.7;
#macro Bunny_Reflection()
  reflection { 1 }
#end
#include "bunny_scene.inc"
