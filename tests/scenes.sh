#!/bin/bash
# Every scene, rendered small, is what it was when its reference was committed, within a stated bound.  This shows
# change, not truth; the finish itself is held to `prefenv eval` and `prefenv exact` in povray-finish.sh.
#
# Where a picture differs, it, its reference and the difference stay in scenes-failed/ of the build tree.

. "$srcdir/tests/tap.sh"

[ -n "${POVRAY_PREFENV:-}" ] || skip_all 'this tree is configured without POV-Ray'
[ -x "$POVRAY_PREFENV" ] || bail_out "$POVRAY_PREFENV does not exist: run make"
[ -f "$PREFENV_DATA/bunny.obj" ] || skip_all "$PREFENV_DATA/bunny.obj does not exist: ./bootstrap fetches it"

die()
{
    bail_out "$*"
}

. "$srcdir/scenes/common.sh"
. "$srcdir/scenes/small.sh"

work=$(mktemp -d) || bail_out 'mktemp -d failed'
trap 'rm -rf "$work"' EXIT
cd "$work" || bail_out "$work cannot be entered"
failed=$top_builddir/scenes-failed
rm -rf "$failed"

for scene in "$srcdir"/scenes/*.pov; do
    name=$(basename "$scene" .pov)
    case " $(echo $small_scenes) " in
        *" $name "*) ;;
        *) tap_result 1 "$name: is among those of small.sh" ;;
    esac
done

small_prepare
for name in $small_scenes; do
    small_render "$name"
    reference=$srcdir/scenes/reference/$name.png
    ok "$name: as its reference, to an RMSE of $(small_bound "$name")" \
        "$PREFENV" diff "$name.png" "$reference" --fail-above "$(small_bound "$name")" -o "$name.difference.png" || {
        mkdir -p "$failed"
        cp "$name.png" "$failed/"
        [ ! -f "$reference" ] || cp "$reference" "$failed/$name.reference.png"
        [ ! -f "$name.difference.png" ] || cp "$name.difference.png" "$failed/"
        note "see $failed/$name.png, $name.reference.png and $name.difference.png"
    }
done

# The bound is tight enough: another interpolation breaks it.
fails 'the nearest map instead of the linear mix would be noticed' \
    "$PREFENV" diff fig6d.png "$srcdir/scenes/reference/fig6f.png" --fail-above "$(small_bound fig6f)"

done_testing
