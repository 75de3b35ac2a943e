// teapot.pov - the Utah teapot from its 32 patches, in polished metal under an environment.
//
//     awk -f scenes/patches2mesh.awk scenes/teapot.patches >teapot_mesh.inc
//     prefenv bake environment.exr -o maps.exr --alpha 0.1

#version unofficial 3.7;
#macro Teapot_Reflection()
  reflection { 1 prefiltered_environment { exr "maps.exr" transform Frame } }
#end
#include "teapot_scene.inc"
