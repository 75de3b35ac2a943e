#!/bin/bash
# bench/bounces.sh - `make table1`: what quality costs. [Motegi Table 1, Fig. 6a]
#
#   single     the bunny, one ray a pixel: Monte Carlo of single scattering (`samples N`) and the prefiltered lookup,
#              and beside them the same traced with every bounce (`samples N traced`): error against processor
#              seconds, for N of SAMPLES
#   four       four rays a pixel: the lookup at each, and Monte Carlo with SAMPLES / 4 at each; lookups at 16 rays, too
#   paths      Monte Carlo as the paper counts it, a ray of the camera for each sample: seconds alone
#   bunny      with every bounce: a lookup, the lookup corrected by a few rays (`interreflection N`), everything traced
#   workshop   the same of parts that stand close to each other
#
# Errors are relative RMSE over the metal's pixels: of single scattering against `samples all`, the sum over every
# texel, which has no noise, at the same rays; of what is traced against TRUTH rays at each point, other ones.  K x K
# rays a pixel are a picture K times as large, shrunk.  (POV-Ray's antialiasing, +A0.0 +R2, shoots a fifth ray.)
# Seconds are those of tracing, the least of three pictures unless they take long.  Tables, the paper's beside ours, on
# standard output, table1.json and table1.svg in the build tree.  Some five minutes on two idle cores; SIDE, SAMPLES,
# RAYS and TRUTH make it shorter or better.
#
# Fails if a corrected lookup takes more than four times the lookup's time to a third of its error, or if the light of
# corrected pictures is more than 2 % off.  Pictures of a hundredth of a second are not told apart by one: that is the
# ratio of the sums of nine, made by turns.

set -euo pipefail

die()
{
    printf 'make table1: %s\n' "$*" >&2
    exit 1
}

. "${srcdir:?call this through make}/scenes/common.sh"

side=${SIDE:-160}
samples=${SAMPLES:-4 64 256 1024 4096}
rays=${RAYS:-2 3 4 5 8 16 32 64}
truth=${TRUTH:-4096}
[[ $side =~ ^[1-9][0-9]*$ ]] || die "SIDE is '$side', and should be pixels, such as 160"
[[ $truth =~ ^[1-9][0-9]*$ ]] || die "TRUTH is '$truth', and should be a number of rays, such as 4096"
[[ $rays =~ ^[1-9][0-9]*(\ +[1-9][0-9]*)+$ ]] || die "RAYS is '$rays', and should be two numbers or more, such as 4 8"
[[ $samples =~ ^[1-9][0-9]*(\ +[1-9][0-9]*)+$ ]] ||
    die "SAMPLES is '$samples', and should be two numbers or more, such as 4 64"
for n in $samples; do
    [ $((n % 4)) = 0 ] || die "SAMPLES has $n, which four rays a pixel cannot share: take multiples of 4"
done
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

# least SECONDS [SECONDS]: the lesser one
least()
{
    awk -v a="$1" -v b="${2:-1e9}" 'BEGIN { print (a < b ? a : b) }'
}

# picture NAME SCENE WIDTH HEIGHT OPTION...: NAME.exr; sets trace_cpu_seconds
picture()
{
    local seconds=

    for _ in 1 2 3; do
        render "$1.log" "$2" "$1.exr" "+W$3" "+H$4" -A +L. "${@:5}"
        seconds=$(least "$trace_cpu_seconds" "$seconds")
        if awk -v s="$seconds" 'BEGIN { exit !(s > 1) }'; then break; fi
    done
    trace_cpu_seconds=$seconds
}

# grid NAME K OPTION...: NAME.exr, the bunny with K x K rays a pixel; sets trace_cpu_seconds
grid()
{
    picture fine bunny.pov $(($2 * side)) $(($2 * side)) "${@:3}"
    oiiotool fine.exr --resize:filter=box "${side}x$side" -d float --compression none -o "$1.exr" >/dev/null ||
        die "oiiotool could not shrink $1.exr; see above"
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

# several rays a pixel, of single scattering
four()
{
    local n k

    grid mask4 2 Declare=Mode=4
    grid single4 2 Declare=Mode=3
    grid lookup4 2 Declare=Mode=0
    row four.txt prefiltered 4 lookup4 single4 mask4
    for n in $samples; do
        grid sampled4 2 Declare=Mode=1 "Declare=N=$((n / 4))"
        row four.txt reference "$n" sampled4 single4 mask4
    done
    grid mask16 4 Declare=Mode=4
    grid single16 4 Declare=Mode=3
    grid lookup16 4 Declare=Mode=0
    row sixteen.txt prefiltered 16 lookup16 single16 mask16
    for k in 2 8 16; do
        picture paths bunny.pov $((k * side)) $((k * side)) Declare=Mode=1 Declare=N=1
        echo "path $((k * k)) $trace_cpu_seconds null" >>paths.txt
        echo "paths: $((k * k)): $trace_cpu_seconds s" >&2
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
    time_third "$@"
    sum_light "$@"
}

# about_third FILE: the two N of the corrected lookup between which it has a third of the lookup's error, or the nearest
about_third()
{
    awk '
        $1 == "lookup" { third = $4 / 3 }
        $1 == "interreflection" && !done { before = last; last = $2; done = before && $4 <= third }
        END { print before, last }' "$1"
}

# time_third FILE SCENE WIDTH LOOKUP CORRECTED TRACED WORD: third-FILE, the lookup and those two N, nine pictures of
# each by turns, with the errors that they have and the mean of their seconds
time_third()
{
    local n mode near

    near="0 $(about_third "$1")"
    for _ in 1 2 3 4 5 6 7 8 9; do
        for n in $near; do
            mode=$5
            if [ "$n" = 0 ]; then mode=$4; fi
            render third.log "$2" third.exr "+W$3" "+H$side" -A +L. "Declare=Mode=$mode" "Declare=$7=$n"
            echo "$n $trace_cpu_seconds"
        done
    done >turns.txt
    awk '
        FNR == NR { sum[$1] += $2; count[$1]++; next }
        $1 != "traced" && $2 in sum { print $1, $2, sum[$2] / count[$2], $4 }' turns.txt "$1" >"third-$1"
}

# light_of NAME: the sum of a picture's mean red, green and blue where mask.exr is white
light_of()
{
    oiiotool "$1.exr" mask.exr --mul -d float -o metal.exr >/dev/null && oiiotool --stats metal.exr |
        awk '/Stats Avg:/ { print $3 + $4 + $5 }'
}

# sum_light FILE SCENE WIDTH LOOKUP CORRECTED TRACED WORD: light-FILE, the light of eight pictures corrected by five
# rays, each with other noise, over that of the truth
sum_light()
{
    local k

    for k in 1 2 3 4 5 6 7 8; do
        render light.log "$2" light.exr "+W$3" "+H$side" -A +L. "Declare=Mode=$5" "Declare=$7=5" \
            "Declare=Shift=0.000000$k"
        light_of light
    done >lights.txt
    awk -v true="$(light_of every)" '{ sum += $1 } END { print sum / NR / true }' lights.txt >"light-$1"
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

# panel LEFT TITLE FILE: a panel of the plot
panel()
{
    awk -v left="$1" -v title="$2" -f "$srcdir/bench/panel.awk" "$3"
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

# at_least_a_tick SECONDS: no less than the thousandth that POV-Ray tells
at_least_a_tick()
{
    awk -v s="$1" 'BEGIN { print (s > 0.001 ? s : 0.001) }'
}

report()
{
    printf '\n%-16s %6s %12s %10s\n' "$1" N 'CPU s' error
    awk '{ printf "%-16s %6s %12s %9.2f%%\n", $1, $2 ? $2 : "-", $3, 100 * $4 }' "$2"
}

# line LABEL METHOD FILE...: the seconds of a method, a column for each of 1, 4, 16 and SAMPLES
line()
{
    awk -v label="$1" -v method="$2" -v columns="$columns" '
        $1 == method { seconds[$1 == "prefiltered" && !$2 ? 1 : $2] = $3 }
        END {
            printf "%-52s", label
            count = split(columns, n, " ")
            for (k = 1; k <= count; k++) printf " %8s", n[k] in seconds ? seconds[n[k]] : "-"
            print ""
        }' "${@:3}"
}

# the paper's table, and ours below
beside_the_paper()
{
    cat >paper.txt <<'END'
mitsuba 4 0.40
mitsuba 64 7.07
mitsuba 256 26.74
mitsuba 1024 141.49
mitsuba 4096 571.88
own 4 3.82
own 64 23.25
own 256 108.89
own 1024 449.86
own 4096 1762.62
END
    # shellcheck disable=SC2086 # a list of words
    columns=$(printf '%s\n' 1 4 16 $samples | sort -nu | tr '\n' ' ')
    printf '\nTable 1: theirs, seconds at 1024x1024 on an i7-1165G7; ours, seconds of processor time at %s\non: %s\n' \
        "${side}x$side" "$(sed -n 's/^model name[^:]*: *//p' /proc/cpuinfo 2>/dev/null | head -n 1)"
    # shellcheck disable=SC2046,SC2086 # a list of words
    printf "%-52s$(printf ' %%8s%.0s' $columns)\n" 'samples a pixel' $columns
    line 'paper: Mitsuba 2, every bounce' mitsuba paper.txt
    line 'paper: own renderer, single scattering' own paper.txt
    line 'every bounce, at one ray of the camera' traced single.txt
    line 'single scattering, a ray of the camera for each' path paths.txt
    line '... at four rays of the camera' reference four.txt
    line '... at one ray of the camera' reference single.txt
    line 'prefiltered, a ray of the camera for each' prefiltered single.txt four.txt sixteen.txt
}

# equal_error RAYS FILE: the lookup against the reference where it has the same error
equal_error()
{
    local fast error

    read -r _ _ fast error <"$2"
    fast=$(at_least_a_tick "$fast")
    awk -v rays="$1" -v fast="$fast" -v error="$error" -v slow="$(seconds_at "$error" reference "$2")" 'BEGIN {
        printf "prefiltered, %s: %.2f %% in %.3f s; the reference takes %.2f s for that: %.0f x\n",
            rays, 100 * error, fast, slow, slow / fast }'
}

# by_samples: the paper's ratio, of times alone
by_samples()
{
    local fast

    read -r _ _ fast _ <four.txt
    fast=$(at_least_a_tick "$fast")
    awk -v fast="$fast" 'END {
        printf "by samples, 4096 a pixel against lookups at 4: the paper has 1762.62 s / 3.82 s = %.0f x;\n" \
            "ours, a ray for each, in proportion from %d, %.0f x", \
            1762.62 / 3.82, $2, $3 * 4096 / $2 / fast }' paths.txt
    awk -v fast="$fast" '
        $1 == "reference" && $2 == 4096 { printf ", at four rays a pixel %.0f x", $3 / fast }
        END { print "" }' four.txt
}

# what_it_takes SCENE: the corrected lookup, where it has a third of the lookup's error; sets takes
what_it_takes()
{
    local lookup fine third corrected traced

    read -r _ _ lookup third <"$1.txt"
    read -r _ _ fine _ <"third-$1.txt"
    lookup=$(at_least_a_tick "$lookup") fine=$(at_least_a_tick "$fine")
    third=$(awk -v e="$third" 'BEGIN { print e / 3 }')
    corrected=$(seconds_at "$third" interreflection "third-$1.txt")
    traced=$(seconds_at "$third" traced "$1.txt")
    takes=$(awk -v s="$corrected" -v lookup="$fine" 'BEGIN { printf "%.2f", s / lookup }')
    awk -v third="$third" -v takes="$takes" -v traced="$traced" -v lookup="$lookup" 'BEGIN {
        printf "%.1f %%, a third of the lookup'\''s error, takes %.1f x its time corrected, %.1f x traced\n",
            100 * third, takes, traced / lookup }'
    echo "five rays leave $(<"light-$1.txt") of the light, the mean of eight pictures"
}

single
four
bounces bunny.txt bunny.pov "$side" 0 2.5 2 N
workshop
{
    printf '{\n  "side": %d,\n  "truth": %d,\n' "$side" "$truth"
    for part in single four sixteen paths bunny third-bunny workshop third-workshop; do
        printf '  "%s": [%s]' "${part/-/_}" "$(json "$part.txt")"
        if [ $part = third-workshop ]; then printf '\n}\n'; else printf ',\n'; fi
    done
} >"${top_builddir:?}/table1.json"
{
    echo '<svg xmlns="http://www.w3.org/2000/svg" width="1600" height="300" font-family="sans-serif" font-size="11">'
    echo '<rect width="1600" height="300" fill="#fff"/>'
    panel 0 'bunny: error by processor seconds' single.txt
    panel 400 'bunny, four rays a pixel' four.txt
    panel 800 'bunny, every bounce' bunny.txt
    panel 1200 'workshop, every bounce' workshop.txt
    echo '</svg>'
} >svg.part
mv svg.part "$top_builddir/table1.svg"

report single single.txt
report 'four rays' four.txt
report 'sixteen rays' sixteen.txt
beside_the_paper
echo
equal_error 'one ray a pixel' single.txt
equal_error 'four rays a pixel' four.txt
by_samples
echo "(Theirs traces a path for each sample; \`samples N' reads N texels at each point, and no ray of the camera more.)"
late= off=
for scene in bunny workshop; do
    report "$scene" "$scene.txt"
    what_it_takes "$scene"
    if awk -v takes="$takes" 'BEGIN { exit !(takes + 0 > 4 || takes + 0 <= 0) }'; then
        late="$late${late:+ and }$takes x in the $scene scene"
    fi
    if awk -v light="$(<"light-$scene.txt")" 'BEGIN { exit !(light + 0 < 0.98 || light + 0 > 1.02) }'; then
        off="$off${off:+ and }$(<"light-$scene.txt") of it in the $scene scene"
    fi
done
echo "$top_builddir/table1.json $top_builddir/table1.svg"
[ -z "$off" ] || die "five rays should leave as much light as there is, within 2 %, and leave $off"
[ -z "$late" ] || die "a third of the lookup's error should take no more than 4 x its time, and takes $late"
