// gallery.pov - the finished metals of prefenv.inc, and all that may stand around them: metal seen in metal, a
// lacquered coat, a window and a lamp with their highlights and shadows, a glass with its caustic, light between matt
// things, what mirrors alone see and what they do not.  Nothing is baked beforehand: the environment.exr found along
// Library_Path is baked while the scene is parsed, once for all textures of one roughness.
//
//     Declare=Rays=32      how many rays, about, let metal show what stands around; 0: the environment alone
//     Declare=Lamps=0      the environment alone lights the metal

#version unofficial 3.7;
#ifndef (Rays) #declare Rays = 8; #end
#ifndef (Lamps) #declare Lamps = on; #end
#declare Prefenv_Frame = transform { scale <-1, 1, 1> }
#declare Prefenv_Interreflection = Rays;
#declare Prefenv_Highlight = Lamps;
#include "prefenv.inc"

#ifndef (Env) #declare Env = "environment.exr"; #end
global_settings {
  assumed_gamma 1
  radiosity { pretrace_start 0.04 pretrace_end 0.02 count 60 nearest_count 6 error_bound 0.7 recursion_limit 1 }
  photons { spacing 0.03 }
}
camera { location <0, 6.2, -13> right 1.5*x up y angle 38 look_at <0, 0.75, 0> }
sky_sphere { pigment { Prefenv_Sky(Env) } }
#default { finish { ambient 0 diffuse 0.7 } }

// A window, an area light whose highlight has its shape, and a spotlight.
light_source {
  <-9, 11, -5>, <0.45, 0.42, 0.38>
  area_light <3, 0, 1.5>, <1.5, 2, -3>, 4, 4 area_illumination adaptive 1
  photons { reflection off refraction on }
}
light_source {
  <8, 7, -7>, <0.12, 0.2, 0.45>
  spotlight point_at <2, 0, 0> radius 14 falloff 20
  photons { reflection off refraction off }
}

// The table.
cylinder {
  <0, -0.2, 0>, 0, 6.2
  pigment {
    wood turbulence 0.1 scale 0.6 rotate <88, 0, 20>
    color_map { [0 rgb <0.42, 0.28, 0.18>] [1 rgb <0.3, 0.18, 0.1>] }
  }
}

#declare Block = superellipsoid { <0.15, 0.15> scale <1.1, 0.7, 0.8> translate 0.7*y }
#declare Wheel = superellipsoid { <1, 0.2> rotate 90*x scale <1.15, 0.4, 1.15> translate 0.4*y }
#declare Rod = superellipsoid { <1, 0.15> rotate 90*x scale <0.55, 1.1, 0.55> translate 1.1*y }

object { Block texture { Brushed_Steel(Env) } rotate -24*y translate <-3.3, 0, 1.4> }
object { Wheel texture { Turned_Aluminium(Env) } translate <-0.2, 0, 2.2> }
object { Rod texture { Turned_Copper(Env) } translate <2.6, 0, 1.6> }
torus { 0.8, 0.35 texture { Polished_Copper(Env) } translate <-1.2, 0.35, -0.9> }
sphere { <1, 0.8, -0.6>, 0.8 texture { Blasted_Titanium(Env) } }
object { Block texture { Polished_Gold(Env) } scale 0.7 rotate 30*y translate <3.7, 0, -0.7> }

// Lacquer: a clear coat, which mirrors more toward the rim, over red metal.
sphere {
  <-3.1, 0.75, -1.3>, 0.75
  texture { Prefenv_Metal(Env, <0.75, 0.12, 0.06>, <0.3, 0.3>, Prefenv_Unbrushed) }
  texture { pigment { rgbt 1 } finish { diffuse 0 reflection { 0, 1 fresnel } conserve_energy } }
  interior { ior 1.6 }
}

// Glass, which gathers the window's light on the table.
sphere {
  <-0.1, 0.55, -2.4>, 0.55
  pigment { rgbf <0.92, 1, 0.95, 1> }
  finish { diffuse 0 reflection { 0, 1 fresnel } conserve_energy }
  interior { ior 1.5 }
  photons { target reflection off refraction on collect off }
}

// A band of light that mirrors alone see, and a ball that they do not.
box { <-2, 3.6, -7>, <6, 4.2, -6.8> pigment { rgb 1 } finish { diffuse 0 emission 1 } no_image no_shadow no_radiosity }
sphere { <1.9, 0.35, -2.3>, 0.35 pigment { rgb <0.1, 0.4, 0.7> } no_reflection }
