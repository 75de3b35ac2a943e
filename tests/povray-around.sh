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

# Smoke in a shell all around, seen in the surface: e^-0.5 of the wall is left.
for words in "$corrected" "$traced"; do
    shows "smoke before a wall, $words" 0.606531,0.606531,0.606531 1 "$words" '' \
        'sphere { 0, 50 hollow pigment { rgb 1 } finish { ambient 0 emission 1 diffuse 0 } }
        difference { sphere { 0, 40 } sphere { 0, 30 } hollow pigment { rgbt 1 }
            interior { media { absorption 0.05 } } }'
done

# ---- animation ----

# Two frames of a ball that moves by eight pixels while another stands still, and is not shown it.  What stands is the
# same to the last bit, noise included; what is looked up moves with the ball, and so does its highlight.
chart chart.hdr 64 32
bake chart.hdr -o chart.exr --alpha 0.2 --normals 42 --size 24x24
scene film.pov <<'END'
camera { orthographic location -9*z direction z right 8*x up 4*y }
light_source { <-30, 30, -40>, 0.2 parallel point_at 0 }
#macro Ball(Rays, Place)
    sphere { 0, 1 pigment { rgb 1 }
        finish { ambient 0 diffuse 0 reflection { 1 prefiltered_environment {
            #if (Rays) hdr "chart.hdr" roughness 0.2 samples 8 traced #else exr "chart.exr" #end highlight } } }
        translate Place no_reflection no_shadow }
#end
Ball(off, <-1.5 - clock, 0, 0>)
Ball(on, <2.5, 0, 0>)
END
render film.pov +W64 +H32 +FE +KFI1 +KFF2 +Ofilm.exr || note "$said"
oiiotool film1.exr --cut 24x32+40+0 -o still1.exr
oiiotool film2.exr --cut 24x32+40+0 -o still2.exr
ok 'what stands still is the same in every frame, its noise too' "$PREFENV" diff still1.exr still2.exr --fail-above 0
oiiotool film1.exr --cut 20x32+10+0 -o moved1.exr
oiiotool film2.exr --cut 20x32+2+0 -o moved2.exr
ok 'what moves does not flicker' "$PREFENV" diff moved1.exr moved2.exr --fail-above 0.0005
note "$tap_output"
fails '... and has moved' "$PREFENV" diff film1.exr film2.exr --fail-above 0.05

done_testing
