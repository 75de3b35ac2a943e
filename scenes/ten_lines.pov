#version unofficial 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -3> look_at 0 }
#declare Turn = transform { scale <-1, 1, 1> rotate 180*y }
sky_sphere { pigment { prefiltered_environment { exr "studio.exr" transform Turn } } }
sphere {
  0, 1 pigment { rgb <1, 0.8, 0.5> }
  finish { ambient 0 diffuse 0
    reflection { 1 metallic prefiltered_environment { exr "studio.pe.exr" transform Turn } } }
}
