#!/bin/bash
# `samples N traced`: rays are traced where the surface reflects.  Alone under its environment a convex object shows
# what `prefenv exact` says, within the standard error that repeated pictures have; what stands around is seen where
# it stands; nothing is lost or won however often light bounces; threads change nothing.

. "$srcdir/tests/tap.sh"
. "$srcdir/tests/povray/render.sh"

size=24
pictures=12
chart chart.hdr 256 128

# A sphere at a place of the world that depends on the clock, which makes other noise at each, seen from there; the rest
# of the scene around the origin.
sphere() # BLOCK REST
{
    scene sphere.pov <<END
#declare Place = clock * <0.37, -0.21, 0.11>;
background { rgb <9, 0, 0> }
camera { location -3*z direction z right x up y translate Place }
sphere {
    0, 1
    pigment { rgb 1 }
    finish { ambient 0 diffuse 0 reflection { 1 prefiltered_environment { $1 } } }
    translate Place
}
$2
END
}

# COMMAND of prefenv tells the truth.
is_exact() # NAME COMMAND...
{
    local name=$1

    shift
    rm -f picture*.exr
    render sphere.pov +W$size +H$size +FE +KI1 +KF$pictures +KFI1 +KFF$pictures +Opicture.exr || note "$said"
    "$rays" rays $size 3 0,0,0 0,0,0 | "$PREFENV" "$@" >wanted.txt || note "prefenv $* failed"
    ok "$name" "$rays" noise 3 picture*.exr <wanted.txt
    note "$tap_output"
}

# ---- one bounce, against the exact answer ----

sphere 'hdr "chart.hdr" roughness 0.3 samples 8 traced' ''
is_exact 'alone under its environment: exact, but for noise' exact chart.hdr --alpha 0.3
sphere 'hdr "chart.hdr" roughness 0.35, 0.2 type 2 metallic "copper" direction <1, 2, 0.5> samples 16 traced' ''
is_exact '... brushed copper, GGX' exact chart.hdr --alpha 0.35,0.2 --ndf ggx --direction 1,2,0.5 \
    --weight microfacet --material copper
sphere 'hdr "chart.hdr" roughness 0.3 type 3 samples 64 traced' ''
is_exact '... Phong, whose visible normals have no formula' exact chart.hdr --alpha 0.3 --ndf phong

# ---- what stands around ----

# The chart as a thing: a shell so far off that the sphere's place does not matter.
chart other.hdr 16 8
shell='sphere { 0, 1e5 hollow pigment { prefiltered_environment { hdr "chart.hdr" } } finish { ambient 1 diffuse 0 }'
sphere 'hdr "other.hdr" roughness 0.3 samples 8 traced' "$shell }"
is_exact 'objects hide the environment' exact chart.hdr --alpha 0.3

one() # NAME REST; the picture of the first place is NAME
{
    sphere 'hdr "chart.hdr" roughness 0.3 samples 16 traced' "$2"
    render sphere.pov +W$size +H$size +FE +K1 "+O$1" "${@:3}" || note "$said"
}

one alone.exr ''
one threads.exr '' +WT1
ok 'the same picture with another number of threads' "$PREFENV" diff alone.exr threads.exr --fail-above 0
sphere 'hdr "chart.hdr" roughness function { 0.3 } samples 16 traced' ''
render sphere.pov +W$size +H$size +FE +K1 +Ovarying.exr || note "$said"
ok 'roughness may vary' "$PREFENV" diff alone.exr varying.exr --fail-above 0
one no_reflection.exr "$shell no_reflection no_image }"
ok 'what has no_reflection is not seen' "$PREFENV" diff alone.exr no_reflection.exr --fail-above 0
one box.exr 'box { -50, 50 hollow pigment { rgbt 1 } finish { ambient 0 diffuse 0 } interior { } }'
ok 'the environment is seen straight through what is clear' "$PREFENV" diff alone.exr box.exr --fail-above 0.0005
one level.exr 'global_settings { max_trace_level 1 }'
like "$("$PREFENV" diff alone.exr level.exr)" 'reference 0 0 0' 'max_trace_level 1: nothing is traced'

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
