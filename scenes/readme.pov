// readme.pov - the picture of the README: the reference, and the same from prefiltered maps.

#version 3.7;
#include "fig6_numbers.inc"
#declare Columns = 2;
#declare Enlarged = 0;
#ifndef (Side) #declare Side = 360; #end
#include "panels.inc"
Panel(0, "fig6b.png", concat("Monte Carlo, ", str(Reference_Samples, 0, 0), " samples a pixel"), Time_B)
Panel(1, "fig6e.png", "prefiltered maps, a = 50", Time_E)
