#!/bin/bash
# The scripts behind figures and measurements: several may make the same thing at once, and a command that fails is no
# measurement.

. "$srcdir/tests/tap.sh"

work=$(mktemp -d) || bail_out 'mktemp -d failed'
trap 'rm -rf "$work"' EXIT
top=$(cd "$srcdir" && pwd)
cd "$work" || bail_out "$work cannot be entered"

# ---- make -j ----

# A teapot by an awk that takes its time.
awk='command awk "$@" && sleep 0.5'
teapot()
{
    srcdir=$top top_builddir=$work PREFENV=none POVRAY_PREFENV=none PREFENV_DATA=${PREFENV_DATA:-none} bash -c '
        set -euo pipefail
        eval "awk() { $0; }"
        . "$srcdir/scenes/common.sh"
        make_teapot .' "$awk"
}
teapot 2>first.log &
first=$!
sleep 0.2
ok 'a mesh that another script makes at the same time' teapot
wait $first
is "$? $(cat first.log)" '0 ' '... which is not disturbed'
cp teapot_mesh.inc both.inc
rm teapot_mesh.inc
ok 'one by itself' teapot
ok 'is the same' cmp teapot_mesh.inc both.inc
is "$(ls)" 'both.inc
first.log
teapot_mesh.inc' 'nothing else is left'
rm teapot_mesh.inc
awk='echo half a mesh && false'
fails 'a mesh that cannot be made' teapot
is "$(ls)" 'both.inc
first.log' 'leaves nothing'

# ---- make bench-scaling ----

if command -v oiiotool >/dev/null && [ -f "${PREFENV_DATA:-}/hdri/courtyard.exr" ]; then
    printf '#!/bin/sh\nexit 1\n' >broken
    chmod +x broken
    fails 'a bake that fails is no measurement of 0 s' env PREFENV="$work/broken" POVRAY_PREFENV=none srcdir="$top" \
        top_builddir="$work" SIZES=16 TEXELS=16 bash "$top/bench/scaling.sh"
    like "$tap_output" 'make bench-scaling: .*broken exact failed' 'which is said'
    is "$(ls scaling.* 2>/dev/null)" '' 'and nothing is written'
else
    skip 'there is no oiiotool, or no HDRI' 3
fi

done_testing
