// fig5a.pov - [Motegi Fig. 5]: the environment, all of it, the right way round.

#version unofficial 3.7;
#ifndef (Kind) #declare Kind = 1; #end
global_settings { assumed_gamma 1 }
camera { spherical angle 360 180 look_at x }
sky_sphere {
  pigment {
    prefiltered_environment {
      #switch (Kind)
        #case (2) hdr "environment.hdr" #break
        #case (3) png "environment.png" #break
        #else exr "environment.exr"
      #end
      scale <-1, 1, 1>
    }
  }
}
