// teapot6b.pov - a real panorama, panorama.exr, as a camera of 8 bits would have it, in the place of [Okumura Fig. 6b];
// render with +W512 +H256.
//
// Radiance c becomes (c / (1 + c))^(1/2.2), and that is taken for radiance, as the paper takes its camera's pixels.

#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location -z direction z right x up y }
#declare Panorama = function { pigment { image_map { exr "panorama.exr" interpolate 2 } } }
#declare Curve = function(c) { pow(max(0, c) / (1 + max(0, c)), 1 / 2.2) }
#declare Red = function { Curve(Panorama(x, y, z).red) }
#declare Green = function { Curve(Panorama(x, y, z).green) }
#declare Blue = function { Curve(Panorama(x, y, z).blue) }
#include "levels.inc"
