// gallery.pov - the finished metals of prefenv.inc.  Nothing is baked beforehand: the environment.exr found along
// Library_Path is baked while the scene is parsed, once for all textures of one roughness.

#version unofficial 3.7;
#declare Prefenv_Frame = transform { scale <-1, 1, 1> rotate 240*y }
#include "prefenv.inc"
global_settings { assumed_gamma 1 }

#ifndef (Env) #declare Env = "environment.exr"; #end
camera { location <0, 3.4, -13> right 1.5*x up y angle 40 look_at <0, -0.1, 0> }
sky_sphere { pigment { Prefenv_Sky(Env) } }

// The parts stand with their axis along y, turned about it and tilted towards the camera.
#macro Part(Column, Row)
  rotate <-30, 0, 0>
  translate <2.9 * (Column - 1), 1.55 - 3.1 * Row, 0>
#end
#declare Block = superellipsoid { <0.15, 0.15> scale <1.1, 0.7, 0.9> }
#declare Wheel = superellipsoid { <1, 0.2> rotate 90*x scale <1.15, 0.45, 1.15> }
#declare Rod = superellipsoid { <1, 0.15> rotate 90*x scale <0.6, 1.1, 0.6> }

object { Block texture { Brushed_Steel(Env) } rotate -14*y Part(0, 0) }
object { Wheel texture { Turned_Aluminium(Env) } rotate -6*x Part(1, 0) }
torus { 0.8, 0.35 texture { Polished_Copper(Env) } rotate -35*x Part(2, 0) }
sphere { 0, 1 texture { Blasted_Titanium(Env) } Part(0, 1) }
object { Rod texture { Turned_Copper(Env) } rotate 15*z Part(1, 1) }
object { Block texture { Polished_Gold(Env) } rotate -30*y Part(2, 1) }
