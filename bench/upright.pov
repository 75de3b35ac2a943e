// upright.pov - a shaft that stands on a black floor, under a few lamps or much sky: half of what it sees is hidden, and
// the light is in the other half.  `make upright` says what few rays make of it.
//
//   Declare=N=16     interreflection 16; N=-16: samples 16 traced; N=0: the lookup alone

#version unofficial 3.7;
#ifndef (N) #declare N = 0; #end
#ifndef (Alpha) #declare Alpha = 0.3; #end
#ifndef (Shift) #declare Shift = 0; #end

global_settings { assumed_gamma 1 max_trace_level 10 }
camera {
  location <0, 2.5, -9> + Shift
  right 4/3*x
  angle 16
  look_at <0, 0.6, 0> + Shift
}
plane { y, 0 pigment { rgb 0 } finish { ambient 0 diffuse 0 } translate Shift }
cylinder {
  0, 1.2*y, 0.9
  pigment { rgb 1 }
  finish {
    ambient 0 diffuse 0
    reflection {
      1
      prefiltered_environment {
        exr "environment.exr" roughness Alpha
        #if (N < 0) samples -N traced #else interreflection N #end
        scale <-1, 1, 1> rotate 60*y
      }
    }
  }
  translate Shift
}
