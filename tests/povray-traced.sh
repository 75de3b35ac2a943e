#!/bin/bash
# `samples N traced`: rays are traced where the surface reflects.  Alone under its environment a convex object shows
# what `prefenv exact` says, within the standard error that repeated pictures have; what stands around is seen where
# it stands; nothing is lost or won however often light bounces; threads change nothing.

. "$srcdir/tests/tap.sh"
. "$srcdir/tests/povray/render.sh"

. "$srcdir/tests/povray/sphere.sh"

chart chart.hdr 256 128

# Behind everything; rays that leave the scene see the block's environment instead.
red='background { rgb <9, 0, 0> }'

# ---- one bounce, against the exact answer ----

sphere 'hdr "chart.hdr" roughness 0.3 samples 8 traced' "$red"
is_exact 'alone under its environment: exact, but for noise' 12 exact chart.hdr --alpha 0.3
sphere 'hdr "chart.hdr" roughness 0.35, 0.2 type 2 metallic "copper" direction <1, 2, 0.5> samples 16 traced' "$red"
is_exact '... brushed copper, GGX' 12 exact chart.hdr --alpha 0.35,0.2 --ndf ggx --direction 1,2,0.5 \
    --weight microfacet --material copper
sphere 'hdr "chart.hdr" roughness 0.3 type 3 samples 64 traced' "$red"
is_exact '... Phong, whose visible normals have no formula' 12 exact chart.hdr --alpha 0.3 --ndf phong

# ---- what stands around ----

# The chart as a thing: a shell so far off that the sphere's place does not matter.
chart other.hdr 16 8
shell='sphere { 0, 1e5 hollow pigment { prefiltered_environment { hdr "chart.hdr" } } finish { ambient 1 diffuse 0 }'
sphere 'hdr "other.hdr" roughness 0.3 samples 8 traced' "$red $shell }"
is_exact 'objects hide the environment' 12 exact chart.hdr --alpha 0.3

block='hdr "chart.hdr" roughness 0.3 samples 16 traced'
one alone.exr "$block" "$red"
one threads.exr "$block" "$red" +WT1
ok 'the same picture with another number of threads' "$PREFENV" diff alone.exr threads.exr --fail-above 0
one varying.exr 'hdr "chart.hdr" roughness function { 0.3 } samples 16 traced' "$red"
ok 'roughness may vary' "$PREFENV" diff alone.exr varying.exr --fail-above 0
one no_reflection.exr "$block" "$red $shell no_reflection no_image }"
ok 'what has no_reflection is not seen' "$PREFENV" diff alone.exr no_reflection.exr --fail-above 0
one box.exr "$block" "$red "'box { -50, 50 hollow pigment { rgbt 1 } finish { ambient 0 diffuse 0 } interior { } }'
ok 'the environment is seen straight through what is clear' "$PREFENV" diff alone.exr box.exr --fail-above 0.0005
one level.exr "$block" "$red "'global_settings { max_trace_level 1 }'
like "$("$PREFENV" diff alone.exr level.exr)" 'reference 0 0 0' 'max_trace_level 1: nothing is traced'

# ---- a room ----

# Seen from inside, the walls of a box are the same whichever side of them is called its inside, with highlights; in
# glass the environment, which is beyond it, is not to be seen.
room() # PICTURE WORDS BLOCK
{
    scene room.pov <<END
camera { location <0, 0, -4> look_at <0, -1, 0> angle 70 }
light_source { <2, 3, -2>, 0.7 }
box { -5, 5 $2 pigment { rgb 1 } finish { ambient 0 diffuse 0 reflection { 0.8 $3 } } }
sphere { <0, -3, 0>, 1 pigment { rgb <0.2, 0.5, 0.9> } finish { ambient 0.2 diffuse 0.7 } }
END
    render room.pov +W$size +H$size +FE "+O$1" || note "$said"
}
for words in 'hdr "chart.hdr" roughness 0.2 samples 4 traced' 'hdr "chart.hdr" roughness 0.2 interreflection 4' \
    'hdr "chart.hdr" roughness 0.2'; do
    words="prefiltered_environment { $words highlight }"
    room inside.exr '' "$words"
    room inverse.exr inverse "$words"
    room glass.exr 'interior { ior 1.5 }' "$words"
    room mirror.exr 'interior { ior 1.5 }' ''
    ok "a room of metal: ${words:26}" "$PREFENV" diff inside.exr inverse.exr --fail-above 0
    ok '... but in glass, a mirror' "$PREFENV" diff glass.exr mirror.exr --fail-above 0
    fails '... which a room is not' "$PREFENV" diff inside.exr mirror.exr --fail-above-relative 0.2
done

# ---- as a mirror ----

# mirrored PICTURE BLOCK REST: a ball on a floor, a mirror or with that block, and a ring whose caustic it shows
mirrored()
{
    scene mirrored.pov <<END
$3
camera { location <0, 1, -4> look_at <0, -0.3, -0.9> angle 20 }
sky_sphere { pigment { rgb 0.5 } }
plane { y, -1 pigment { rgb 1 } finish { ambient 0 diffuse 0.8 } }
cylinder { <0, -1, -2>, <0, -0.8, -2>, 0.9 open pigment { rgb 1 }
    finish { ambient 0 diffuse 0 reflection 0.9 } photons { target reflection on } }
sphere { 0, 1 pigment { rgb 1 } finish { ambient 0 diffuse 0 reflection { 0.5 $2 } } }
END
    render mirrored.pov +W$size +H$size +FE +WT1 "+O$1" || note "$said"
}

# mirrors NAME BOUND REST OTHER: metal that is nearly a mirror shows of the rest what POV-Ray's own mirror does, to that
# bound; and another rest would be noticed
mirrors()
{
    local off without

    mirrored mirror.exr '' "$3"
    mirrored metal.exr "$polished" "$3"
    mirrored without.exr '' "$4"
    off=$(rmse metal.exr mirror.exr) without=$(rmse without.exr mirror.exr)
    note "relative RMSE: $off; of a mirror with another rest: $without"
    ok "$1" holds "$off < $2 && $without > 3 * $2"
}

oiiotool --create 64x32 3 --fill:color=0.5,0.5,0.5 64x32 -d float -o grey.exr
polished='prefiltered_environment { exr "grey.exr" roughness 0.001 samples 4 traced }'
lamp='light_source { <3, 6, -3>, 1 }'
wall='box { <-4, -1, -6>, <4, 1, -5> pigment { rgb 1 } finish { ambient 0 emission <3, 0.5, 0.2> diffuse 0 } }'
mirrors 'radiosity, as in a mirror' 0.06 \
    "$wall global_settings { radiosity { count 60 error_bound 0.5 recursion_limit 2 } }" "$wall"
mirrors 'photons, as in a mirror' 0.035 "global_settings { photons { count 20000 } } $lamp" "$lamp"

# Half of what is reflected is below an adc_bailout of 0.9, and is dropped.
mirrors 'adc_bailout above the amount, as in a mirror' 0.0001 "$lamp global_settings { adc_bailout 0.9 }" "$lamp"
amount=0.5
one bailout.exr 'hdr "chart.hdr" roughness 0.3 samples 16 traced' \
    "$red $shell no_image } global_settings { adc_bailout 0.9 }"
like "$("$PREFENV" diff alone.exr bailout.exr)" 'reference 0 0 0' '... where nothing is traced'
amount=1

# ---- every bounce ----

# In a room that is white all over everything is white, however light goes: nothing is lost below the horizon, in
# hollows, or where directions end.
furnace() # NAME TYPE SETTINGS
{
    scene furnace.pov <<END
$3
camera { location <0, 0.6, -5> look_at 0 angle 50 }
#declare Glossy = finish { ambient 0 diffuse 0
    reflection { 1 prefiltered_environment { hdr "chart.hdr" roughness 0.6 type $2 samples 4 traced } } }
sphere { 0, 30 hollow pigment { rgb 1 } finish { ambient 1 diffuse 0 } }
sphere { -0.8*x, 0.8 pigment { rgb 1 } finish { Glossy } }
sphere { 0.8*x, 0.8 pigment { rgb 1 } normal { bumps 0.8 scale 0.1 } finish { Glossy } }
torus { 0.8, 0.25 sturm rotate -30*x translate -1.1*y pigment { rgb 1 } finish { Glossy } }
END
    render furnace.pov +W40 +H40 +FE +Ofurnace.exr || note "$said"
    oiiotool --create 40x40 3 --fill:color=1,1,1 40x40 -d half -o white.exr
    ok "$1" "$PREFENV" diff furnace.exr white.exr --fail-above 0.001
}

deep='global_settings { max_trace_level 100 adc_bailout 0 }'
furnace 'a white furnace, GGX: everything is white' 2 "$deep"
furnace 'a white furnace, Phong' 3 "$deep"
furnace 'a white furnace, Beckmann' 1 "$deep"

# Directions of the first hit lead on one by one: their number does not grow with the bounces.
count=$(sed -n 's/.*Reflected Rays: *\([0-9]*\).*/\1/p' <<<"$said")
note "$count reflected rays"
ok 'directions do not multiply from bounce to bounce' [ "${count:-1000000}" -lt 20000 ]

done_testing
