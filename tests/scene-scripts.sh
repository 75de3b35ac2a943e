#!/bin/bash
# The scripts behind figures: several may make the same thing at once.

. "$srcdir/tests/tap.sh"

work=$(mktemp -d) || bail_out 'mktemp -d failed'
trap 'rm -rf "$work"' EXIT
top=$(cd "$srcdir" && pwd)
cd "$work" || bail_out "$work cannot be entered"

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

done_testing
