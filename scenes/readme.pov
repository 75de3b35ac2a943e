// readme.pov - the picture of the README: the reference, and the same from prefiltered maps.

#version 3.7;
#include "fig6_numbers.inc"
#declare Columns = 2;
#declare Enlarged = 0;
#ifndef (Side) #declare Side = 360; #end
#include "panels.inc"
Panel(0, "fig6b.png", "Monte Carlo", concat(str(Reference_Samples, 0, 0), " samples at every pixel"))
Panel(1, "fig6f.png", "prefiltered", "one lookup at every pixel")
