// fig7.pov - [Motegi Fig. 7] and ours, side by side; fig7_numbers.inc, by figures.sh, says how far from (a) each is.

#version 3.7;
#include "fig7_numbers.inc"
#declare Columns = 3;
#declare Region_Left = 400;
#declare Region_Top = 250;
#include "panels.inc"
Panel(0, "fig7a.png", "(a) reference", concat(str(Reference7_Samples, 0, 0), " samples"))
Panel(1, "fig7b.png", "(b) 42 maps, a = 50", concat("MSE ", str(Mse7_B, 0, 5)))
Panel(2, "fig7c.png", "ours: hemispheres", concat("MSE ", str(Mse7_C, 0, 5)))
