// surfaces.pov - four machined surfaces, measured: from above the surface itself, the distribution of its slopes, and a
// sphere and a cylinder that it covers, its grooves running around the axis.  surfaces.sh makes what it asks for:
//
//     prefenv surface turned -o turned.heights.exr --roughness 0.24um
//     prefenv ndf turned.heights.exr -o turned.ndf.exr --wrap --turn
//     prefenv bake studio.exr -o surface-turned.pe.exr --ndf turned.ndf.exr --direction 0,1,0
//
// and so on for milled, blasted and brushed.  --turn lays the brush direction across the grooves: the direction is the
// axis, and the grooves run around it.  The plot's file, turned.plot.exr, is the same measurement with --range 0.35.

#version unofficial 3.7;
global_settings { assumed_gamma 1 }
background { rgb 0.16 }
#declare Width = 9.4;
#declare Height = 9.4;
camera { orthographic location <0, 0, -20> direction z right Width*x up Height*y }
light_source { <-20, 8, -7>*10 rgb 1.6 parallel point_at 0 shadowless }

#declare Frame = transform { scale <-1, 1, 1> rotate 250*y }
#declare Flat = finish { ambient 0 emission 1 diffuse 0 }

#macro Words(Text, Size, Place)
  #local Letters = text { ttf "cyrvetic.ttf" Text, 0.001, 0 scale Size };
  object {
    Letters
    translate -(min_extent(Letters).x + max_extent(Letters).x) / 2 * x
    translate Place
    texture { pigment { rgb 0.85 } finish { Flat } }
  }
#end

// A quarter of the surface, a thousand micrometres across, its heights five times too great to be seen at all.
#macro Relief(File, Place)
  #local Heights = function { pigment { image_map { exr File interpolate 2 } } }
  height_field {
    function 512, 512 { 0.5 + 5/1024 * Heights(x/2, y/2, 0).gray }
    smooth
    translate <-1/2, -1/2, -1/2>
    rotate -90*x
    scale 2
    translate Place
    pigment { rgb 0.5 }
    finish { ambient 0 diffuse 0.8 emission 0 specular 0.25 roughness 0.03 }
  }
#end

// Slopes to 0.35 either way, along the brush to the right; every ring of the colours is a factor.
#macro Plot(File, Place)
  #local Density = function { pigment { image_map { exr File interpolate 2 } } }
  box {
    0, <1, 1, 0.01>
    pigment {
      function { min(1, ln(1 + max(0, Density(x, y, 0).gray)) / ln(1 + 800)) }
      color_map {
        [0.00 rgb <0.01, 0.01, 0.03>]
        [0.25 rgb <0.04, 0.10, 0.35>]
        [0.50 rgb <0.02, 0.40, 0.40>]
        [0.75 rgb <0.30, 0.65, 0.15>]
        [1.00 rgb <1.00, 0.80, 0.15>]
      }
    }
    finish { Flat }
    translate <-1/2, -1/2, 0>
    scale <2, 2, 1>
    translate Place
  }
#end

#macro Metal(Name)
  pigment { rgb <0.95, 0.93, 0.9> }
  finish {
    ambient 0 diffuse 0
    reflection { 1 metallic prefiltered_environment { exr concat("surface-", Name, ".pe.exr") transform Frame } }
  }
#end

#macro Column(Name, X)
  Words(Name, 0.3, <X, 4.3, 0>)
  Relief(concat(Name, ".heights.exr"), <X, 3.2, 0>)
  Plot(concat(Name, ".plot.exr"), <X, 1.05, 0>)
  sphere { <X, -1.2, 0>, 1.05 Metal(Name) }
  cylinder { <X, -4.5, 0>, <X, -2.45, 0>, 0.85 open Metal(Name) }
#end

Column("turned", -3.45)
Column("milled", -1.15)
Column("blasted", 1.15)
Column("brushed", 3.45)
