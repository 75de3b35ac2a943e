// teapot7a.pov - [Okumura Fig. 7a], the truth: Phong's model, every texel of the environment a light.  teapot7.inc says
// what may be declared.

#version unofficial 3.7;
#macro Light(Name) exr concat("teapot6", Name, ".exr") samples all #end
#include "teapot7.inc"
