#!/bin/bash
# surfaces.sh - `make surfaces`: four machined surfaces made, measured, baked with what was measured, and rendered.
#
# Written into figures/ of the build tree: surfaces.png; figures/work/surfaces keeps height fields, distributions and
# maps.  What is no older than what it is made from is left as it is, and said to be.

set -euo pipefail

die()
{
    printf 'make surfaces: %s\n' "$*" >&2
    exit 1
}

. "${srcdir:?call this through make}/scenes/common.sh"
. "$srcdir/scenes/machined.sh"

hdri=$PREFENV_DATA/hdri/studio.exr
figures=$top_builddir/figures
work=$figures/work/surfaces
started=$(now)
mkdir -p "$work"
cd "$work"
trap 'rm -f ./*.part.*' EXIT
trap 'exit 130' INT TERM HUP
[ -f "$hdri" ] || die "$hdri does not exist: run ./bootstrap, which fetches it"

say()
{
    printf '%-10s %s\n' "$1" "$2"
}

for kind in $machined_kinds; do
    if newer surface-$kind.pe.exr "$hdri" "$PREFENV" "$srcdir/scenes/machined.sh"; then
        say $kind 'up to date'
        continue
    fi
    begun=$(now)
    machined_measure $kind
    "$PREFENV" bake "$hdri" -o $kind.part.exr --ndf $kind.ndf.exr --quiet || die "$kind was not baked; see above"
    mv $kind.part.exr surface-$kind.pe.exr
    say $kind "measured and baked in $(seconds_since "$begun") s"
done

render surfaces.log "$srcdir/scenes/surfaces.pov" surfaces.part.png +W1410 +H1410 +A0.1 +AM2 +R2 -J +L.
mv surfaces.part.png "$figures/surfaces.png"
echo "$figures/surfaces.png: traced in $trace_seconds s, all in $(seconds_since "$started") s"
