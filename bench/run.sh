#!/bin/bash
# bench/run.sh - `make bench`: ratios, each against a named rival in the same run, into bench.json of the build tree,
# and as a table on the terminal.  About four minutes on two idle cores.
#
# Only the ratios mean anything on another machine, and not even they on a busy one.

set -euo pipefail

die()
{
    printf 'make bench: %s\n' "$*" >&2
    exit 1
}

POVRAY_PREFENV=${POVRAY_PREFENV:-none}
. "${srcdir:?call this through make}/scenes/common.sh"
: "${BENCH:?call this through make}"

hdri=$PREFENV_DATA/hdri/courtyard.exr
lines=1000000
exact_lines=200
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
trap 'exit 130' INT TERM HUP
cd "$work"

value() # FILE KEY
{
    sed -n 's/^ *"'"$2"'": *\([^,]*\),\{0,1\}$/\1/p' "$1"
}

ratio() # A B
{
    awk -v a="$1" -v b="$2" 'BEGIN { printf "%.3g", a / b }'
}

# timed RUNS COMMAND...: sets wall_seconds and cpu_seconds to the least of the runs
timed()
{
    local runs=$1 TIMEFORMAT='%R %U %S' run

    shift
    for ((run = 0; run < runs; run++)); do
        { time "$@" >command.log 2>&1; } 2>times.part || die "$1 failed: $(tail -n 3 command.log)"
        cat times.part
    done >times.txt
    wall_seconds=$(sort -g times.txt | awk 'NR == 1 { print $1 }')
    cpu_seconds=$(awk '{ print $2 + $3 }' times.txt | sort -g | sed -n 1p)
}

results=()
table=()
absent=()

# result NAME VALUE UNIT RIVAL ITS-VALUE RATIO: VALUE and ITS-VALUE in UNIT; RATIO is how many times better ours is
result()
{
    results+=("{\"name\": \"$1\", \"value\": $2, \"unit\": \"$3\", \"rival\": \"$4\", \"rival_value\": $5, $(
        )\"ratio\": $6}")
    table+=("$(printf '%-46s %10.4g %-10s %-46s %10.4g %8.3g' "$1" "$2" "$3" "$4" "$5" "$6")")
}

# fact NAME VALUE UNIT: without a rival
fact()
{
    results+=("{\"name\": \"$1\", \"value\": $2, \"unit\": \"$3\"}")
    table+=("$(printf '%-46s %10.4g %-10s' "$1" "$2" "$3")")
}

# ---- the library ----

echo 'the filter ...' >&2
"$BENCH" "$hdri" >bench.json || die 'bench failed; see above'
ours=$(value bench.json exact_pairs_per_second_one_thread)
theirs=$(value bench.json naive_pairs_per_second_one_thread)
result 'exact filter, one thread' "$ours" 'pairs/s' 'bench/naive.c, -O3' "$theirs" "$(ratio "$ours" "$theirs")"
fact 'its worst relative difference to ours' "$(value bench.json naive_worst_relative_difference)" ''
both=$(value bench.json exact_pairs_per_second)
result 'exact filter, all threads' "$both" 'pairs/s' 'one thread' "$ours" "$(ratio "$both" "$ours")"
fact 'exact bake, 42 x 400x200 from 400x200' "$(value bench.json exact_400x200_from_400x200_seconds)" s
fact 'fast bake, 42 x 400x200 from 1024x512' "$(value bench.json fast_400x200_from_1024x512_seconds)" s
ours=$(value bench.json fast_200x100_seconds)
theirs=$(value bench.json exact_200x100_seconds)
result 'fast bake, 42 x 200x100 from 1024x512' "$ours" s 'exact bake' "$theirs" "$(ratio "$theirs" "$ours")"
fact 'its relative L2 error' "$(value bench.json fast_relative_l2)" ''
fact 'its own estimate of that' "$(value bench.json fast_own_estimate)" ''

for views in coherent random; do
    ours=$(value bench.json lookups_$views)
    theirs=$(value bench.json paper_lookups_$views)
    result "lookups, default maps, $views views" "$ours" '/s a core' "the paper's 42 maps, weighted, a = 50" "$theirs" \
        "$(ratio "$ours" "$theirs")"
done

# ---- the command ----

echo 'the lookup ...' >&2
"$PREFENV" bake "$hdri" -o hemispheres.exr --quiet || die 'the bake failed; see above'
awk -v count=$lines 'BEGIN {
    srand(1)
    for (i = 0; i < count; i++)
        print rand() - 0.5, rand() - 0.5, rand() - 0.5, rand() - 0.5, rand() - 0.5, rand() - 0.5
}' >lines.txt
start=$(now)
"$PREFENV" eval hemispheres.exr <lines.txt >eval.txt || die 'prefenv eval failed; see above'
eval_rate=$(ratio $lines "$(seconds_since "$start" 4)")
start=$(now)
head -n $exact_lines lines.txt | "$PREFENV" exact "$hdri" --alpha 0.1 >exact.txt 2>exact.log ||
    die "prefenv exact failed: $(cat exact.log)"
exact_rate=$(ratio $exact_lines "$(seconds_since "$start" 4)")
result 'prefenv eval' "$eval_rate" 'lines/s' 'prefenv exact' "$exact_rate" "$(ratio "$eval_rate" "$exact_rate")"

# A frame of a sequence of 20, the baker's making and the estimate of errors included, against a bake alone.
echo 'sequences ...' >&2
for ((k = 1; k <= 20; k++)); do
    ln -s "$hdri" frame_$k.exr
done
for settings in '' --paper; do
    # shellcheck disable=SC2086 # none or one word
    timed 3 "$PREFENV" bake "$hdri" -o alone.exr --quiet $settings
    alone_wall=$wall_seconds
    alone_cpu=$cpu_seconds
    # shellcheck disable=SC2086
    timed 3 "$PREFENV" bake frame_%d.exr -o frame_%d.pe.exr --frames 1-20 --force --quiet $settings
    ours=$(ratio "$wall_seconds" 20)
    result "a frame of a sequence${settings:+, $settings}" "$ours" s 'a bake alone' "$alone_wall" \
        "$(ratio "$alone_wall" "$ours")"
    ours=$(ratio "$cpu_seconds" 20)
    result 'the same by processor time' "$ours" 'CPU s' 'a bake alone' "$alone_cpu" "$(ratio "$alone_cpu" "$ours")"
done
rm -f frame_*

# ---- rivals: an isotropic map seen head on, and no bake at all ----

# Each is compared with the exact sum of its own definition.  cmgen reads fewer kinds of EXR than prefenv does.
: "${RIVALS:?call this through make}"
face=256
map=886x443 # as many texels as six faces
texels=$((6 * face * face))
alpha=0.1
roughness=0.316227766 # cmgen's: its square is GGX's alpha
if command -v cmgen oiiotool >/dev/null; then
    echo 'cmgen ...' >&2
    oiiotool "$hdri" --fixnan black --clamp:min=0 -d float --compression zip -o plain.exr >/dev/null ||
        die 'oiiotool could not convert the environment; see above'
    timed 2 cmgen --quiet --format=exr --size=$face --extract=cube --extract-blur=$roughness plain.exr
    cmgen_rate=$(ratio $texels "$wall_seconds")
    cmgen_cpu_rate=$(ratio $texels "$cpu_seconds")
    # A third of cmgen's error, 6 %, is asked for; rates are those of whole commands, which both read plain.exr and
    # write OpenEXR.
    timed 5 "$PREFENV" bake plain.exr -o head-on.exr --method baseline --ndf ggx --alpha $alpha --size $map \
        --error 0.02 --quiet
    our_rate=$(ratio $((${map%x*} * ${map#*x})) "$wall_seconds")
    our_cpu_rate=$(ratio $((${map%x*} * ${map#*x})) "$cpu_seconds")
    "$RIVALS" cube plain.exr cube/plain $alpha >cube.json || die 'rivals failed; see above'
    "$RIVALS" baseline plain.exr head-on.exr >head-on.json || die 'rivals failed; see above'
    ours=$(value head-on.json relative_l2)
    theirs=$(value cube.json relative_l2)
    rival="filament's cmgen, 1024 samples"
    result 'baseline map, GGX, alpha 0.1, whole command' "$our_rate" 'texels/s' "$rival" "$cmgen_rate" \
        "$(ratio "$our_rate" "$cmgen_rate")"
    result 'the same by processor time' "$our_cpu_rate" 'texels/CPU s' "$rival" "$cmgen_cpu_rate" \
        "$(ratio "$our_cpu_rate" "$cmgen_cpu_rate")"
    result 'its relative L2 error' "$ours" '' "$rival" "$theirs" "$(ratio "$theirs" "$ours")"
else
    absent+=("filament's cmgen: apt-get install libfilament-tools openimageio-tools")
fi

echo 'filtered importance sampling ...' >&2
"$RIVALS" views "$hdri" hemispheres.exr >views.json || die 'rivals failed; see above'
for samples in 16 32 96; do
    rival="filtered importance sampling, $samples lookups"
    ours=$(value views.json maps_per_second)
    theirs=$(value views.json fis_${samples}_per_second)
    result 'lookup in the maps, one thread' "$ours" 'views/s' "$rival" "$theirs" "$(ratio "$ours" "$theirs")"
    ours=$(value views.json maps_relative_l2)
    theirs=$(value views.json fis_${samples}_relative_l2)
    result 'its relative L2 error' "$ours" '' "$rival" "$theirs" "$(ratio "$theirs" "$ours")"
done

# ---- the renderer ----

# traced RUNS NAME SCENE OPTION...: the CPU seconds of tracing at `side` pixels, the least of RUNS; picture-NAME.exr
traced()
{
    local runs=$1 name=$2 scene=$3 run

    shift 3
    for ((run = 0; run < runs; run++)); do
        render "$name.log" "$scene" "picture-$name.exr" +W$side +H$side -A +L. "$@"
        echo "$trace_cpu_seconds"
    done | sort -g | sed -n 1p
}

# error_of NAME: relative RMSE of picture-NAME.exr against the reference, over the object's pixels
error_of()
{
    "$PREFENV" diff "picture-$1.exr" picture-truth.exr --mask picture-mask.exr --json >diff.json ||
        die "picture-$1.exr could not be compared; see above"
    value diff.json relative_rmse
}

# At `side` pixels: the reflection against none, a mirror, and the ways to look it up.
bench_bunny()
{
    local bunny="bunny ${side}x$side" none linear baseline weighted mirror reference this

    none=$(traced 5 none "$srcdir/bench/none.pov")
    linear=$(traced 5 linear "$scenes/fig6f.pov")
    baseline=$(traced 5 baseline "$scenes/fig6c.pov")
    # Eq. 7 asks every map, so it is measured with the paper's 42.
    weighted=$(traced 2 weighted "$scenes/fig6e.pov")
    mirror=$(traced 5 mirror "$srcdir/bench/mirror.pov")
    reference=$(traced 2 reference "$scenes/fig6b.pov" Declare=Samples=64)
    this="$bunny, prefiltered, linear"
    result "$this" "$linear" 'CPU s' 'no reflection at all' "$none" "$(ratio "$none" "$linear")"
    result "$this" "$linear" 'CPU s' 'a plain mirror, traced' "$mirror" "$(ratio "$mirror" "$linear")"
    result "$this" "$linear" 'CPU s' 'Monte Carlo, 64 samples' "$reference" "$(ratio "$reference" "$linear")"
    result "$bunny, the paper's maps, a = 50" "$weighted" 'CPU s' 'prefiltered, linear' "$linear" \
        "$(ratio "$linear" "$weighted")"
    fact "$bunny, baseline" "$baseline" 'CPU s'
}

# At fewer pixels, for the trick takes its time: 256 mirrors, as the bunny is and with no reflection of itself, whose
# picture is that of single scattering and may be compared with the reference.
bench_trick()
{
    local this="bunny ${side}x$side, prefiltered, linear" rival="the users' trick: 256 bumped mirrors"
    local linear trick alone ours

    linear=$(traced 5 linear "$scenes/fig6f.pov")
    trick=$(traced 1 trick "$srcdir/bench/trick.pov" Declare=Count=256)
    alone=$(traced 2 alone "$srcdir/bench/trick.pov" Declare=Count=256 Declare=Alone=1)
    traced 1 truth "$scenes/fig6b.pov" Declare=Samples=4096 >/dev/null
    traced 1 mask "$scenes/mask.pov" >/dev/null
    ours=$(error_of linear)
    result "$this" "$linear" 'CPU s' "$rival" "$trick" "$(ratio "$trick" "$linear")"
    result "$this" "$linear" 'CPU s' '... that do not see the bunny' "$alone" "$(ratio "$alone" "$linear")"
    result '... its relative RMSE' "$ours" '' '... theirs' "$(error_of alone)" "$(ratio "$(error_of alone)" "$ours")"
}

if [ "$POVRAY_PREFENV" != none ]; then
    echo 'the renderer ...' >&2
    make_mesh .
    ln -s "$hdri" environment.exr
    "$PREFENV" bake "$hdri" -o baseline.exr --method baseline --quiet
    "$PREFENV" bake "$hdri" -o maps.exr --paper --quiet
    scenes=$srcdir/scenes
    side=1024 bench_bunny
    side=256 bench_trick
fi

{
    echo '{'
    echo "  \"processors\": $(nproc),"
    echo '  "results": ['
    for ((i = 0; i < ${#results[@]}; i++)); do
        [ $i = $((${#results[@]} - 1)) ] && comma='' || comma=,
        echo "    ${results[i]}$comma"
    done
    echo '  ],'
    printf '  "not_installed": ['
    for ((i = 0; i < ${#absent[@]}; i++)); do
        [ $i = 0 ] || printf ', '
        printf '"%s"' "${absent[i]}"
    done
    echo ']'
    echo '}'
} >json.part
mv json.part "$top_builddir/bench.json"

printf '%-46s %10s %-10s %-46s %10s %8s\n' what ours unit rival its ratio
printf '%s\n' "${table[@]}"
[ ${#absent[@]} = 0 ] || printf 'not installed: %s\n' "${absent[@]}"
echo "$top_builddir/bench.json"
