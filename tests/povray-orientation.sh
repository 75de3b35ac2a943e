#!/bin/bash
# Orientation: the pigment lies where POV-Ray's own image_map with map_type 1 lies, texel for texel; and background and
# reflection stay in register under the same rotate.

. "$srcdir/tests/tap.sh"
. "$srcdir/tests/povray/render.sh"

chart chart.hdr 32 16

# The same picture as PNG and EXR, written by POV-Ray.
scene copy.pov <<'END'
camera { orthographic location -z direction z right x up y }
plane { z, 0 pigment { image_map { hdr "chart.hdr" } translate -<1, 1> / 2 } finish { ambient 1 diffuse 0 } }
END
render copy.pov +W32 +H16 +FN16 +Ochart.png || bail_out "$said"
render copy.pov +W32 +H16 +FE +Ochart.exr || bail_out "$said"

# Both pigments as functions, at the middle of every texel; POV-Ray compares, and stops with an error if one differs.
for file in hdr:chart.hdr exr:chart.exr png:chart.png; do
    kind=${file%:*} name=${file#*:}
    scene texels.pov <<END
#declare Theirs = function { pigment { image_map { $kind "$name" map_type 1 } } }
#declare Ours = function { pigment { prefiltered_environment { $kind "$name" } } }
#declare Different = 0;
#declare Largest = 0;
#macro Compare(A, B)
  #declare Largest = max(Largest, A);
  #if (abs(A - B) > 1e-5 * max(A, 1)) #declare Different = Different + 1; #end
#end
#local I = 0;
#while (I < 32)
  #local J = 0;
  #while (J < 16)
    #local P = vrotate(vrotate(x, 90 * (1 - 2 * (J + 0.5) / 16) * z), -360 * (I + 0.5) / 32 * y);
    #local A = Theirs(P.x, P.y, P.z);
    #local B = Ours(P.x, P.y, P.z);
    Compare(A.red, B.red)
    Compare(A.green, B.green)
    Compare(A.blue, B.blue)
    #local J = J + 1;
  #end
  #local I = I + 1;
#end
#debug concat("different: ", str(Different, 0, 0), ", largest: ", str(Largest, 0, 3), "\n")
END
    render texels.pov +W4 +H4 -F
    like "$said" 'different: 0, largest: (0\.[5-9]|[1-9])' "$name: every texel as in image_map { map_type 1 }"
done

# Rendered, too, where both are interpolated.
sky() # PIGMENT OUTPUT
{
    scene sky.pov <<END
camera { location 0 direction z right x up y rotate <-20, 50, 10> }
sky_sphere { $1 }
END
    render sky.pov +W80 +H80 +FE "+O$2" || note "$said"
}

chart fine.hdr 512 256 0
sky 'pigment { image_map { hdr "fine.hdr" map_type 1 interpolate 2 } rotate <30, 70, -20> }' theirs.exr
sky 'pigment { prefiltered_environment { hdr "fine.hdr" rotate <30, 70, -20> } }' inside.exr
ok 'rotate in the block turns as rotate in a pigment' \
    "$PREFENV" diff inside.exr theirs.exr --fail-above-relative 0.01
sky 'pigment { prefiltered_environment { hdr "fine.hdr" } rotate <30, 70, -20> }' outside.exr
ok '... so does rotate behind the block' "$PREFENV" diff outside.exr inside.exr --fail-above 1e-6
sky 'pigment { prefiltered_environment { hdr "fine.hdr" } } rotate <30, 70, -20>' skysphere.exr
ok '... and rotate of the sky_sphere' "$PREFENV" diff skysphere.exr inside.exr --fail-above 1e-6
sky 'pigment { prefiltered_environment { hdr "fine.hdr" scale <-1, 1, 1> } }' inside.exr
sky 'pigment { image_map { hdr "fine.hdr" map_type 1 interpolate 2 } scale <-1, 1, 1> }' theirs.exr
ok 'scale <-1, 1, 1> mirrors both' "$PREFENV" diff inside.exr theirs.exr --fail-above-relative 0.01

# A mirror that traces the background, and the block with the smallest roughness there is.
mirror() # REFLECTION OUTPUT
{
    scene mirror.pov <<END
#declare Turn = transform { rotate <30, 70, -20> scale <1, 1, -1> }
camera { location -3*z direction z right x up y rotate <20, 30, 0> }
sky_sphere { pigment { prefiltered_environment { hdr "fine.hdr" transform Turn } } }
sphere { 0, 1 pigment { rgb 1 } finish { ambient 0 diffuse 0 reflection { 1 $1 } } }
END
    render mirror.pov +W80 +H80 +FE "+O$2" || note "$said"
}

mirror '' traced.exr
mirror 'prefiltered_environment { hdr "fine.hdr" roughness 0.001 samples 8 transform Turn }' block.exr
ok 'background and reflection are in register under one transform' \
    "$PREFENV" diff block.exr traced.exr --fail-above-relative 0.01
bake fine.hdr -o sharp.exr --alpha 0.02 --normals 42 --size 128x64
mirror 'prefiltered_environment { exr "sharp.exr" transform Turn }' maps.exr
ok '... maps, too' "$PREFENV" diff maps.exr traced.exr --fail-above-relative 0.01
mirror 'prefiltered_environment { hdr "fine.hdr" roughness 0.001 samples 8 }' block.exr
fails '... which a forgotten transform would show' \
    "$PREFENV" diff block.exr traced.exr --fail-above-relative 0.05

# A real one, where it is at hand: DWAB, 1024 x 512, every 16th texel of every 16th row.
if [ -f "${PREFENV_DATA:-}/hdri/city.exr" ]; then
    cp "$PREFENV_DATA/hdri/city.exr" .
    scene city.pov <<'END'
#declare Theirs = function { pigment { image_map { exr "city.exr" map_type 1 } } }
#declare Ours = function { pigment { prefiltered_environment { exr "city.exr" } } }
#declare Different = 0;
#macro Compare(A, B)
  // texels below 0 are repaired in ours
  #if (A >= 0 & abs(A - B) > 0.001 * max(A, 0.01)) #declare Different = Different + 1; #end
#end
#local I = 8;
#while (I < 1024)
  #local J = 8;
  #while (J < 512)
    #local P = vrotate(vrotate(x, 90 * (1 - 2 * (J + 0.5) / 512) * z), -360 * (I + 0.5) / 1024 * y);
    #local A = Theirs(P.x, P.y, P.z);
    #local B = Ours(P.x, P.y, P.z);
    Compare(A.red, B.red)
    Compare(A.green, B.green)
    Compare(A.blue, B.blue)
    #local J = J + 16;
  #end
  #local I = I + 16;
#end
#debug concat("different: ", str(Different, 0, 0), "\n")
END
    render city.pov +W4 +H4 -F
    like "$said" 'different: 0 ' "city.exr: as in image_map, but for POV-Ray's half floats"
else
    skip 'the HDRIs are not at hand'
fi

# What POV-Ray's half floats cannot hold.
printf '#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n\200\200\200\222\200\200\200\222' >bright.hdr
scene bright.pov <<'END'
#declare Bright = function { pigment { prefiltered_environment { hdr "bright.hdr" } } }
#debug concat("radiance ", str(Bright(1, 0, 0).red, 0, 0), "\n")
END
render bright.pov +W4 +H4 -F
like "$said" 'radiance 13[0-9]{4} ' 'the pigment is not limited to half floats'

done_testing
