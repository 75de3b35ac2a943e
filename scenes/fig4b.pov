// fig4b.pov - [Motegi Fig. 4b]: Eq. 7 with a = 10 mixes too many maps; the reflection is washed out.

#version unofficial 3.7;
#include "prefenv.inc"
#macro Bunny_Reflection()
  reflection { 1 prefiltered_environment { exr "maps.exr" method Prefenv_Weighted exponent 10 transform Frame } }
#end
#include "bunny_scene.inc"
