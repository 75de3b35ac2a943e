// fig6f.pov - ours, beside [Motegi Fig. 6]: hemispheres of hundreds of normals in the memory of 21 lat-long maps.

#version unofficial 3.7;
#include "prefenv.inc"
#macro Bunny_Reflection()
  reflection { 1 prefiltered_environment { exr "hemispheres.exr" transform Frame } }
#end
#include "bunny_scene.inc"
