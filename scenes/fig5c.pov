// fig5c.pov - [Motegi Fig. 5]: the anisotropic distribution, of brushed metal.

#version 3.7;
#declare Alpha_X = 0.1;
#declare Alpha_Y = 0.03;
#include "ndf_plot.inc"
