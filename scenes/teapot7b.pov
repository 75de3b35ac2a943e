// teapot7b.pov - [Okumura Fig. 7b]: the multi-scale map, looked up once a point.  teapot7.inc says what may be declared,
// and Declare=Layers=0 is the paper's cube of voxels instead of our layers.

#version unofficial 3.7;
#ifndef (Layers) #declare Layers = 1; #end
#if (Layers)
  #macro Light(Name) exr concat("layers-", Name, ".exr") #end
#else
  #macro Light(Name) exr concat("voxels-", Name, ".exr") shadowless #end
#end
#include "teapot7.inc"
