// fig6d.pov - [Motegi Fig. 6d]: the map of the nearest of 42 normals.

#version unofficial 3.7;
#include "prefenv.inc"
#macro Bunny_Reflection()
  reflection { 1 prefiltered_environment { exr "maps.exr" method Prefenv_Nearest transform Frame } }
#end
#include "bunny_scene.inc"
