#!/bin/bash
# bench/scaling.sh - `make bench-scaling`: what a bake costs as the environment grows, and as the maps do, in processor
# seconds without those of reading the environment: a table, scaling.json and scaling.svg of the build tree.  Some
# minutes on two idle cores; SIZES and TEXELS, widths of environments and of maps, make it shorter.

set -euo pipefail

die()
{
    printf 'make bench-scaling: %s\n' "$*" >&2
    exit 1
}

POVRAY_PREFENV=${POVRAY_PREFENV:-none}
. "${srcdir:?call this through make}/scenes/common.sh"

hdri=$PREFENV_DATA/hdri/courtyard.exr
sizes=${SIZES:-256 512 1024 2048 4096 8192}
texels=${TEXELS:-16 32 64 128}
command -v oiiotool >/dev/null || die 'oiiotool is not installed: apt-get install openimageio-tools'
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
trap 'exit 130' INT TERM HUP
cd "$work"

# cpu_seconds_of COMMAND...: of the processors, the least of two runs
cpu_seconds_of()
{
    local TIMEFORMAT='%U %S' run

    for run in 1 2; do
        { time "$@" >command.log 2>&1 </dev/null; } 2>times.part || die "$1 $2 failed: $(tail -n 3 command.log)"
        awk '{ print $1 + $2 }' times.part
    done | sort -g | sed -n 1p
}

# measure ENVIRONMENT OPTION...: of a bake of 162 normals, without reading
measure()
{
    local environment=$1 reading baking

    shift
    # Substitutions of substitutions do not end where something fails, unless they are told to.
    reading=$(cpu_seconds_of "$PREFENV" exact "$environment" --quiet) || return
    baking=$(cpu_seconds_of "$PREFENV" bake "$environment" -o maps.exr --normals 162 --fast --quiet "$@") || return
    awk -v all="$baking" -v reading="$reading" 'BEGIN { printf "%.3f", all - reading }'
}

: >by_environment.txt
for width in $sizes; do
    oiiotool "$hdri" --resize "${width}x$((width / 2))" -d float --compression none -o environment.exr >/dev/null ||
        die "oiiotool could not make an environment $width wide; see above"
    seconds=$(measure environment.exr --size 32x32) || exit 1
    echo "$((width * width / 2)) $seconds ${width}x$((width / 2))" >>by_environment.txt
    tail -n 1 by_environment.txt | sed 's/^/environment /' >&2
done
: >by_maps.txt
for width in $texels; do
    seconds=$(measure "$hdri" --size "${width}x$width") || exit 1
    echo "$((162 * width * width)) $seconds 162 maps of ${width}x$width" >>by_maps.txt
    tail -n 1 by_maps.txt | sed 's/^/maps /' >&2
done

# points FILE: of its first two columns, as JSON
points()
{
    awk '{ printf "%s{\"texels\": %s, \"seconds\": %s}", separator, $1, $2; separator = ", " }' "$1"
}

printf '{\n  "by_environment": [%s],\n  "by_maps": [%s]\n}\n' "$(points by_environment.txt)" "$(points by_maps.txt)" \
    >"$top_builddir/scaling.json"

# One panel of a picture, both axes logarithmic, at x = LEFT: panel LEFT TITLE FILE
panel()
{
    awk -v left="$1" -v title="$2" '
        function place_x(texels) { return left + 60 + 300 * (log(texels) - low_x) / (high_x - low_x) }
        function place_y(seconds) { return 260 - 200 * (log(seconds) - low_y) / (high_y - low_y) }
        { texels[NR] = $1; seconds[NR] = $2 > 0.001 ? $2 : 0.001 }
        END {
            low_x = log(texels[1]); high_x = log(texels[NR]); low_y = log(0.01); high_y = log(100)
            if (high_x <= low_x) high_x = low_x + 1
            printf "<text x=\"%d\" y=\"30\">%s</text>\n", left + 60, title
            for (power = -2; power <= 2; power++) {
                y = place_y(10 ^ power)
                printf "<path d=\"M%d %.1f h300\" stroke=\"#ccc\"/>", left + 60, y
                printf "<text x=\"%d\" y=\"%.1f\" text-anchor=\"end\">%g s</text>\n", left + 54, y + 4, 10 ^ power
            }
            printf "<polyline fill=\"none\" stroke=\"#06c\" stroke-width=\"2\" points=\""
            for (k = 1; k <= NR; k++) printf "%.1f,%.1f ", place_x(texels[k]), place_y(seconds[k])
            print "\"/>"
            for (k = 1; k <= NR; k++) {
                x = place_x(texels[k])
                printf "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"3\" fill=\"#06c\"/>", x, place_y(seconds[k])
                printf "<text x=\"%.1f\" y=\"280\" text-anchor=\"middle\">%.3gM</text>\n", x, texels[k] / 1e6
            }
        }' "$3"
}

{
    echo '<svg xmlns="http://www.w3.org/2000/svg" width="800" height="300" font-family="sans-serif" font-size="11">'
    echo '<rect width="800" height="300" fill="#fff"/>'
    panel 0 'seconds of a bake by texels of the environment' by_environment.txt
    panel 400 'seconds of a bake by texels of the maps' by_maps.txt
    echo '</svg>'
} >svg.part
mv svg.part "$top_builddir/scaling.svg"

printf '%-22s %12s %12s\n' what texels 'CPU s'
awk '{ printf "environment %-10s %12d %12s\n", $3, $1, $2 }' by_environment.txt
awk '{ printf "%-22s %12d %12s\n", $3 " " $4 " " $5 " " $6, $1, $2 }' by_maps.txt
echo "$top_builddir/scaling.json $top_builddir/scaling.svg"
