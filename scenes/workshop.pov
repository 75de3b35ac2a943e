// workshop.pov - machined parts on a bench before a brick wall, under a lamp: metal reflects more than sky.
//
//   Declare=Mode=0   the prefiltered lookup alone: parts and wall are neither reflected nor in the way
//   Declare=Mode=1   traced, Declare=Rays=N of them at each point: the truth
//   Declare=Mode=2   the lookup, corrected by Declare=Rays=N where they meet something
//   Declare=Mode=3   white where the metal is, black elsewhere
//
// Looked for along Library_Path: environment.exr, and for modes 0 and 2 workshop.pe.exr, baked from it:
//
//   prefenv bake environment.exr -o workshop.pe.exr --alpha 0.15
//
// where environment.exr is any panorama; `make table1` takes courtyard.exr, 256x128.
// Declare=Shift moves all of it, which changes the noise and nothing else.

#version unofficial 3.7;

#ifndef (Mode) #declare Mode = 2; #end
#ifndef (Rays) #declare Rays = 16; #end
#ifndef (Shift) #declare Shift = 0; #end

global_settings {
  assumed_gamma 1
  max_trace_level 8
}

#declare Lit = (Mode = 3 ? 0 : 1);

#declare Frame = transform { scale <-1, 1, 1> rotate 200*y }

#macro Metal(Colour)
  texture {
    #if (Mode = 3)
      pigment { rgb 1 }
      finish { ambient 1 diffuse 0 }
    #else
      pigment { rgb Colour }
      finish {
        ambient 0 diffuse 0
        reflection {
          1 metallic
          prefiltered_environment {
            #switch (Mode)
              #case (0) exr "workshop.pe.exr" #break
              #case (1) exr "environment.exr" roughness 0.15 samples Rays traced #break
              #else exr "workshop.pe.exr" interreflection Rays exr "environment.exr"
            #end
            transform Frame
          }
        }
      }
    #end
  }
#end

#macro Matt(Pattern)
  texture {
    #if (Mode = 3) pigment { rgb 0 } #else pigment { Pattern } #end
    finish { ambient 0.15 * Lit diffuse 0.7 * Lit }
  }
#end

camera {
  location <-1.2, 3.2, -7.5> + Shift
  right 4/3*x
  angle 40
  look_at <0.1, 0.75, 0> + Shift
}

sky_sphere {
  pigment {
    #if (Mode = 3) rgb 0 #else prefiltered_environment { exr "environment.exr" transform Frame } #end
  }
}

#declare Brass = rgb <0.95, 0.75, 0.4>;
#declare Copper = rgb <0.95, 0.6, 0.5>;
#declare Steel = rgb 0.75;
#declare Balls = array[3] { Steel, Copper, Steel }

union {
  light_source { <-5, 8, -5> rgb 0.8 * Lit }

  // the bench and the wall
  plane { y, 0 Matt(pigment { checker rgb <0.5, 0.35, 0.22> rgb <0.75, 0.6, 0.42> scale 0.8 rotate 20*y }) }
  box {
    <-6, 0, 2.6>, <6, 4, 3>
    Matt(pigment { brick rgb 0.8 rgb <0.55, 0.2, 0.12> brick_size <0.9, 0.4, 0.9> mortar 0.07 })
  }

  // a shaft that stands, with a collar
  union {
    cylinder { 0, 2*y, 0.35 }
    cylinder { 0.5*y, 0.75*y, 0.6 }
    cone { 2*y, 0.35, 2.15*y, 0.2 }
    Metal(Steel)
    translate <-1.6, 0, 0.8>
  }
  // a ring lying on the bench
  torus { 0.75, 0.22 translate <1.75, 0.22, -0.5> Metal(Brass) }
  // a bush: a hollow cylinder, cut open
  difference {
    cylinder { -0.9*x, 0.9*x, 0.6 }
    cylinder { -x, x, 0.42 }
    box { <-2, 0, -2>, <2, 2, 0> }
    rotate 25*y
    translate <0.1, 0.6, -0.6>
    Metal(Copper)
  }
  // balls of a bearing, and a block
  #for (K, 0, 2)
    sphere { <0.35 + 0.62 * K, 0.3, -2.1 + 0.18 * K * K>, 0.3 Metal(Balls[K]) }
  #end
  box { <-0.55, 0, -0.35>, <0.55, 0.8, 0.35> rotate -35*y translate <0.9, 0, 1.3> Metal(Steel) }
  sphere { <0.9, 1.35, 1.3>, 0.55 Metal(Brass) }

  translate Shift
}
