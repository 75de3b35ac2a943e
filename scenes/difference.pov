// difference.pov - four times how far picture.exr is from reference.exr, in levels of eight bits: [Okumura Fig. 7c].

#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location -z direction z right x up y }
#declare Picture = function { pigment { image_map { exr "picture.exr" } } }
#declare Reference = function { pigment { image_map { exr "reference.exr" } } }
#declare Red = function { 4 * abs(Picture(x, y, z).red - Reference(x, y, z).red) }
#declare Green = function { 4 * abs(Picture(x, y, z).green - Reference(x, y, z).green) }
#declare Blue = function { 4 * abs(Picture(x, y, z).blue - Reference(x, y, z).blue) }
#include "levels.inc"
