// fig5b.pov - [Motegi Fig. 5]: the isotropic distribution of Fig. 4 and 6.

#version 3.7;
#declare Alpha_X = 0.1;
#declare Alpha_Y = 0.1;
#include "ndf_plot.inc"
