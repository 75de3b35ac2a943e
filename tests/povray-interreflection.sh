#!/bin/bash
# `interreflection N`: a lookup is corrected by what rays find that is not the sky.  Where they find nothing it stays
# what it was, to the last bit; where they do, it nears what tracing everything gives; no light leaks through what
# stands in the way, none is counted twice; threads change nothing.

. "$srcdir/tests/tap.sh"
. "$srcdir/tests/povray/render.sh"

. "$srcdir/tests/povray/sphere.sh"

average() # NAME: the mean of places' NAME1.exr, ... is NAME.exr
{
    local pictures=("$1"[0-9]*.exr) sum=()

    for picture in "${pictures[@]:1}"; do sum+=("$picture" --add); done
    oiiotool "${pictures[0]}" "${sum[@]}" --divc ${#pictures[@]} -d float -o "$1.exr"
}

brightness() # PICTURE: of its first channel
{
    oiiotool --stats "$1" | sed -n 's/^ *Stats Avg: *\([^ ]*\) .*/\1/p'
}

chart chart.hdr 256 128
chart other.hdr 256 128 0
bake chart.hdr -o maps.exr --alpha 0.3
bake other.hdr -o other.exr --alpha 0.3

# ---- the sky alone ----

turned='scale <-1, 1, 1> rotate <20, 50, 0>'
one lookup.exr "exr \"maps.exr\" $turned" ''
one alone.exr "exr \"maps.exr\" interreflection 16 hdr \"chart.hdr\" $turned" ''
ok 'what sees only sky stays what it was' "$PREFENV" diff lookup.exr alone.exr --fail-above 0
one level.exr "exr \"maps.exr\" interreflection 16 hdr \"chart.hdr\" $turned" \
    'global_settings { max_trace_level 1 } sphere { 0, 50 hollow pigment { rgb 0 } finish { ambient 0 } }'
ok 'max_trace_level 1: nothing is traced, and the lookup stays' "$PREFENV" diff lookup.exr level.exr --fail-above 0

amount=0.5
one half.exr 'exr "maps.exr"' ''
one bailout.exr 'exr "maps.exr" interreflection 16 hdr "chart.hdr"' \
    'global_settings { adc_bailout 0.9 } sphere { 0, 50 hollow pigment { rgb 0 } finish { ambient 0 } }'
ok 'adc_bailout above the amount: nor then' "$PREFENV" diff half.exr bailout.exr --fail-above 0
amount=1

# Maps of one direction stay as they were baked, and so do the rays that correct them.
bake chart.hdr -o brushed.exr --alpha 0.1,0.5
wall='plane { -z, 5 pigment { checker rgb 0 rgb 2 } finish { ambient 1 diffuse 0 } }'
one plain.exr 'exr "brushed.exr" interreflection 16 hdr "chart.hdr"' "$wall"
one directed.exr 'exr "brushed.exr" direction x interreflection 16 hdr "chart.hdr"' "$wall"
ok 'a direction that maps do not have changes no ray' "$PREFENV" diff plain.exr directed.exr --fail-above 0

# Coarse shapes, shaded smooth and convex: what is above the normal shown, but below the facet met, is not to be found
# inside.
smooth() # NAME WORDS SHAPE
{
    scene smooth.pov <<END
camera { location -3*z direction z right x up y }
#declare Steps = 10;
#macro Point(I, J) vrotate(vrotate(x, 180 / Steps * J * z), 360 / Steps * I * x) #end
#macro Corner(I, J) Point(I, J), Point(I, J) #end
#macro Triangles()
    #for (I, 1, Steps)
        #for (J, 1, Steps)
            #if (J > 1) smooth_triangle { Corner(I, J - 1), Corner(I + 1, J - 1), Corner(I, J) } #end
            #if (J < Steps) smooth_triangle { Corner(I + 1, J - 1), Corner(I + 1, J), Corner(I, J) } #end
        #end
    #end
#end
object {
    $3
    scale <1, 0.8, 0.9>
    rotate <20, 50, 0>
    texture {
        pigment { rgb 1 }
        finish { ambient 0 diffuse 0 reflection { 1 prefiltered_environment { exr "maps.exr" $2 } } }
    }
}
END
    render smooth.pov +W$size +H$size +FE "+O$1" || note "$said"
}

dome='height_field { function 12, 12 { 1 - pow(x - 0.5, 2) - pow(y - 0.5, 2) } smooth
    translate <-0.5, -1, -0.5> scale <2, 1, 2> rotate -90*x }'
for shape in 'mesh { Triangles() }' 'union { Triangles() }' "$dome"; do
    smooth lookup.exr '' "$shape"
    smooth alone.exr 'interreflection 16 hdr "chart.hdr"' "$shape"
    ok "the same on a ${shape%% *} that is shaded smooth" "$PREFENV" diff lookup.exr alone.exr --fail-above 0 ||
        note "$tap_output"
done

# Where nothing is in the way no ray is traced at all: a ball beside things that are lower, bodies of every kind that do
# not hide the sky from themselves, each alone.
untraced() # NAME
{
    ok "$1" "$PREFENV" diff lookup.exr alone.exr --fail-above 0
    case $said in
        *'Reflected Rays'*) tap_result 1 '... and no ray is traced' || note "$said" ;;
        *) tap_result 0 '... and no ray is traced' ;;
    esac
}
plain='exr "maps.exr"' corrected='exr "maps.exr" interreflection 16 hdr "chart.hdr"'
beside='cylinder { <-9, -3, 2>, <9, -3, 2>, 0.5 } box { <-2, -9, -2>, <2, -5, 2> }
    difference { sphere { 0, 1 } sphere { 0, 0.9 } translate <0, -8, 0> }
    light_source { <9, 9, 9>, 1 } plane { z, 300 } sphere { <0, 0, -2>, 0.2 no_reflection no_image }'
one lookup.exr "$plain" "$beside"
one alone.exr "$corrected" "$beside"
note 'POV-Ray says so at the end'
like "$said" 'Reflected Rays' '... and those that a wall behind calls for are counted'
for shape in 'sphere { 0, 1 scale <1, 0.7, 0.8> }' 'box { -0.6, 0.6 rotate <30, 40, 0> }' \
    'cylinder { -x, x, 0.6 rotate 30*y }' \
    'cone { -x, 0.6, x, 0.2 rotate 30*y }' 'disc { 0, <1, 1, -2>, 0.8 }' \
    'mesh { Triangles() }' 'union { Triangles() }' \
    'intersection { sphere { 0, 1 } box { -0.7, 0.7 rotate <30, 40, 0> } plane { <1, 1, -1>, 0.3 } }'; do
    smooth lookup.exr '' "$shape"
    smooth alone.exr 'interreflection 16 hdr "chart.hdr"' "$shape"
    untraced "alone: ${shape%% *}"
done

# ---- things in the way ----

sphere 'exr "other.exr" interreflection 32 hdr "other.hdr" rotate <0, 120, 90>' \
    'sphere { 0, 1e5 hollow pigment { prefiltered_environment { hdr "other.hdr" } } finish { ambient 1 diffuse 0 } }'
is_exact 'a shell all around: what it shows, exact but for noise' 12 exact other.hdr --alpha 0.3

things='plane { y, -1.1 pigment { rgb <0.3, 0.1, 0> } finish { ambient 1 diffuse 0 } translate Place }
    box { <0.9, -1, -1.5>, <2, 1, -0.5> pigment { rgb <0, 0, 2> } finish { ambient 1 diffuse 0 } translate Place }'
block='exr "maps.exr" interreflection 16 hdr "chart.hdr"'
one truth.exr 'hdr "chart.hdr" roughness 0.3 samples 600 traced' "$things"
one plain.exr 'exr "maps.exr"' "$things"
one corrected.exr "$block" "$things"
one same.exr "$block" "$things" +WT1
one many.exr 'exr "maps.exr" interreflection 160 hdr "chart.hdr"' "$things"
ok 'the same picture with another number of threads' "$PREFENV" diff corrected.exr same.exr --fail-above 0
plain=$(rmse plain.exr truth.exr) corrected=$(rmse corrected.exr truth.exr) many=$(rmse many.exr truth.exr)
note "relative RMSE: the lookup $plain, corrected by 16 rays $corrected, by 160 $many"
ok '16 rays take two thirds of the error' holds "$corrected < $plain / 3"
ok '160 rays take nine tenths' holds "$many < $plain / 10"

# The mean of many pictures is nearer than one, nearly as much as with noise alone, 1 / sqrt 8: there is little bias.
sphere "$block" "$things"
places mean 8
average mean
bias=$(rmse mean.exr truth.exr)
note "relative RMSE of the mean of 8 pictures: $bias"
ok '... and the mean of 8 pictures has 2 / 5 of it' holds "$bias < 0.4 * $corrected"

# Light that comes through a hole alone, and so is rare: how bright the picture is on average hangs neither on the rays
# that stop before they find it nor on those that find it at once and call for more.  (16 and 7 % too bright where what
# rays show decides how many they are, and the light still seen is a ratio.)
oiiotool --create 64x32 3 --fill:color=0.02,0.02,0.02 64x32 --box:color=1,1,1:fill=1 0,0,63,15 -d float -o half.exr
bake half.exr -o upper.exr --alpha 0.3
hole='plane { y, -1.1 pigment { rgb 0.02 } finish { ambient 1 diffuse 0 } translate Place }
    disc { 3*y, y, 1000, 1.5 pigment { rgb 0.02 } finish { ambient 1 diffuse 0 } translate Place }'
sphere 'exr "half.exr" roughness 0.3 samples 600 traced' "$hole"
places truly 4
average truly
for rays_and_bound in '5 0.015' '16 0.015'; do
    read -r count bound <<<"$rays_and_bound"
    sphere "exr \"upper.exr\" interreflection $count exr \"half.exr\"" "$hole"
    places lit 8
    average lit
    ratio=$(awk "BEGIN { print $(brightness lit.exr) / $(brightness truly.exr) }")
    note "light through a hole, $count rays: $ratio of the truth"
    ok "light through a hole is as bright on average as it should be, with $count rays" \
        holds "$ratio > 1 - $bound && $ratio < 1 + $bound"
done

# What hides the dark half of the sky, or the bright one, hides that: few rays tell, and rough metal is neither too dark
# on a floor nor too bright below a ceiling.  (By the share of rays that meet nothing, and its damped covariance with
# the light in them: 0.92 above a floor, and 0.08 of what is above a ceiling leaks in.)
black='pigment { rgb 0 } finish { ambient 0 diffuse 0 } no_image translate Place'
few() # THINGS: `truth`, with 5 rays `lit`, and by the lookup alone `sky`
{
    sphere 'exr "half.exr" roughness 0.3 samples 600 traced' "$1"
    places truly 4
    average truly
    sphere 'exr "upper.exr" interreflection 5 exr "half.exr"' "$1"
    places lit 8
    average lit
    one lookup.exr 'exr "upper.exr"' "$1"
    truth=$(brightness truly.exr) lit=$(brightness lit.exr) sky=$(brightness lookup.exr)
    note "${1%%,*}: truth $truth, 5 rays $lit, lookup $sky"
}
few "plane { y, -1.1 $black }"
ok 'above a floor: not too dark' holds "$lit > 0.95 * $truth && $lit < 1.02 * $truth"
few "plane { x, -1.1 $black }"
ok 'beside a wall: neither' holds "$lit > 0.98 * $truth && $lit < 1.02 * $truth"
few "plane { -y, -1.1 $black }"
ok 'below a ceiling: little leaks' holds "$lit - $truth > -0.001 * $sky && $lit - $truth < 0.06 * ($sky - $truth)"

# Small things that are far brighter than the sky: how bright they are on average hangs on no ray either.  (Where what
# rays found decided their number, they had a sixth of it.)
bright() # NAME RAYS BOUND THINGS
{
    local ratio

    sphere 'hdr "chart.hdr" roughness 0.3 samples 300 traced' "$4"
    places truly 4
    average truly
    sphere "exr \"maps.exr\" interreflection $2 hdr \"chart.hdr\"" "$4"
    places lit 24
    average lit
    one lookup.exr 'exr "maps.exr"' "$4"
    ratio=$(awk -v lit="$(brightness lit.exr)" -v true="$(brightness truly.exr)" -v sky="$(brightness lookup.exr)" \
        'BEGIN { print (lit - sky) / (true - sky) }')
    note "$1, $2 rays: $ratio of what there is to find"
    ok "$1: as bright on average as it is" holds "$ratio > 1 - $3 && $ratio < 1 + $3"
}
bright 'a lamp, 30 times as bright' 5 0.16 \
    'sphere { <2, 2, -2.5>, 0.5 pigment { rgb 1 } finish { ambient 0 diffuse 0 emission 30 } translate Place no_image }'

# A pane that takes a twentieth away: only that is noise.
pane='box { -20, 20 hollow pigment { rgbt <1, 1, 1, 0.95> } finish { ambient 0 diffuse 0 } no_image }'
one truth.exr 'hdr "chart.hdr" roughness 0.3 samples 1000 traced' "$pane"
one plain.exr 'exr "maps.exr"' "$pane"
one corrected.exr 'exr "maps.exr" interreflection 5 hdr "chart.hdr"' "$pane"
plain=$(rmse plain.exr truth.exr) corrected=$(rmse corrected.exr truth.exr)
note "behind a pane: relative RMSE of the lookup $plain, corrected by 5 rays $corrected"
ok 'behind a pane: what it lets through is no noise' holds "$corrected < 0.015 && $plain > 0.03"

# Fog that lets nothing through hides the sky behind it once, as fog does that lets next to nothing through.
ground='fog { fog_type 2 distance 1e-6 fog_offset -1.5 fog_alt 1e-6 up y color rgb '
one black.exr 'exr "maps.exr" interreflection 64 hdr "chart.hdr"' "$ground 0 }"
one dark.exr 'exr "maps.exr" interreflection 64 hdr "chart.hdr"' "$ground 0.001 }"
one plain.exr 'exr "maps.exr"' "$ground 0 }"
black=$(rmse black.exr dark.exr) plain=$(rmse plain.exr dark.exr)
note "relative RMSE of black ground fog beside fog that is nearly black: $black; without rays $plain"
ok 'fog that is black hides what it hides once' holds "$black < 0.01 && $plain > 0.1"

# A triangle far away makes a mesh large; what is near is in the way all the same.
scene far.pov <<'END'
camera { location <0, 2, -4> look_at -0.5*y }
sphere { 0, 1 pigment { rgb 1 } finish { ambient 0 diffuse 0
    reflection { 1 prefiltered_environment { exr "maps.exr" interreflection 16 hdr "chart.hdr" } } } }
mesh {
    #for (I, -8, 7) #for (J, -8, 7)
        triangle { <I, -1, J>, <I + 1, -1, J>, <I, -1, J + 1> }
        triangle { <I + 1, -1, J + 1>, <I + 1, -1, J>, <I, -1, J + 1> }
    #end #end
    #ifdef (Far) triangle { <0, 0, 1e6>, <1, 0, 1e6>, <0, 1, 1e6> } #end
    pigment { rgb 0 } finish { ambient 0 diffuse 0 }
}
END
render far.pov +W$size +H$size +FE +Onear.exr || note "$said"
render far.pov +W$size +H$size +FE +Ofar.exr Declare=Far=1 || note "$said"
ok 'a floor in a mesh is in the way, however large the mesh' "$PREFENV" diff far.exr near.exr --fail-above 0.005
note "$tap_output"

# A sun in one texel, and black things before it: a ray that meets one of them with the sun behind takes no more away
# than there is, and none that passes adds more, so that no place is darker than black or brighter than the lookup, with
# however few rays.
oiiotool --create 64x32 3 --fill:color=0.2,0.2,0.2 64x32 --box:color=3000,3000,3000:fill=1 40,9,40,9 -d float -o sun.exr
bake sun.exr -o sunny.exr --alpha 0.3
things='box { <-3, -1.2, -2>, <-1.1, 3, 3> pigment { rgb 0 } finish { ambient 0 diffuse 0 } translate Place }
    plane { y, -1.1 pigment { rgb 0 } finish { ambient 0 diffuse 0 } translate Place }'
one above.exr 'exr "sunny.exr"' "$things"
one below.exr 'exr "sunny.exr" interreflection 3 exr "sun.exr"' "$things"
oiiotool above.exr below.exr --sub -o left.exr
least=$(oiiotool --stats below.exr left.exr | sed -n 's/^ *Stats Min: *\([^ ]*\) .*/\1/p' | sort -g | head -n 1)
note "least of what is shown and of what is taken away: $least; the sky alone: $(rmse below.exr above.exr) off"
ok 'what hides a sun leaves no speckles' holds "$least > -0.001 && $(rmse below.exr above.exr) > 0.1"

# ---- nothing leaks, nothing counts twice ----

# A sky, baked in the scene, twice as bright as the room that shuts it out: everything is the room's grey, however
# light goes.
oiiotool --create 64x32 3 --fill:color=1,1,1 64x32 -d float -o sky.exr
room() # NAME SETTINGS
{
    scene room.pov <<END
$2
camera { location <0, 0.6, -5> look_at 0 angle 50 }
#declare Glossy = finish { ambient 0 diffuse 0
    reflection { 1 prefiltered_environment { exr "sky.exr" roughness 0.6 interreflection 4 } } }
sphere { 0, 30 hollow pigment { rgb 1 } finish { ambient 0 emission 0.5 diffuse 0 } }
sphere { -0.8*x, 0.8 pigment { rgb 1 } finish { Glossy } }
sphere { 0.8*x, 0.8 pigment { rgb 1 } normal { bumps 0.8 scale 0.1 } finish { Glossy } }
torus { 0.8, 0.25 sturm rotate -30*x translate -1.1*y pigment { rgb 1 } finish { Glossy } }
END
    render room.pov +W40 +H40 +FE +Oroom.exr || note "$said"
    oiiotool --create 40x40 3 --fill:color=0.5,0.5,0.5 40x40 -d half -o grey.exr
    ok "$1" "$PREFENV" diff room.exr grey.exr --fail-above 0.002
}

room 'a room shuts the sky out, at every bounce' 'global_settings { max_trace_level 100 adc_bailout 0 }'
room '... with radiosity' 'global_settings { max_trace_level 100 adc_bailout 0 radiosity { count 20 } }'

# In a room without any light everything is black; but at the last level a lookup stays as it is, and that is white.
dark() # LEVEL WORDS: into level, how bright the picture is on average
{
    scene dark.pov <<END
global_settings { max_trace_level $1 radiosity { count 20 recursion_limit 2 } }
camera { location <0, 0.6, -5> look_at 0 angle 50 }
#declare Glossy = finish { ambient 0 diffuse 0
    reflection { 1 prefiltered_environment { exr "sky.exr" roughness 0.6 $2 } } }
box { <-6, -3, -6>, <6, 6, 6> hollow pigment { rgb 0.8 } finish { ambient 0 diffuse 1 } }
sphere { -0.8*x, 0.8 pigment { rgb 1 } finish { Glossy } }
sphere { 0.8*x, 0.8 pigment { rgb 1 } finish { Glossy } }
torus { 0.8, 0.25 sturm rotate -30*x translate -1.1*y pigment { rgb 1 } finish { Glossy } }
END
    render dark.pov +W40 +H40 +FE +WT1 +Odark.exr || note "$said"
    level=$(oiiotool --stats dark.exr | sed -n 's/^ *Stats Avg: *\([^ ]*\) .*/\1/p')
    note "max_trace_level $1, $2: $level"
}

dark 5 'interreflection 4'
ok 'a dark room at max_trace_level 5: the sky leaks in by a fiftieth' holds "$level < 0.02"
dark 20 'interreflection 4'
is "$level" 0.000000 '... at 20, not at all'
dark 5 'samples 4 traced'
is "$level" 0.000000 '... nor, at 5, if everything is traced'

# Under a white sky a white floor is white, and so is what glossy balls on it show: the light that radiosity gathers
# from the sky and from the metal, and that the metal shows of both, counts once.
scene open.pov <<'END'
global_settings { max_trace_level 20 adc_bailout 0 radiosity { count 60 recursion_limit 4 } }
camera { location <0, 1.2, -5> look_at 0 angle 50 }
sky_sphere { pigment { rgb 1 } }
plane { y, -0.8 pigment { rgb 1 } finish { ambient 0 diffuse 1 } }
#declare Glossy = finish { ambient 0 diffuse 0
    reflection { 1 prefiltered_environment { exr "sky.exr" roughness 0.6 interreflection 4 } } }
sphere { -0.8*x, 0.8 pigment { rgb 1 } finish { Glossy } }
sphere { 0.8*x, 0.8 pigment { rgb 1 } finish { Glossy } }
END
render open.pov +W40 +H40 +FE +WT1 +Oopen.exr || note "$said"
oiiotool --create 40x40 3 --fill:color=1,1,1 40x40 -d half -o white.exr
ok 'radiosity under a white sky: everything is white' "$PREFENV" diff open.exr white.exr --fail-above 0.05
note "$tap_output"

# The caustic of metal on the floor is that of its photons, and comes once.
thrown() # PICTURE WORDS [PHOTONS]
{
    scene thrown.pov <<END
global_settings { ${3:-photons { count 20000 \}} }
camera { orthographic location 5*y direction -y right 4*x up 4*z }
light_source { <3, 4, -3>, 1 }
plane { y, 0 pigment { rgb 1 } finish { ambient 0 diffuse 0.8 } }
cylinder { 0, y/2, 1 open pigment { rgb 1 } photons { target reflection on }
    finish { ambient 0 diffuse 0 reflection { 0.9 $2 } } }
END
    render thrown.pov +W40 +H40 +FE +WT1 "+O$1" || note "$said"
}
thrown mirror.exr ''
thrown lookup.exr 'prefiltered_environment { exr "sky.exr" roughness 0.3 }'
thrown corrected.exr 'prefiltered_environment { exr "sky.exr" roughness 0.3 interreflection 8 }'
thrown dull.exr '' ' '
ok 'a caustic on the floor is that of a mirror' "$PREFENV" diff lookup.exr mirror.exr --fail-above 0
ok '... and with interreflection, once' "$PREFENV" diff corrected.exr mirror.exr --fail-above 0
fails '... which is not nothing' "$PREFENV" diff dull.exr mirror.exr --fail-above-relative 0.1

# A ring throws its caustic on the floor, whose light is that of the photons alone; metal shows it as tracing does.
caustic='global_settings { photons { count 20000 } }
    light_source { <3, 6, -3>, 2 translate Place }
    plane { y, -1.1 pigment { rgb 0.6 } finish { ambient 0 diffuse 0.6 } translate Place }
    cylinder { <0.4, -1.1, -1.6>, <0.4, -0.8, -1.6>, 0.5 open pigment { rgb 1 }
        finish { ambient 0 diffuse 0 reflection 0.9 } photons { target reflection on } translate Place }'
one truth.exr 'hdr "chart.hdr" roughness 0.3 samples 100 traced' "$caustic" +WT1
one corrected.exr 'exr "maps.exr" interreflection 64 hdr "chart.hdr"' "$caustic" +WT1
one without.exr 'exr "maps.exr" interreflection 64 hdr "chart.hdr"' "${caustic/count 20000/count 1}" +WT1
photons=$(rmse corrected.exr truth.exr) without=$(rmse without.exr truth.exr)
note "relative RMSE with photons: $photons; without any: $without"
ok 'photons are seen as they are traced' holds "$photons < 0.05 && $without > 1.5 * $photons"

# Grey matter under radiosity, seen in metal: as tracing sees it.
floor='global_settings { radiosity { count 40 error_bound 0.8 } }
    plane { y, -1.1 pigment { rgb 0.6 } finish { ambient 0 diffuse 1 } translate Place }
    sky_sphere { pigment { prefiltered_environment { hdr "chart.hdr" } } }'
one truth.exr 'hdr "chart.hdr" roughness 0.3 samples 100 traced' "$floor" +WT1
one corrected.exr 'exr "maps.exr" interreflection 64 hdr "chart.hdr"' "$floor" +WT1
radiosity=$(rmse corrected.exr truth.exr)
note "relative RMSE with radiosity: $radiosity"
ok 'radiosity is seen as it is traced' holds "$radiosity < 0.05"

done_testing
