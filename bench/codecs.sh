#!/bin/bash
# bench/codecs.sh - `make codecs`: what OpenEXR's codecs and half floats make of files of many roughnesses: size, time
# to read, and how far lookups move, as a table on the terminal.  [Okumura, section 4] asks for compression.

set -euo pipefail

: "${PREFENV:?call this through make}" "${PREFENV_DATA:?call this through make}"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

# Views all over the sphere, of every smoothness.
awk 'BEGIN { srand(1); for (k = 0; k < 2000; k++) { for (i = 0; i < 3; i++) printf "%.4f ", rand() - 0.5
    print "0.1 0.2 0.9", rand() } }' >lines.txt

# Processor seconds of a command, the least of three.
seconds_of()
{
    local TIMEFORMAT='%U %S'

    for _ in 1 2 3; do
        { time "$@" >/dev/null; } 2>&1
    done | awk '{ print $1 + $2 }' | sort -g | sed -n 1p
}

# Relative root mean square difference of two files of answers.
difference()
{
    paste "$1" "$2" | awk '{ for (i = 1; i < 4; i++) { e += ($i - $(i + 3))^2; n += $i^2 } }
        END { printf "%.2e", sqrt(e / n) }'
}

printf '%-8s %-8s %-6s %10s %12s %12s\n' method codec pixels bytes 'seconds' 'difference'
for method in layers voxels grades; do
    options=
    [ $method != grades ] || options='--alpha 0.02-0.5'
    # shellcheck disable=SC2086 # options are a list of words
    "$PREFENV" bake "$PREFENV_DATA/hdri/courtyard.exr" -o $method.exr --method $method $options --float --quiet
    "$PREFENV" eval $method.exr <lines.txt >truth.txt
    for pixels in float half; do
        for codec in none rle zips zip piz pxr24 b44 b44a dwaa dwab; do
            oiiotool -a $method.exr -d $pixels --compression $codec -o file.exr 2>/dev/null || continue
            "$PREFENV" eval file.exr <lines.txt >answers.txt 2>error.txt || { cat error.txt; continue; }
            printf '%-8s %-8s %-6s %10d %12s %12s\n' $method $codec $pixels "$(stat -c %s file.exr)" \
                "$(seconds_of "$PREFENV" info file.exr)" "$(difference truth.txt answers.txt)"
        done
    done
done
