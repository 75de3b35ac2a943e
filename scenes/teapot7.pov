// teapot7.pov - [Okumura Fig. 7]: Phong, the multi-scale map, and four times their difference; under it, of ours.
// teapot7_numbers.inc, by teapot.sh, says how large they are.

#version 3.7;
#include "teapot7_numbers.inc"
#declare Columns = 5;
#declare Picture_Side = 512;
#declare Region_Left = 660;
#declare Region_Top = 420;
#include "panels.inc"
Panel(0, "phong-b-0.pixels.png", "(a) Phong", "every texel a light")
Panel(1, "voxels-b-0.pixels.png", "(b) 128 voxels cubed", concat("mean ", str(Mean_Voxels, 0, 2), " levels"))
Panel(2, "voxels-b-0.difference.pixels.png", "(c) difference x 4", "of (b)")
Panel(3, "layers-b-0.pixels.png", "ours: layers", concat("mean ", str(Mean_Layers, 0, 2), " levels"))
Panel(4, "layers-b-0.difference.pixels.png", "difference x 4", "of ours")
