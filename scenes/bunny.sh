#!/bin/bash
# bunny.sh - `make bunny`: bake the environment, render the bunny with it, say where the picture is.
#
#   make bunny                              the courtyard, alpha 0.1
#   make HDRI=my.exr ALPHA=0.2 bunny        an environment of one's own: OpenEXR, Radiance HDR or PNG, lat-long
#   make HDRI=sunset ALPHA=0.03,0.1 bunny   one of those that ./bootstrap fetched, and brushed metal
#
# The picture is figures/bunny.png in the build tree, whole or not there at all; the maps stay beside it, bunny.pe.exr.

set -euo pipefail

die()
{
    printf 'make bunny: %s\n' "$*" >&2
    exit 1
}

. "${srcdir:?call this through make}/scenes/common.sh"

hdri=${HDRI:-courtyard}
alpha=${ALPHA:-0.1}
if [ ! -e "$hdri" ] && [ -f "$PREFENV_DATA/hdri/$hdri.exr" ]; then hdri=$PREFENV_DATA/hdri/$hdri.exr; fi
[ -e "$hdri" ] || die "HDRI=$hdri does not exist; give a lat-long OpenEXR, Radiance HDR or PNG, or one of: $(
    cd "$PREFENV_DATA/hdri" && echo *.exr | sed 's/\.exr//g')"
[ -f "$hdri" ] && [ -r "$hdri" ] || die "HDRI=$hdri is not a file that can be read"
hdri=$(realpath "$hdri")

# The renderer is told what kind of a file it is; what is none of the three, the bake refuses below.
case $(head -c 4 "$hdri" | od -An -tx1 | tr -d ' ') in
    89504e47) kind=3 suffix=png ;;
    233f*) kind=2 suffix=hdr ;;
    *) kind=1 suffix=exr ;;
esac

figures=$top_builddir/figures
cache=$figures/work
mkdir -p "$cache"
work=$(mktemp -d "$figures/.bunny.XXXXXX")
trap 'rm -rf "$work"' EXIT
trap 'exit 130' INT TERM HUP

started=$(now)
# Floats, because a sun may be brighter than half floats can be; what is wrong with HDRI or ALPHA, the bake says.
"$PREFENV" bake "$hdri" -o "$figures/bunny.pe.exr" --alpha "$alpha" --float || exit 1
bake_seconds=$(seconds_since "$started")

make_mesh "$cache"
ln -s "$hdri" "$work/environment.$suffix"
ln -s ../bunny.pe.exr "$work/maps.exr"
cd "$work"
render "$cache/bunny.log" "$srcdir/scenes/bunny.pov" bunny.png +W1024 +H1024 +A0.1 +AM2 +R2 -J "+L$cache" \
    Declare=Kind=$kind
mv bunny.png "$figures/bunny.png"

echo "$figures/bunny.png: 1024x1024; bake $bake_seconds s, trace ${trace_seconds} s, all $(seconds_since "$started") s"
