#!/bin/bash
# `highlight`: what a surface reflects of light sources, which are in no environment.  It is what the environment would
# show with that light in it, pixel by pixel, for every surface and every way to look up; and shadows, media, light
# groups and the rest do to it what they do to light.

. "$srcdir/tests/tap.sh"
. "$srcdir/tests/povray/render.sh"

size=24
oiiotool --create 128x64 3 -d float -o black.exr

# One lit texel, which gives the irradiance pi * 0.2, and the direction to it.
lamp_x=81 lamp_y=18
read -r radiance toward < <(awk -v x=$lamp_x -v y=$lamp_y 'BEGIN {
    pi = atan2(0, -1); theta = pi * (y + 0.5) / 64; phi = 2 * pi * (x + 0.5) / 128
    solid_angle = 2 * pi / 128 * (cos(pi * y / 64) - cos(pi * (y + 1) / 64))
    printf "%.10g <%.10g,%.10g,%.10g>\n", pi * 0.2 / solid_angle,
        sin(theta) * cos(phi), cos(theta), sin(theta) * sin(phi)
}')
oiiotool black.exr "--point:color=$radiance,$radiance,$radiance" $lamp_x,$lamp_y -d float -o sun.exr
lamp="light_source { 1e4 * $toward, 0.2 parallel point_at 0 }"

sphere() # NAME BLOCK REST [TEXTURE]
{
    scene sphere.pov <<END
camera { location -3*z direction z right x up y }
sphere {
    0, 1
    texture {
        pigment { rgb <1, 0.7, 0.4> }
        finish { ambient 0 diffuse 0 reflection { 1 prefiltered_environment { $2 } } ${4:-} }
    }
    rotate <20, 50, 0>
    interior { ior 3 }
}
$3
END
    rm -f "$1"
    render sphere.pov +W$size +H$size +FE "+O$1" || note "$said"
}

# ---- pixel by pixel, against prefenv exact ----

is_exact() # NAME ENVIRONMENT OPTION...
{
    "$rays" rays $size 3 0,0,0 "$2" | "$PREFENV" exact sun.exr "${@:3}" >wanted.txt || note "prefenv exact failed"
    ok "$1" "$rays" check sphere.exr 3 0.015 0.005 <wanted.txt
    note "$tap_output"
}

bake black.exr -o black.pe.exr --alpha 0.3 --normals 12 --size 16x16
sphere sphere.exr 'exr "black.pe.exr" highlight' "$lamp"
is_exact 'maps' 0,0,0 --alpha 0.3
sphere sphere.exr 'exr "black.exr" roughness 0.3 highlight on' "$lamp"
is_exact 'baked in the scene' 0,0,0 --alpha 0.3
sphere sphere.exr 'exr "black.exr" roughness 0.35, 0.2 type 2 metallic "copper" samples 1 highlight' "$lamp"
is_exact 'brushed copper, GGX, sampled' 0,0,0 --alpha 0.35,0.2 --ndf ggx --weight microfacet --material copper
sphere sphere.exr 'exr "black.exr" roughness 0.4 type 3 samples 1 traced highlight' "$lamp"
is_exact 'Phong, traced' 0,0,0 --alpha 0.4 --ndf phong
sphere sphere.exr 'exr "black.exr" roughness function { 0.4 } type 2 samples all highlight' "$lamp"
is_exact 'roughness that varies' 0,0,0 --alpha 0.4 --ndf ggx
bake black.exr -o grades.exr --alpha 0.2-0.5 --aspect 1.5
sphere sphere.exr 'exr "grades.exr" roughness function { 0.35 } highlight' "$lamp"
is_exact 'maps of many roughnesses, brushed' 0,0,0 --alpha 0.35 --aspect 1.5

"$PREFENV" surface milled -o milled.exr --size 128x128 --slope 0.3 --roughness 0.8um --quiet &&
    "$PREFENV" ndf milled.exr -o milled.ndf.exr --wrap --turn --quiet || bail_out 'milled.exr was not measured'
sphere sphere.exr 'exr "black.exr" type exr "milled.ndf.exr" samples 1 highlight' "$lamp"
is_exact 'a measured distribution' 0,0,0 --ndf milled.ndf.exr
bake black.exr -o measured.exr --ndf milled.ndf.exr --method representative --size 32x16 --normals 12
sphere maps.exr 'exr "measured.exr" highlight exr "milled.ndf.exr"' "$lamp"
ok '... that maps were baked with' "$PREFENV" diff maps.exr sphere.exr --fail-above 0.001

# ---- as the same light in the environment, whatever else the reflection says ----

# `samples all` sees the lamp there, at the same place.
is_seen() # NAME WORDS [FINISH [TRANSFORMATION]]
{
    sphere wanted.exr "exr \"sun.exr\" $2 samples all ${4:-}" '' "${3:-}"
    sphere got.exr "exr \"black.exr\" $2 samples all highlight ${4:-}" "${lamp%\}} ${4:-} }" "${3:-}"
    ok "$1" "$PREFENV" diff got.exr wanted.exr --fail-above 0.004
    note "$(grep relative <<<"$tap_output")"
}

is_seen 'two roughnesses, a brush that goes around' 'roughness 0.4, 0.2 direction rotate <1, 1, 0>'
is_seen 'a brush along u, turned by a pattern' \
    'roughness 0.2, 0.4 uv_mapping direction x pattern { gradient y scale 3 }'
is_seen 'the environment turned and mirrored' 'roughness 0.2, 0.4' '' 'scale <-1, 1, 1> rotate <0, 120, 0>'
is_seen 'a bumpy surface' 'roughness 0.3' '} normal { bumps 0.6 scale 0.3 } finish {'
is_seen 'a lobe of many roughnesses' 'lambda 0.1, 0.02 function { y > 0 }'
is_seen 'amounts, fresnel, metallic' 'roughness 0.3' 'reflection { rgb 0.1, rgb <1, 0.5, 0.8> fresnel metallic }'
is_seen 'an exponent' 'roughness 0.3' 'reflection { 0.8 exponent 1.5 }'

# ---- what is done to the light is done to its highlight ----

# A surface that fills the picture, looked at straight and lit from there: pi c D(n) / W is c / alpha^2 / 4, which is 1
# for this lamp.
head_on=0.16
straight="light_source { -20*z, $head_on"

# The picture is VALUE all over.
shows() # NAME VALUE WORDS SCENE [TEXTURE [OBJECT]]
{
    scene plane.pov <<END
camera { orthographic location -5*z direction z right x/8 up y/8 }
#declare Plane = plane {
    -z, 0
    texture {
        pigment { rgb 1 }
        finish { ambient 0 diffuse 0 reflection { 1 prefiltered_environment { $3 } } }
    }
    ${5:-}
    ${6:-}
}
$4
#ifndef (Placed) object { Plane } #end
END
    rm -f plane.exr
    render plane.pov +W6 +H6 +FE +Oplane.exr || note "$said"
    oiiotool --create 6x6 3 "--fill:color=$2,$2,$2" 6x6 -d half -o wanted.exr
    ok "$1" "$PREFENV" diff plane.exr wanted.exr --fail-above 0.002 || oiiotool --stats plane.exr | sed 's/^/# /'
}

bake black.exr -o flat.exr --alpha 0.2 --normals 12 --size 16x16
flat='exr "flat.exr" highlight'
lit="$straight parallel point_at 0 }"
for words in "$flat" 'exr "black.exr" roughness 0.2 highlight' "$flat interreflection 4 exr \"black.exr\"" \
    'exr "black.exr" roughness 0.2 samples 4 highlight' 'exr "black.exr" roughness 0.2 samples all highlight' \
    'exr "black.exr" roughness 0.2 samples 4 traced highlight'; do
    shows "a lamp, $words" 1 "$words" "$lit"
done
shows 'none without the word' 0 'exr "flat.exr"' "$lit"
shows 'nor with highlight off' 0 "$flat off" "$lit"
shows 'half of it' 0.5 "$flat 0.5" "$lit"
shows 'two lamps' 2 "$flat" "$lit $lit"
shows 'half the reflection' 0.5 "$flat" "$lit" 'finish { reflection 0.5 }'
shows 'a lamp nearby, not parallel' 1 "$flat" "light_source { -100*z, $head_on }"
shows 'a lamp that fades' 0.4 "$flat" "light_source { -1000*z, $head_on parallel point_at 0
    fade_distance 500 fade_power 2 }"
shows 'a spotlight' 1 "$flat" "$straight spotlight point_at 0 radius 5 falloff 6 }"
shows '... beside its cone' 0 "$flat" "$straight spotlight point_at 20*x radius 5 falloff 6 }"
shows 'a fill light, shadowless, leaves none' 0 "$flat" "$straight shadowless }"
shows 'the lamp of another group' 0 "$flat" "light_group { $lit global_lights off }"
shows '... and of its own' 1 "$flat" "light_group { $lit object { Plane } } #declare Placed = 1;"
shows 'no_shadow' 1 "$flat" "$lit box { <-9, -9, -11>, <9, 9, -10> no_shadow }"
shows 'a shadow' 0 "$flat" "$lit box { <-9, -9, -11>, <9, 9, -10> }"
shows 'a shadow of coloured glass' 0.25 "$flat" \
    "$lit box { <-9, -9, -11>, <9, 9, -10> pigment { rgbf <0.5, 0.5, 0.5, 1> } }"
shows 'smoke before the lamp' 0.606531 "$flat" "${lit%\}} media_interaction on media_attenuation on }
    box { <-9, -9, -11>, <9, 9, -10> pigment { rgbt 1 } hollow interior { media { absorption 0.5 } } }"
coat='texture { pigment { rgbt 1 } finish { ambient 0 diffuse 0 reflection { 0, 1 fresnel } } } interior { ior 1.5 }'
shows 'under a coat, as the reflection' 1 "$flat" "$lit" "$coat"
shows 'over a diffuse surface' 1.08 "$flat" "$lit" 'finish { diffuse 0.5 }'
shows 'max_trace_level 1' 1 "$flat" "global_settings { max_trace_level 1 } $lit"

# A floor beside metal that has a highlight: its light is what radiosity gathers and photons bring, with the highlight
# as without.
floor() # PICTURE WORDS SETTINGS
{
    scene floor.pov <<END
$3
camera { orthographic location 5*y direction -y right 4*x up 4*z }
light_source { <3, 4, -3>, 1 }
plane { y, 0 pigment { rgb 1 } finish { ambient 0 diffuse 0.8 } }
cylinder { 0, y/2, 1 open pigment { rgb 1 } photons { target reflection on }
    finish { ambient 0 diffuse 0 reflection { 1 prefiltered_environment { exr "flat.exr" $2 } } emission Glow } }
END
    render floor.pov +W16 +H16 +FE +WT1 "+O$1" "Declare=Glow=${4:-0}" || note "$said"
}

gathers() # NAME SETTINGS [GLOW]
{
    floor with.exr highlight "$2"
    floor without.exr '' "$2"
    floor other.exr '' "$3" "${4:-0}"
    ok "$1" "$PREFENV" diff with.exr without.exr --fail-above 0
    fails '... which the floor would show' "$PREFENV" diff other.exr without.exr --fail-above-relative 0.02
}

radiosity='global_settings { radiosity { count 60 } }'
gathers 'radiosity gathers no highlight' "$radiosity" "$radiosity" 1
gathers 'photons bring what they bring, and no highlight' 'global_settings { photons { count 5000 } }' ''

# Where a traced ray hits; so narrow a lobe sees it as a mirror does.
shows 'seen in other metal' 1 'exr "black.exr" roughness 0.001 samples 4 traced' "plane { z, -50 pigment { rgb 1 }
        finish { ambient 0 diffuse 0 reflection { 1 prefiltered_environment { $flat } } } }
    light_source { -10*z, $head_on parallel point_at -50*z }"

# ---- area lights ----

# As many point lights, each with its share.
area='light_source { <-10, 12, -20>, 2 area_light <6, 0, 0>, <0, 6, 2>, 5, 5'
points=$(awk 'BEGIN { for (u = -2; u <= 2; u++) for (v = -2; v <= 2; v++)
    printf "light_source { <%g, %g, %g>, 2/25 }\n", -10 + 1.5 * u, 12 + 1.5 * v, -20 + 0.5 * v }')
sphere area.exr 'exr "black.pe.exr" highlight' "$area area_illumination }"
sphere points.exr 'exr "black.pe.exr" highlight' "$points"
sphere middle.exr 'exr "black.pe.exr" highlight' "$area }"
sphere point.exr 'exr "black.pe.exr" highlight' 'light_source { <-10, 12, -20>, 2 }'
ok 'an area light with area_illumination: as many lamps' "$PREFENV" diff area.exr points.exr --fail-above 0.001
ok '... without: as one in its middle' "$PREFENV" diff middle.exr point.exr --fail-above 0.001
fails '... which is not the same' "$PREFENV" diff area.exr point.exr --fail-above 0.005

# ---- threads ----

render sphere.pov +W$size +H$size +FE +Othreads1.exr +WT1 || note "$said"
ok 'the same picture with one thread' "$PREFENV" diff threads1.exr point.exr --fail-above 0

done_testing
