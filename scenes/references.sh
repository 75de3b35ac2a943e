#!/bin/bash
# references.sh - `make references`: render every scene small, anew, into scenes/reference/ of the source tree.
#
# tests/scenes.sh holds the renderer to these pictures.  Look at each before it is committed, and say in the commit why
# it changed.

set -euo pipefail

die()
{
    printf 'make references: %s\n' "$*" >&2
    exit 1
}

. "${srcdir:?call this through make}/scenes/common.sh"
. "$srcdir/scenes/small.sh"

references=$srcdir/scenes/reference
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
trap 'exit 130' INT TERM HUP
cd "$work"
small_prepare
for name in $small_scenes; do
    small_render "$name"
done

mkdir -p "$references"
for name in $small_scenes; do
    if ! [ -f "$references/$name.png" ]; then
        what=new
    elif "$PREFENV" diff "$name.png" "$references/$name.png" --quiet --fail-above 0 >"$name.diff.log" 2>&1; then
        printf '%-10s unchanged\n' "$name" # left as it is: a PNG holds the time at which it was made
        continue
    elif "$PREFENV" diff "$name.png" "$references/$name.png" --quiet --fail-above "$(small_bound "$name")" \
        >"$name.diff.log" 2>&1; then
        what='changed, within the bound of the test'
    else
        what='CHANGED: look at it'
    fi
    cp "$name.png" "$references/$name.png"
    printf '%-10s %s\n' "$name" "$what"
done
