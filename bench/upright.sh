#!/bin/bash
# bench/upright.sh - `make upright`: how dark a shaft on a black floor is with few rays of `interreflection`.
#
# Of bench/upright.pov, under a courtyard and a studio, 256x128, the light of a picture over that of the truth, 4096
# traced rays at each point: of the lookup alone, and the mean of eight pictures with N = 5, 16 and 64.  Where few lamps
# are all the light, five rays do not tell where they are, and count what the floor hides as theirs.  One minute.

set -euo pipefail

die()
{
    printf 'make upright: %s\n' "$*" >&2
    exit 1
}

. "${srcdir:?call this through make}/scenes/common.sh"

command -v oiiotool >/dev/null || die 'oiiotool is not installed: apt-get install openimageio-tools'
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
trap 'exit 130' INT TERM HUP
cd "$work"

# light N SHIFT: the sum of the picture's mean red, green and blue
light()
{
    render upright.log "$srcdir/bench/upright.pov" upright.exr +W120 +H90 -A +L. "Declare=Alpha=$alpha" "Declare=N=$1" \
        "Declare=Shift=$2"
    oiiotool --stats upright.exr | awk '/Stats Avg:/ { print $3 + $4 + $5 }'
}

printf '%-12s %6s %8s %8s %8s %8s\n' environment alpha lookup N=5 N=16 N=64
for name in courtyard studio; do
    hdri=$PREFENV_DATA/hdri/$name.exr
    oiiotool "$hdri" --resize 256x128 -d float --compression none -o environment.exr >/dev/null ||
        die 'oiiotool could not shrink the environment; see above'
    for alpha in 0.1 0.3; do
        truth=$(light -4096 0)
        printf '%-12s %6s %8.2f' "$name" "$alpha" "$(awk "BEGIN { print $(light 0 0) / $truth }")"
        for n in 5 16 64; do
            for k in 1 2 3 4 5 6 7 8; do light "$n" "0.000000$k"; done |
                awk -v truth="$truth" '{ sum += $1 } END { printf " %8.2f", sum / NR / truth }'
        done
        echo
    done
done
