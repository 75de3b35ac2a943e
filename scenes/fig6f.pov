// fig6f.pov - ours, beside [Motegi Fig. 6]: the three maps around the normal, mixed linearly.

#version unofficial 3.7;
#include "prefenv.inc"
#macro Bunny_Reflection()
  reflection { 1 prefiltered_environment { exr "maps.exr" method Prefenv_Linear transform Frame } }
#end
#include "bunny_scene.inc"
