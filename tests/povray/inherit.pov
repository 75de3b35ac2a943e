// inherit.pov - the cases of povray-inherit.sh, one a frame: finishes, textures, normals and objects around a reflection.

#version unofficial 3.7;
global_settings { assumed_gamma 1 }

// Mode 0: a mirror; 1: the block.  Sky 0: one colour; 1: the environment.
#macro Env()
  #if (Mode)
    #if (Sky) prefiltered_environment { hdr "chart.hdr" roughness 0.001 samples 8 rotate 70*y }
    #else prefiltered_environment { exr "constant.exr" rotate 70*y } #end
  #end
#end
camera { location <0.7, 1.3, -2.6> direction 1.2*z right x up y look_at 0 }
sky_sphere {
  pigment {
    #if (Sky) prefiltered_environment { hdr "chart.hdr" rotate 70*y }
    #else rgb <128.5, 64.5, 192.5> / 256 #end
  }
}
light_source { <5, 8, -6>, 0.4 }
#declare Red = pigment { rgb <0.9, 0.3, 0.2> }
#declare Dull = finish { ambient 0 diffuse 0.2 }
#declare Glossy = finish { Dull reflection { 0.7 metallic Env() } }
#switch (frame_number)
#case (1) sphere { 0, 1 pigment { rgb 1 } finish { Dull reflection { 1 Env() } } } #break
#case (2) sphere { 0, 1 pigment { rgb 1 } finish { Dull reflection { <1, 0.5, 0.25> Env() } } } #break
#case (3) sphere { 0, 1 pigment { rgb 1 } finish { Dull reflection { <0.1, 0.2, 0>, <1, 0.5, 0.7> falloff 3 Env() } } } #break
#case (4) sphere { 0, 1 pigment { rgb 1 } finish { Dull reflection { 0.1, 0.9 Env() falloff 2.7 } } } #break
#case (5) sphere { 0, 1 pigment { rgb 1 } finish { Dull reflection { 1 fresnel on Env() } } interior { ior 1.7 } } #break
#case (6) sphere { 0, 1 pigment { rgb 1 } finish { Dull reflection { 0.2, 0.8 Env() fresnel on } } interior { ior 2.5 } } #break
#case (7) sphere { 0, 1 pigment { Red } finish { Dull reflection { 1 metallic Env() } } } #break
#case (8) sphere { 0, 1 pigment { Red } finish { Dull reflection { 0.8 Env() metallic 0.5 } } } #break
#case (9) sphere { 0, 1 pigment { rgb 1 } finish { Dull reflection { 1 exponent 0.6 Env() } } } #break
#case (10)
  sphere { 0, 1
    texture { pigment { rgb 0.5 } finish { Dull } }
    texture { pigment { rgbt <0.2, 0.9, 0.3, 0.6> } finish { Dull conserve_energy reflection { 0, 0.9 falloff 2 Env() } } }
  }
#break
#case (11)
  sphere { 0, 1
    texture { pigment { Red } finish { Dull reflection { 0.6 metallic Env() } } normal { bumps 0.4 scale 0.1 } }
    texture { pigment { rgbf <0.9, 0.9, 0.2, 0.7> } finish { Dull reflection { 0.3 Env() } } }
  }
#break
#case (12)
  sphere { 0, 1
    texture {
      gradient y
      texture_map {
        [0.3 pigment { Red } finish { Dull reflection { 0.9 metallic Env() } }]
        [0.7 pigment { rgb 0.2 } finish { Dull reflection { 0.2 Env() } } normal { bumps 0.3 scale 0.1 }]
      }
      translate -0.5*y
    }
  }
#break
#case (13)
  sphere { 0, 1
    texture {
      average
      texture_map {
        [1 pigment { Red } finish { Dull reflection { 0.9 Env() } }]
        [2 pigment { rgb 0.2 } finish { Dull reflection { 0.3, 0.7 Env() } } normal { bumps 0.3 scale 0.1 }]
      }
    }
  }
#break
#case (14)
  box { -1, <1, 1, -0.9>
    texture {
      material_map {
        hdr "constant.hdr"
        texture { pigment { Red } finish { Dull reflection { 0.9 metallic Env() } } }
      }
    }
  }
#break
#case (15) sphere { 0, 1 pigment { rgb 1 } normal { bumps 0.5 scale 0.2 } finish { Dull reflection { 1 Env() } } } #break
#case (16) sphere { 0, 1 pigment { rgb 1 } normal { wrinkles 2.5 scale 0.3 } finish { Dull reflection { 1 Env() } } } #break
#case (17)
  sphere { 0, 1
    texture {
      pigment { Red }
      normal { gradient x normal_map { [0.4 bumps 0.5 scale 0.1] [0.6 wrinkles 0.6 scale 0.2] } scale 0.5 }
      finish { Dull reflection { 0.7 Env() } }
    }
    texture { pigment { rgbt <0.3, 0.6, 0.3, 0.5> } normal { waves 0.4 scale 0.2 } finish { Dull reflection { 0.3 metallic Env() } } }
  }
#break
#case (18)
  mesh2 {
    vertex_vectors { 4, <1, 1, 1>, <-1, 1, -1>, <-1, -1, 1>, <1, -1, -1> }
    uv_vectors { 4, <0, 0>, <1, 0>, <0, 1>, <1, 1> }
    face_indices { 4, <0, 1, 2>, <0, 3, 1>, <0, 2, 3>, <1, 3, 2> }
    uv_indices { 4, <0, 1, 2>, <0, 3, 1>, <0, 2, 3>, <1, 3, 2> }
    texture {
      uv_mapping pigment { checker rgb <0.9, 0.8, 0.2>, rgb <0.2, 0.3, 0.8> scale 0.2 }
      normal { uv_mapping bumps 0.2 scale 0.05 }
      finish { Dull reflection { 0.8 metallic Env() } }
    }
  }
#break
#case (19)
  sphere { <3, 0, 1>, 1
    texture { pigment { Red } normal { bumps 0.3 scale 0.2 } finish { Dull reflection { 0.8 metallic Env() } } rotate 40*z }
    translate -<3, 0, 1> scale <1, 0.6, 1> rotate <20, 60, 10>
  }
#break
#case (20)
  #declare Other = finish { Glossy reflection { 0.4 } }
  union {
    sphere { 0, 0.9 }
    sphere { 0, 1 texture { pigment { Red } finish { Other } } clipped_by { plane { x, 0 } } no_reflection }
    texture { pigment { rgb 0.7 } finish { Glossy } }
    no_reflection
  }
#break
#case (21) sphere { 0, 1 pigment { rgb 1 } finish { Dull irid { 0.3 thickness 0.4 } reflection { 0.8 Env() } } } #break
#case (22)
  // What the glass reflects on its inner side is traced in either mode, so that it is coloured by the glass.
  sphere { 0, 1
    pigment { rgbf <0.9, 0.6, 0.4, 0.9> }
    finish { Dull reflection { 0.3 Env() } }
    interior { ior 1.5 fade_distance 0.5 fade_power 1001 fade_color rgb <0.2, 0.5, 0.9> }
  }
#break
#case (23) sphere { 0, 1 pigment { rgb 0.5 } finish { Dull reflection { 1 Env() } } } #break
#end
