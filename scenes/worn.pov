// worn.pov - one metal, its roughness by a height, a pattern and letters.  Teapot and letters share one bake, made of
// environment.exr while the scene is parsed, for their roughnesses go over the same range; teapot_mesh.inc is made as
// teapot.pov says.  The sphere is brushed, three times as rough across its grooves as along them, which a file says:
//
//     prefenv bake environment.exr -o brushed.pe.exr --alpha 0.02-0.15 --aspect 0.33

#version unofficial 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 3.4, -14> right x * image_width / image_height up y angle 50 look_at <0, -0.1, 0> }
#declare Frame = transform { scale <-1, 1, 1> rotate 240*y }
sky_sphere { pigment { prefiltered_environment { exr "environment.exr" transform Frame } } }

#declare Steel = pigment { rgb <0.92, 0.9, 0.88> }

// A macro's call cannot hold braces, so the roughness is declared as a macro of its own.
#macro Metal(File)
  pigment { Steel }
  finish {
    ambient 0 diffuse 0
    reflection { 1 metallic prefiltered_environment { exr File Roughness() transform Frame } }
  }
#end

#include "teapot_mesh.inc"

// Polished by hands above, as cast below.
#macro Roughness() roughness 0.45, 0.02 function { y / 3.15 } #end
object {
  Teapot
  texture {
    Metal("environment.exr")
  }
  scale 0.85
  rotate -20*y
  translate <-3.4, -1.4, 0>
}

// Stains on brushed metal.
#macro Roughness() roughness 0.02, 0.15 pattern { wood scale 0.3 turbulence 0.1 } #end
sphere {
  0, 1.35
  texture {
    Metal("brushed.pe.exr")
    rotate <20, 30, 0>
  }
  translate <0.7, -0.2, -1>
}

// Letters polished into blasted metal.
#declare Letters = text { ttf "cyrvetic.ttf" "PREFENV", 4, 0 translate <-2.3, -0.3, -2> scale 0.7 }
#macro Roughness() roughness 0.02, 0.45 pigment { object { Letters rgb 0.65 rgb 0.02 } } #end
box {
  <-1.8, -0.9, -0.3>, <1.8, 0.9, 0.3>
  texture {
    Metal("environment.exr")
  }
  rotate <0, 20, 0>
  translate <4.5, -0.5, 0.5>
}
