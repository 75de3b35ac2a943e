// fig4.pov - [Motegi Fig. 4]: three ways to put the maps together, side by side.

#version 3.7;
#declare Columns = 3;
#include "panels.inc"
Panel(0, "fig6d.png", "(a) nearest", "borders between the maps")
Panel(1, "fig4b.png", "(b) a = 10", "too many maps mixed")
Panel(2, "fig6e.png", "(c) a = 50", "smooth, and still sharp")
