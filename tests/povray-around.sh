#!/bin/bash
# What stands around a glossy surface, one thing a scene, and the number that must come out: coats over it, fog before
# it, things hidden from mirrors or cameras, lamps and shadows on what it shows; looked up, corrected and traced.
#
# The surface fills the picture and is looked at straight, under a white sky, so that pictures are one colour.

. "$srcdir/tests/tap.sh"
. "$srcdir/tests/povray/render.sh"

oiiotool --create 64x32 3 --fill:color=1,1,1 64x32 -d float -o white.exr
bake white.exr -o white.pe.exr --alpha 0.2

# AMOUNT of reflection, WORDS of the block, REST of the texture, REST of the scene; the picture is VALUE all over.
shows() # NAME VALUE AMOUNT WORDS TEXTURE SCENE
{
    scene around.pov <<END
camera { orthographic location -5*z direction z right x up y }
sky_sphere { pigment { rgb 1 } }
plane {
    -z, 0
    texture {
        pigment { rgb 1 }
        finish { ambient 0 diffuse 0 reflection { $3 prefiltered_environment { $4 } } }
    }
    $5
}
$6
END
    rm -f around.exr
    render around.pov +W6 +H6 +FE +Oaround.exr || note "$said"
    oiiotool --create 6x6 3 "--fill:color=$2" 6x6 -d half -o wanted.exr
    ok "$1" "$PREFENV" diff around.exr wanted.exr --fail-above 0.001
}

looked_up='exr "white.pe.exr"'
corrected='exr "white.pe.exr" interreflection 8 exr "white.exr"'
traced='exr "white.exr" roughness 0.2 samples 8 traced'

# A clear coat of index 1.5 mirrors 0.04 of the sky; POV-Ray adds the layers below as they are.
coat='texture { pigment { rgbt 1 } finish { ambient 0 diffuse 0 reflection { 0, 1 fresnel } } } interior { ior 1.5 }'
for words in "$looked_up" "$corrected" "$traced"; do
    shows "a coat with fresnel over metal, $words" 0.84,0.84,0.84 0.8 "$words" "$coat" ''
done

# Fog hides a sky that is infinitely far.  A lookup does not know of it, but of the five units before the surface.
fog='fog { distance 10 color rgb <0.25, 0.5, 0> }'
shows 'fog before the surface alone' 0.704898,0.803265,0.606531 1 "$looked_up" '' "$fog"
shows 'fog before the sky, too' 0.25,0.5,0 1 "$traced" '' "$fog"
shows 'fog found by correcting' 0.25,0.5,0 1 "$corrected" '' "$fog"

# A wall behind the camera, wherever the lobe looks.
for words in "$corrected" "$traced"; do
    wall='plane { z, -50 pigment { rgb <1, 0.5, 0.25> }'
    grey='finish { ambient 0 emission 0.5 diffuse 0 }'
    matt='finish { ambient 0 diffuse 0.5 }'
    lamp='light_source { -10*z, 1 parallel point_at -50*z }'
    shows "a wall, $words" 0.5,0.25,0.125 1 "$words" '' "$wall $grey }"
    shows "no_image does not hide it, $words" 0.5,0.25,0.125 1 "$words" '' "$wall $grey no_image }"
    shows "no_reflection does, $words" 1,1,1 1 "$words" '' "$wall $grey no_reflection }"
    shows "a lamp lights it, $words" 0.5,0.25,0.125 1 "$words" '' "$wall $matt } $lamp"
    shows "something shadows it, $words" 0,0,0 1 "$words" '' \
        "$wall $matt } $lamp plane { z, -40 inverse clipped_by { box { <-1e4, -1e4, -41>, <1e4, 1e4, -39> } }
            pigment { rgb 1 } no_image no_reflection }"
    shows "glossy metal shows glossy metal, $words" 0.4,0.4,0.4 0.5 "$words" '' \
        "plane { z, -50 pigment { rgb 1 } finish { ambient 0 diffuse 0
            reflection { 0.8 prefiltered_environment { $looked_up } } } }"
done

done_testing
