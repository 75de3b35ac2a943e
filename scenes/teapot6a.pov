// teapot6a.pov - [Okumura Fig. 6a]: an artificial environment, hue along x, saturation along y; render with +W512 +H256.
//
// The paper's pictures of 8 bits are radiance as they are: values from 0 to 1 in steps of 1/255, by no curve.

#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location -z direction z right x up y }
#declare Hues = pigment {
  gradient x
  color_map {
    [0/6 rgb <1, 0, 0>] [1/6 rgb <1, 1, 0>] [2/6 rgb <0, 1, 0>] [3/6 rgb <0, 1, 1>]
    [4/6 rgb <0, 0, 1>] [5/6 rgb <1, 0, 1>] [6/6 rgb <1, 0, 0>]
  }
}
#declare Pattern = function { pigment { gradient y pigment_map { [0 Hues] [1 rgb 1] } } }
#declare Red = function { Pattern(x, y, z).red }
#declare Green = function { Pattern(x, y, z).green }
#declare Blue = function { Pattern(x, y, z).blue }
#include "levels.inc"
