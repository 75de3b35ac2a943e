#!/bin/bash
# A plain environment is baked while the scene is parsed: the picture is that of `prefenv bake`, each bake is made once
# a scene, said, written nowhere, and ended by an interruption.

. "$srcdir/tests/tap.sh"
. "$srcdir/tests/povray/render.sh"

size=48
chart chart.hdr 32 16
cp chart.hdr other.hdr
"$PREFENV" surface milled -o cut.exr || bail_out 'no surface'
"$PREFENV" ndf cut.exr -o cut.ndf.exr || bail_out 'no distribution'

# spheres BLOCK...: one sphere a block, side by side; a picture of them would be picture.exr
spheres()
{
    local block k=0

    {
        echo "camera { orthographic location <$(($# - 1)), 0, -3> right $((2 * $#))*x up 2*y direction z }"
        for block; do
            echo "sphere { $((2 * k))*x, 1 pigment { rgb 1 } finish { ambient 0 diffuse 0"
            echo "  reflection { 1 prefiltered_environment { $block } } } }"
            k=$((k + 1))
        done
    } | scene spheres.pov
}

# picture NAME BLOCK...: NAME.exr of them
picture()
{
    spheres "${@:2}"
    render spheres.pov "+W$((size * ($# - 1)))" +H$size +FE "+O$1.exr" || note "$said"
}

bakes() # how often it said that it bakes
{
    grep -o 'prefiltered_environment: baking' <<<"$said" | wc -l
}

# ---- the same as prefenv bake ----

# WORDS|OPTIONS of prefenv bake
cases=('roughness 0.2|--alpha 0.2' 'roughness 0.3, 0.1|--alpha 0.3,0.1' 'roughness <0.1, 0.3>|--alpha 0.1,0.3'
    'roughness 0.2 type Prefenv_GGX|--alpha 0.2 --ndf ggx' 'type 3 roughness 0.2|--alpha 0.2 --ndf phong'
    'type exr "cut.ndf.exr"|--ndf cut.ndf.exr' 'roughness 0.2 accuracy 0.05|--alpha 0.2 --error 0.05'
    'roughness 0.3 metallic "copper"|--alpha 0.3 --weight microfacet --material copper'
    'roughness 0.3 ior <0.3, 1.02, 1.24>, <3.205, 2.577, 2.397>|--alpha 0.3 --weight microfacet --material copper')
for case in "${cases[@]}"; do
    words=${case%|*}
    read -ra options <<<"${case#*|}"
    bake chart.hdr -o maps.exr "${options[@]}" --float
    picture file 'exr "maps.exr" rotate 30*y'
    picture memory "hdr \"chart.hdr\" $words rotate 30*y"
    ok "$words: the picture of prefenv bake ${case#*|}" "$PREFENV" diff memory.exr file.exr --fail-above 1e-3
    is "$(bakes)" 1 '... baked once, and said'
    like "$said" \
        'prefiltered_environment: chart.hdr baked .* in [0-9.]+ seconds, with an estimated error of [0-9.e-]+ %' \
        '... with how long it took, and how good it is'
done
picture nearest 'hdr "chart.hdr" roughness 0.1, 0.3 method Prefenv_Nearest'
picture linear 'hdr "chart.hdr" roughness 0.1, 0.3 method Prefenv_Linear'
fails 'method goes with a bake, too' "$PREFENV" diff nearest.exr linear.exr --fail-above 1e-3

# Of so few texels no maps are nearer, however much memory they may have.
picture missed 'hdr "chart.hdr" roughness 0.05 accuracy 0.0005'
like "$said" "Parse Warning: The reflection of 'chart.hdr' is off by about [0-9.]+ %, where accuracy 0.0005 asks for \
0.05 %: the maps that are baked for a block come no nearer. samples is exact" 'an accuracy that is missed is warned of'
picture shows 'hdr "chart.hdr" roughness 0.05'
like "$said" "Parse Warning: The reflection of 'chart.hdr' is off by about [0-9.]+ %: accuracy 0.005 in the block" \
    '... and an error that shows, where none was asked for'

# ---- shared ----

block='hdr "chart.hdr" roughness 0.2'
picture same "$block" "$block rotate 90*x" "hdr \"chart\" roughness 0.2, 0.2"
is "$(bakes)" 1 'three textures of the same words: one bake'
picture shiny "$block" "$block metallic \"gold\"" "$block metallic \"silver\"" "$block type 2"
is "$(bakes)" 4 'other metals, another distribution: bakes of their own'
picture several "$block" 'hdr "chart.hdr" roughness 0.25' 'hdr "other.hdr" roughness 0.2' "$block"
is "$(bakes)" 3 'another roughness, another file: bakes of their own'
picture samples "$block samples 4"
is "$(bakes)" 0 'samples: no bake'
is "$(find . -newer spheres.pov -type f ! -name samples.exr)" '' 'nothing but the picture is written'

# ---- interrupted ----

# So many texels, a narrow lobe and what no kernel can do: a bake of many seconds, interrupted when it first says how
# far it is.
chart large.hdr 2048 1024
spheres 'hdr "large.hdr" roughness 0.02 metallic "gold"'
"$POVRAY_PREFENV" +Ispheres.pov -D +W8 +H8 +Ointerrupted.png >interrupted.log 2>&1 &
renderer=$!
for _ in {1..400}; do
    if grep -q 'prefiltered_environment: [0-9]' interrupted.log; then break; fi
    sleep 0.05
done
kill -INT $renderer
start=$(date +%s%N)
wait $renderer
status=$?
took=$((($(date +%s%N) - start) / 1000000))
like "$(grep -o 'prefiltered_environment: [0-9]* % ...' interrupted.log)" \
    '^prefiltered_environment: [0-9]{1,2} % \.\.\.$' \
    'after two seconds a bake says how far it is'
fails 'an interruption ends a bake' [ "$status" -eq 0 ]
ok '... within five seconds' [ $took -lt 5000 ] || note "$took ms"
is "$(grep -c 'baked' interrupted.log)" 0 '... which was not done by then'
fails '... and leaves no picture' [ -s interrupted.png ]

done_testing
