#!/bin/bash
# bench/bounces.sh - `make table1`: what quality costs. [Motegi Table 1, Fig. 6a]
#
#   single     the bunny: Monte Carlo of single scattering (`samples N`) and the prefiltered lookup, and beside them the
#              same traced with every bounce (`samples N traced`): error against processor seconds, for N of SAMPLES
#   bunny      with every bounce: a lookup, the lookup corrected by a few rays (`interreflection N`), everything traced
#   workshop   the same of parts that stand close to each other
#
# Errors are relative RMSE over the metal's pixels: of single scattering against `samples all`, the sum over every
# texel, which has no noise; of what is traced against TRUTH rays at each point, other ones.  Seconds are those of
# tracing, the least of three pictures unless they take long.  Tables on standard output, table1.json and table1.svg in
# the build tree.  Four minutes on two idle cores; SIDE, SAMPLES, RAYS and TRUTH make it shorter or better.

set -euo pipefail

die()
{
    printf 'make table1: %s\n' "$*" >&2
    exit 1
}

. "${srcdir:?call this through make}/scenes/common.sh"

side=${SIDE:-160}
samples=${SAMPLES:-4 64 256 1024 4096}
rays=${RAYS:-2 4 5 8 16 32 64}
truth=${TRUTH:-4096}
command -v oiiotool >/dev/null || die 'oiiotool is not installed: apt-get install openimageio-tools'
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
trap 'exit 130' INT TERM HUP
cd "$work"
ln -s "$srcdir/scenes/bunny_scene.inc" .
make_mesh .

# A quarter of the HDRI's width and height, so that the sum over every texel takes seconds.
hdri=$PREFENV_DATA/hdri/courtyard.exr
oiiotool "$hdri" --resize 256x128 -d float --compression none -o environment.exr >/dev/null ||
    die 'oiiotool could not shrink the environment; see above'
"$PREFENV" bake environment.exr -o maps.exr --alpha 0.1 --quiet
"$PREFENV" bake environment.exr -o workshop.pe.exr --alpha 0.15 --quiet

cat >bunny.pov <<'END'
#version unofficial 3.7;
#ifndef (Mode) #declare Mode = 0; #end
#declare Background = 0;
#macro Bunny_Texture()
  texture {
    pigment { rgb 1 }
    finish {
      ambient 0 emission floor(Mode / 4) diffuse 0
      #if (Mode < 4)
        reflection {
          1
          prefiltered_environment {
            #switch (Mode)
              #case (0) exr "maps.exr" #break
              #case (1) exr "environment.exr" roughness 0.1 samples N #break
              #case (2) exr "environment.exr" roughness 0.1 samples N traced #break
              #case (2.5) exr "maps.exr" interreflection N exr "environment.exr" #break
              #else exr "environment.exr" roughness 0.1 samples all
            #end
            transform Frame
          }
        }
      #end
    }
  }
  translate Shift
#end
#ifndef (Shift) #declare Shift = 0; #end
#include "bunny_scene.inc"
END

# picture NAME SCENE WIDTH HEIGHT OPTION...: NAME.exr; sets trace_cpu_seconds
picture()
{
    local least=

    for _ in 1 2 3; do
        render "$1.log" "$2" "$1.exr" "+W$3" "+H$4" -A +L. "${@:5}"
        least=$(awk -v a="$trace_cpu_seconds" -v b="${least:-1e9}" 'BEGIN { print a < b ? a : b }')
        if awk -v s="$least" 'BEGIN { exit !(s > 1) }'; then break; fi
    done
    trace_cpu_seconds=$least
}

# error_of NAME REFERENCE MASK: relative RMSE
error_of()
{
    "$PREFENV" diff "$1.exr" "$2.exr" --mask "$3.exr" --json | tr ',{}' '\n\n\n' |
        sed -n 's/^ *"relative_rmse": *\([0-9.e+-]*\) *$/\1/p'
}

# row FILE LABEL N NAME REFERENCE MASK: "label n seconds error" into FILE, and what happens to the terminal
row()
{
    local error

    error=$(error_of "$4" "$5" "$6")
    echo "$2 $3 ${trace_cpu_seconds:-0} $error" >>"$1"
    echo "$(basename "$1" .txt): $2 $3: ${trace_cpu_seconds:-0} s, error $error" >&2
}

single()
{
    local n

    picture mask bunny.pov "$side" "$side" Declare=Mode=4
    picture single bunny.pov "$side" "$side" Declare=Mode=3
    picture every bunny.pov "$side" "$side" Declare=Mode=2 "Declare=N=$truth" Declare=Shift=0.0000001
    picture lookup bunny.pov "$side" "$side" Declare=Mode=0
    row single.txt prefiltered 0 lookup single mask
    for n in $samples; do
        picture sampled bunny.pov "$side" "$side" Declare=Mode=1 "Declare=N=$n"
        row single.txt reference "$n" sampled single mask
    done
    for n in $samples; do
        picture traced bunny.pov "$side" "$side" Declare=Mode=2 "Declare=N=$n"
        row single.txt traced "$n" traced every mask
    done
}

# bounces FILE SCENE WIDTH LOOKUP CORRECTED TRACED WORD: a scene with every bounce, by its modes and its word for N, and
# with its mask and truth, mask.exr and every.exr, which are there
bounces()
{
    local n mode

    picture lookup "$2" "$3" "$side" "Declare=Mode=$4"
    row "$1" lookup 0 lookup every mask
    for mode in "interreflection $5" "traced $6"; do
        for n in $rays; do
            picture bounced "$2" "$3" "$side" "Declare=Mode=${mode#* }" "Declare=$7=$n"
            row "$1" "${mode% *}" "$n" bounced every mask
        done
    done
}

workshop()
{
    local width=$((4 * side / 3)) scene=$srcdir/scenes/workshop.pov

    picture mask "$scene" "$width" "$side" Declare=Mode=3
    picture every "$scene" "$width" "$side" Declare=Mode=1 "Declare=Rays=$truth" Declare=Shift=0.0000001
    bounces workshop.txt "$scene" "$width" 0 2 1 Rays
}

# json FILE: its rows
json()
{
    awk '{ printf "%s{\"method\": \"%s\", \"n\": %s, \"seconds\": %s, \"error\": %s}", separator, $1, $2, $3, $4
           separator = ", " }' "$1"
}

# panel LEFT TITLE FILE: error against seconds, both logarithmic, a line for each method
panel()
{
    awk -v left="$1" -v title="$2" '
        function place_x(s) { return left + 60 + 300 * (log(s) - low_x) / (high_x - low_x) }
        function place_y(e) { return 260 - 200 * (log(e) - low_y) / (high_y - low_y) }
        {
            s = $3 > 0.001 ? $3 : 0.001; e = $4 > 1e-4 ? $4 : 1e-4
            seconds[NR] = s; error[NR] = e; method[NR] = $1
            if (NR == 1) { low_x = high_x = log(s); low_y = high_y = log(e) }
            if (log(s) < low_x) low_x = log(s); if (log(s) > high_x) high_x = log(s)
            if (log(e) < low_y) low_y = log(e); if (log(e) > high_y) high_y = log(e)
            if (!($1 in colour)) { names[++count] = $1; colour[$1] = substr("#06c#c30#393", 4 * count - 3, 4) }
        }
        END {
            if (high_x - low_x < 0.1) high_x = low_x + 0.1
            low_y -= 0.2; high_y += 0.2
            printf "<text x=\"%d\" y=\"20\">%s</text>\n", left + 60, title
            for (power = -4; power <= 0; power++) for (part = 1; part <= 3; part += 2) {
                e = part * 10 ^ power
                if (log(e) < low_y || log(e) > high_y) continue
                printf "<path d=\"M%d %.1f h300\" stroke=\"#ccc\"/>", left + 60, place_y(e)
                printf "<text x=\"%d\" y=\"%.1f\" text-anchor=\"end\">", left + 54, place_y(e) + 4
                printf "%g %%</text>\n", 100 * e
            }
            for (power = -3; power <= 4; power++) {
                if (power * log(10) < low_x || power * log(10) > high_x) continue
                x = place_x(10 ^ power)
                printf "<path d=\"M%.1f 60 v200\" stroke=\"#ccc\"/>", x
                printf "<text x=\"%.1f\" y=\"276\" text-anchor=\"middle\">%g s</text>\n", x, 10 ^ power
            }
            for (k = 1; k <= count; k++) {
                name = names[k]
                printf "<text x=\"%d\" y=\"36\" fill=\"%s\">%s</text>\n", left + 100 * k - 40, colour[name], name
                printf "<polyline fill=\"none\" stroke=\"%s\" points=\"", colour[name]
                for (i = 1; i <= NR; i++)
                    if (method[i] == name) printf "%.1f,%.1f ", place_x(seconds[i]), place_y(error[i])
                print "\"/>"
            }
            for (i = 1; i <= NR; i++)
                printf "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"3\" fill=\"%s\"/>\n",
                    place_x(seconds[i]), place_y(error[i]), colour[method[i]]
        }' "$3"
}

# seconds_at ERROR METHOD FILE: where the line through the method's points, both logarithmic, has that error
seconds_at()
{
    awk -v wanted="$1" -v method="$2" '
        $1 == method { s[++n] = log($3 > 0.001 ? $3 : 0.001); e[n] = log($4) }
        END {
            for (k = 2; k < n && e[k] > log(wanted); k++) ;
            if (n < 2 || e[k] == e[k - 1]) { print "nan"; exit }
            print exp(s[k - 1] + (s[k] - s[k - 1]) * (log(wanted) - e[k - 1]) / (e[k] - e[k - 1]))
        }' "$3"
}

report()
{
    printf '\n%-16s %6s %12s %10s\n' "$1" N 'CPU s' error
    awk '{ printf "%-16s %6s %12s %9.2f%%\n", $1, $2 ? $2 : "-", $3, 100 * $4 }' "$2"
}

# what_it_takes FILE: the corrected lookup, where it has a third of the lookup's error
what_it_takes()
{
    local lookup third

    read -r _ _ lookup third <"$1"
    third=$(awk -v e="$third" 'BEGIN { print e / 3 }')
    awk -v third="$third" -v lookup="$lookup" -v corrected="$(seconds_at "$third" interreflection "$1")" \
        -v traced="$(seconds_at "$third" traced "$1")" 'BEGIN {
            printf "%.1f %%, a third of the lookup'\''s error, takes %.1f x its time corrected, %.1f x traced\n",
                100 * third, corrected / lookup, traced / lookup }'
}

single
bounces bunny.txt bunny.pov "$side" 0 2.5 2 N
workshop
printf '{\n  "side": %d,\n  "truth": %d,\n  "single": [%s],\n  "bunny": [%s],\n  "workshop": [%s]\n}\n' "$side" \
    "$truth" "$(json single.txt)" "$(json bunny.txt)" "$(json workshop.txt)" >"${top_builddir:?}/table1.json"
{
    echo '<svg xmlns="http://www.w3.org/2000/svg" width="1200" height="300" font-family="sans-serif" font-size="11">'
    echo '<rect width="1200" height="300" fill="#fff"/>'
    panel 0 'bunny: error by processor seconds' single.txt
    panel 400 'bunny, every bounce' bunny.txt
    panel 800 'workshop, every bounce' workshop.txt
    echo '</svg>'
} >svg.part
mv svg.part "$top_builddir/table1.svg"

report single single.txt
read -r _ _ fast error <single.txt
awk -v fast="$fast" -v slow="$(seconds_at "$error" reference single.txt)" -v error="$error" \
    'BEGIN { printf "prefiltered: %.2f %% in %.3f s; the reference takes %.1f s for that: %.0f x\n",
        100 * error, fast, slow, slow / (fast > 0.001 ? fast : 0.001) }'
for scene in bunny workshop; do
    report "$scene" "$scene.txt"
    what_it_takes "$scene.txt"
done
echo "$top_builddir/table1.json $top_builddir/table1.svg"
