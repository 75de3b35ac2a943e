// fig7c.pov - ours, beside [Motegi Fig. 7]: as many maps as the lobe needs, mixed linearly.

#version unofficial 3.7;
#include "prefenv.inc"
#macro Cylinder_Reflection()
  reflection { 1 prefiltered_environment { exr "brushed.exr" transform Frame } }
#end
#include "fig7_scene.inc"
