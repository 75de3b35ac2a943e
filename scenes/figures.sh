#!/bin/bash
# figures.sh - `make figures`: Fig. 4, 5, 6 and 7 of [Motegi] with the bunny and a cylinder under the courtyard,
# ours beside them, and the tables of errors.  scenes/README.md says what each shows.
#
# Written into figures/ of the build tree: NAME.png, NAME.exr (linear, half floats) and NAME.txt (the command that made
# it) for every picture, table.md and table.json.  What is up to date is left as it is, and said to be; a picture is up
# to date if it is no older than its scene, its maps and the renderer, and was made by the same command.
#
# HDRI and ALPHA, which `make bunny` listens to, change nothing here: the figures are of one experiment.
#
# Fails if the errors are not in the paper's order, baseline > nearest > a = 50, with ours below, in Fig. 7 too.

set -euo pipefail

die()
{
    printf 'make figures: %s\n' "$*" >&2
    exit 1
}

. "${srcdir:?call this through make}/scenes/common.sh"
. "$srcdir/scenes/pictures.sh"

hdri=$PREFENV_DATA/hdri/courtyard.exr
alpha=0.1
brushed=0.1,0.03
samples=2048
traced=256
side=1024

figures=$top_builddir/figures
work=$figures/work
scenes=$srcdir/scenes
started=$(now)
mkdir -p "$work"
cd "$figures"
trap 'rm -f work/*.part.*' EXIT
trap 'exit 130' INT TERM HUP
[ -f "$hdri" ] || die "$hdri does not exist: run ./bootstrap, which fetches it"

# ---- maps and pictures ----

# What every picture is made from.
inputs=("$scenes"/{bunny_scene,fig7_scene,ndf_plot}.inc work/bunny_mesh.inc
    work/{maps,hemispheres,baseline,brushed42,brushed,environment}.exr)

make_mesh work
if [ ! work/environment.exr -ef "$hdri" ]; then ln -sf "$hdri" work/environment.exr; fi
bake "$hdri" maps --alpha $alpha --paper
bake "$hdri" hemispheres --alpha $alpha
bake "$hdri" baseline --alpha $alpha --method baseline
bake "$hdri" brushed42 --alpha $brushed --paper
bake "$hdri" brushed --alpha $brushed

# One ray a pixel, through its middle, so that all of them see the same points.
exr mask mask.pov $side $side -A
exr fig6c fig6c.pov $side $side -A
exr fig6d fig6d.pov $side $side -A
exr fig6e fig6e.pov $side $side -A
exr fig6f fig6f.pov $side $side -A
exr fig4b fig4b.pov $side $side -A
exr fig5a fig5a.pov 1024 512 -A
exr fig5b fig5b.pov 960 800 +A0.1 +AM2 -J
exr fig5c fig5c.pov 960 800 +A0.1 +AM2 -J
exr fig6a fig6a.pov $side $side -A Declare=Samples=$traced
exr fig6b-half fig6b.pov $side $side -A Declare=Samples=$((samples / 2))
exr fig6b fig6b.pov $side $side -A Declare=Samples=$samples
exr fig7_mask fig7_mask.pov $side $side -A
exr fig7a-half fig7a.pov $side $side -A Declare=Samples=$((samples / 2))
exr fig7a fig7a.pov $side $side -A Declare=Samples=$samples
exr fig7b fig7b.pov $side $side -A
exr fig7c fig7c.pov $side $side -A

# baking NAME WIDTH HEIGHT: a scene that bakes by itself; as a picture only.
baking()
{
    local name=$1 scene=$scenes/$1.pov options="+W$2 +H$3 +A0.1 -J +Lwork" command

    command="$POVRAY_PREFENV +I$scene +O$figures/$name.png $options"
    if newer "$name.png" "$scene" "$scenes/include/prefenv.inc" "$POVRAY_PREFENV" "$hdri" &&
        same "$command" "$name.txt"; then
        say "$name" 'up to date'
        return
    fi
    # shellcheck disable=SC2086 # a list of words
    render "work/$name.log" "$scene" "work/$name.part.png" $options
    mv "work/$name.part.png" "$name.png"
    echo "$command" >"$name.txt"
    say "$name" "baked and traced; tracing took $trace_seconds s"
}

baking gallery 900 600
ln -sf "$PREFENV_DATA/hdri/studio.exr" work/studio.exr
baking turned 900 600

# ---- the table ----

fig6_pictures='fig6a fig6b-half fig6c fig6d fig6e fig6f'
fig7_pictures='fig7a-half fig7b fig7c'

measure() # REFERENCE MASK NAME...
{
    local reference=$1 mask=$2 name

    shift 2
    for name; do
        "$PREFENV" diff "$name.exr" "$reference.exr" --mask "$mask.exr" --json >"work/$name.diff.json" ||
            die "$name.exr could not be compared with $reference.exr; see above"
    done
}
# shellcheck disable=SC2086 # lists of names
measure fig6b mask $fig6_pictures
# shellcheck disable=SC2086
measure fig7a fig7_mask $fig7_pictures

what() # NAME
{
    case $1 in
        fig6a) echo "(a) every bounce, $traced rays a point" ;;
        fig6b) echo "(b) reference, $samples samples" ;;
        fig6b-half) echo "(b) with $((samples / 2)) samples" ;;
        fig6c) echo '(c) baseline' ;;
        fig6d) echo '(d) nearest' ;;
        fig6e) echo '(e) weighted, a = 50' ;;
        fig7a) echo "(a) reference, $samples samples" ;;
        fig7a-half) echo "(a) with $((samples / 2)) samples" ;;
        fig7b) echo '(b) 42 maps, weighted, a = 50' ;;
        fig6f | fig7c) echo 'ours: hemispheres' ;;
    esac
}

baked() # NAME: seconds of its bake, or nothing
{
    case $1 in
        fig6c) cat work/baseline.seconds ;;
        fig6[de]) cat work/maps.seconds ;;
        fig6f) cat work/hemispheres.seconds ;;
        fig7b) cat work/brushed42.seconds ;;
        fig7c) cat work/brushed.seconds ;;
    esac
}

levels() # NAME: mean |difference| in 256 levels, over the channels too
{
    sed -n 's/^ *"level_mean": \[\([^]]*\)\].*/\1/p' work/$1.diff.json | awk -F, '{ printf "%.3f", ($1 + $2 + $3) / 3 }'
}

rows() # REFERENCE NAME...: of table.md
{
    local reference=$1 name

    shift
    echo
    echo '| picture | MSE | relative RMSE | levels | trace, s | bake, s |'
    echo '|---|---|---|---|---|---|'
    echo "| $(what "$reference") | | | | $(cat "work/$reference.seconds") | |"
    for name; do
        printf '| %s | %.3g | %s %% | %s | %s | %s |\n' "$(what "$name")" "$(value "work/$name.diff.json" mse)" \
            "$(awk -v r="$(value "work/$name.diff.json" relative_rmse)" 'BEGIN { printf "%.2f", 100 * r }')" \
            "$(levels "$name")" "$(cat "work/$name.seconds")" "$(baked "$name")"
    done
}

entries() # REFERENCE NAME...: of table.json
{
    local reference=$1 name bake_seconds

    shift
    for name; do
        bake_seconds=$(baked "$name")
        echo "    {\"name\": \"$name\", \"what\": \"$(what "$name")\", \"mse\": $(value "work/$name.diff.json" mse)," \
            "\"relative_rmse\": $(value "work/$name.diff.json" relative_rmse)," \
            "\"relative_l2\": $(value "work/$name.diff.json" relative_l2), \"level_mean\": $(levels "$name")," \
            "\"trace_seconds\": $(cat "work/$name.seconds"), \"bake_seconds\": ${bake_seconds:-null}},"
    done
    echo "    {\"name\": \"$reference\", \"what\": \"$(what "$reference")\"," \
        "\"trace_seconds\": $(cat "work/$reference.seconds")}"
}

error_estimate=$(value work/maps.json error_estimate)
pixels=$(value work/fig6c.diff.json pixels)
{
    echo '# Fig. 6: errors against (b), over the pixels of the object'
    echo
    echo "Stanford bunny, $side x $side, $pixels pixels of the object, alpha $alpha, environment $(basename "$hdri");" \
        'MSE in linear radiance.'
    echo "Relative RMSE: RMSE / mean of (b). Levels: mean |difference| in 256 levels of sRGB, clipped as a display" \
        'does.'
    echo '(a) is the truth about more: its difference is what (b) leaves out, the bunny in the bunny.'
    echo "Seconds on $(nproc) processors: POV-Ray's \"Trace Time\" at one ray a pixel; bake as measured." \
        "The bake's own estimate of its relative error is $(printf %.2g "$error_estimate")."
    # shellcheck disable=SC2086
    rows fig6b $fig6_pictures
    echo
    echo '# Fig. 7: errors against (a), over the pixels of the object'
    echo
    echo "Cylinder, $side x $side, $(value work/fig7b.diff.json pixels) pixels of the object," \
        'alpha 0.1 along its axis and 0.03 around it; the rest as above.'
    # shellcheck disable=SC2086
    rows fig7a $fig7_pictures
} >work/table.part.md
{
    echo '{'
    echo "  \"environment\": \"$(basename "$hdri")\", \"alpha\": $alpha, \"width\": $side, \"height\": $side,"
    echo "  \"pixels\": $pixels, \"processors\": $(nproc), \"bake_error_estimate\": $error_estimate,"
    echo '  "pictures": ['
    # shellcheck disable=SC2086
    entries fig6b $fig6_pictures
    echo '  ],'
    echo "  \"fig7_pixels\": $(value work/fig7b.diff.json pixels),"
    echo '  "fig7_pictures": ['
    # shellcheck disable=SC2086
    entries fig7a $fig7_pictures
    echo '  ]'
    echo '}'
} >work/table.part.json
mv work/table.part.md table.md
mv work/table.part.json table.json

# ---- side by side ----

mse() # NAME
{
    value work/$1.diff.json mse
}

# numbers FIGURE: standard input into work/FIGURE_numbers.inc, which is left alone if it says so already
numbers()
{
    cat >work/numbers.part.inc
    if cmp -s work/numbers.part.inc "work/$1_numbers.inc"; then rm work/numbers.part.inc; else
        mv work/numbers.part.inc "work/$1_numbers.inc"
    fi
}

numbers fig6 <<END
// written by figures.sh
#declare Traced_Samples = $traced;
#declare Reference_Samples = $samples;
#declare Mse_C = $(mse fig6c);
#declare Mse_D = $(mse fig6d);
#declare Mse_E = $(mse fig6e);
#declare Mse_F = $(mse fig6f);
END
numbers fig7 <<END
// written by figures.sh
#declare Reference7_Samples = $samples;
#declare Mse7_B = $(mse fig7b);
#declare Mse7_C = $(mse fig7c);
END
sheet fig4 fig6d.png fig4b.png fig6e.png
sheet fig6 fig6a.png fig6b.png fig6c.png fig6d.png fig6e.png fig6f.png work/fig6_numbers.inc
sheet fig7 fig7a.png fig7b.png fig7c.png work/fig7_numbers.inc
sheet readme fig6b.png fig6f.png work/fig6_numbers.inc

echo
cat table.md
echo
echo "$figures: Fig. 4, 5, 6, 7 and the tables, in $(seconds_since "$started") s"

awk -v c="$(mse fig6c)" -v d="$(mse fig6d)" -v e="$(mse fig6e)" -v f="$(mse fig6f)" \
    'BEGIN { exit !(c > d && d > e && e > f) }' ||
    die "the errors are not in the paper's order, (c) > (d) > (e), with ours below: see figures/table.md"
awk -v b="$(mse fig7b)" -v c="$(mse fig7c)" 'BEGIN { exit !(b > c) }' ||
    die 'in Fig. 7 the error of ours is not below that of 42 maps with a = 50: see figures/table.md'
