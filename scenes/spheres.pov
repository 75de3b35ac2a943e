// spheres.pov - one metal, five finishes: alpha 0.02, 0.05, 0.1, 0.2 and 0.4, each with maps of its own.  The sharper
// the reflection, the finer the maps have to be.
//
//     prefenv bake courtyard.exr -o alpha-0.02.pe.exr --alpha 0.02 --size 1024x512
//     prefenv bake courtyard.exr -o alpha-0.05.pe.exr --alpha 0.05 --size 800x400
//     prefenv bake courtyard.exr -o alpha-0.10.pe.exr --alpha 0.1
//     prefenv bake courtyard.exr -o alpha-0.20.pe.exr --alpha 0.2 --size 200x100
//     prefenv bake courtyard.exr -o alpha-0.40.pe.exr --alpha 0.4 --size 100x50

#version unofficial 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location <0, 2, -10> right 11*x up 2.75*y look_at 0 }
#declare Frame = transform { scale <-1, 1, 1> rotate 240*y }
background { rgb 0.18 }

#macro Finished(Alpha, Place)
  sphere {
    0, 1
    translate Place
    pigment { rgb <1, 0.86, 0.6> }
    finish {
      ambient 0 diffuse 0
      reflection {
        1 metallic
        prefiltered_environment { exr concat("alpha-", str(Alpha, 0, 2), ".pe.exr") transform Frame }
      }
    }
  }
#end

Finished(0.02, -4.2*x)
Finished(0.05, -2.1*x)
Finished(0.10, 0*x)
Finished(0.20, 2.1*x)
Finished(0.40, 4.2*x)
