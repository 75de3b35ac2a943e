// bunny.pov - `make bunny`: the bunny with the maps that bunny.sh bakes.

#version unofficial 3.7;
#macro Bunny_Reflection()
  reflection { 1 metallic prefiltered_environment { exr "maps.exr" transform Frame } }
#end
#include "bunny_scene.inc"
