// fig6c.pov - [Motegi Fig. 6c]: the baseline, one map with the lobe as at normal incidence.

#version unofficial 3.7;
#include "prefenv.inc"
#macro Bunny_Reflection()
  reflection { 1 prefiltered_environment { exr "baseline.exr" transform Frame } }
#end
#include "bunny_scene.inc"
