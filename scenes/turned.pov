// turned.pov - a disc whose face was turned on a lathe: the tool went round the axis, and so does the brush.
//
// Nothing is baked beforehand: the studio.exr found along Library_Path is baked while the scene is parsed, for a
// brush that may point anywhere.  Turned_Aluminium of prefenv.inc says `direction rotate y`: at every point around the
// axis y of the texture.

#version unofficial 3.7;
#declare Prefenv_Frame = transform { scale <-1, 1, 1> rotate 200*y }
#include "prefenv.inc"
global_settings { assumed_gamma 1 }

#ifndef (Env) #declare Env = "studio.exr"; #end
camera { location <0, 3.2, -4.4> right 1.5*x up y angle 40 look_at <0, -0.05, 0> }
sky_sphere { pigment { Prefenv_Sky(Env) } }

// Face, rim, bore and the chamfers between them: all are turned about one axis.
lathe {
  linear_spline 9
  <0.35, -0.12>, <1.45, -0.12>, <1.5, -0.07>, <1.5, 0.07>, <1.45, 0.12>, <0.39, 0.12>, <0.35, 0.08>, <0.35, -0.08>,
  <0.35, -0.12>
  texture { Turned_Aluminium(Env) }
  rotate -8*x
}
