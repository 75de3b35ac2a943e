// fig6.pov - [Motegi Fig. 6] and ours, side by side; fig6_numbers.inc, by figures.sh, says how far from (b) each is.

#version 3.7;
#include "fig6_numbers.inc"
#declare Columns = 6;
#include "panels.inc"
Panel(0, "fig6a.png", "(a) every bounce", concat(str(Traced_Samples, 0, 0), " rays a point"))
Panel(1, "fig6b.png", "(b) reference", concat(str(Reference_Samples, 0, 0), " samples"))
Panel(2, "fig6c.png", "(c) baseline", concat("MSE ", str(Mse_C, 0, 5)))
Panel(3, "fig6d.png", "(d) nearest", concat("MSE ", str(Mse_D, 0, 5)))
Panel(4, "fig6e.png", "(e) a = 50", concat("MSE ", str(Mse_E, 0, 5)))
Panel(5, "fig6f.png", "ours: hemispheres", concat("MSE ", str(Mse_F, 0, 5)))
