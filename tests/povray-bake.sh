#!/bin/bash
# A plain environment is baked while the scene is parsed: the picture is that of `prefenv bake`, each bake is made once a
# scene, said, written nowhere, and ended by an interruption.

. "$srcdir/tests/tap.sh"
. "$srcdir/tests/povray/render.sh"

size=48
chart chart.hdr 32 16
cp chart.hdr other.hdr

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

for case in '0.2|0.2' '0.3, 0.1|0.3,0.1' '<0.1, 0.3>|0.1,0.3'; do
    words=${case%|*}
    bake chart.hdr -o maps.exr --alpha "${case#*|}" --float
    picture file 'exr "maps.exr" rotate 30*y'
    picture memory "hdr \"chart.hdr\" roughness $words rotate 30*y"
    ok "roughness $words: the picture of prefenv bake" "$PREFENV" diff memory.exr file.exr --fail-above 1e-3 &&
        note "$tap_output"
    is "$(bakes)" 1 '... baked once, and said'
    like "$said" 'prefiltered_environment: chart.hdr baked .* in [0-9.]+ seconds, with an estimated error of [0-9.e-]+ %' \
        '... with how long it took, and how good it is'
done
picture nearest 'hdr "chart.hdr" roughness 0.1, 0.3 method Prefenv_Nearest'
picture linear 'hdr "chart.hdr" roughness 0.1, 0.3 method Prefenv_Linear'
fails 'method goes with a bake, too' "$PREFENV" diff nearest.exr linear.exr --fail-above 1e-3

# ---- shared ----

block='hdr "chart.hdr" roughness 0.2'
picture same "$block" "$block rotate 90*x" "hdr \"chart\" roughness 0.2, 0.2"
is "$(bakes)" 1 'three textures of the same words: one bake'
picture several "$block" 'hdr "chart.hdr" roughness 0.25' 'hdr "other.hdr" roughness 0.2' "$block"
is "$(bakes)" 3 'another roughness, another file: bakes of their own'
picture samples "$block samples 4"
is "$(bakes)" 0 'samples: no bake'
is "$(find . -newer spheres.pov -type f ! -name samples.exr)" '' 'nothing but the picture is written'

# ---- interrupted ----

# So many texels and a narrow lobe: a bake of seconds.
chart large.hdr 2048 1024
spheres 'hdr "large.hdr" roughness 0.02'
"$POVRAY_PREFENV" +Ispheres.pov -D +W8 +H8 +Ointerrupted.png >interrupted.log 2>&1 &
renderer=$!
for _ in {1..200}; do
    if grep -q 'prefiltered_environment: baking' interrupted.log; then break; fi
    sleep 0.05
done
kill -INT $renderer
start=$(date +%s%N)
wait $renderer
status=$?
took=$((($(date +%s%N) - start) / 1000000))
fails 'an interruption ends a bake' [ "$status" -eq 0 ]
ok '... within two seconds' [ $took -lt 2000 ] || note "$took ms"
is "$(grep -c 'baked' interrupted.log)" 0 '... which was not done by then'
fails '... and leaves no picture' [ -s interrupted.png ]

done_testing
