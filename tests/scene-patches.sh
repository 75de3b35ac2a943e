#!/bin/bash
# patches2mesh.awk: a patch becomes points of its surface and the normals there, u along a strip of patches and v across
# it; and a file that makes no sense is refused.

. "$srcdir/tests/tap.sh"

work=$(mktemp -d) || bail_out 'mktemp -d failed'
trap 'rm -rf "$work"' EXIT
cd "$work" || bail_out "$work cannot be entered"
script=$srcdir/scenes/patches2mesh.awk

# block WORD FILE: the numbers of a block of a mesh, a vector a line
block()
{
    sed -n "/^$1 {/,/^}/p" "$2" | sed -n 's/^,<\(.*\)>$/\1/p' | tr , ' '
}

# Two patches side by side, a tube about the z axis of a quarter each, from z = 0 to 3.  0.5523 is the usual arc of
# Bezier, round to 3 parts in 10000.
awk 'BEGIN {
    a = 0.5522848
    split("1 0 1 " a " " a " 1 0 1 -" a " 1 -1 " a " -1 0", x, " ")
    for (row = 0; row < 4; row++)
        for (i = 0; i < 7; i++) print "point", x[2 * i + 1], x[2 * i + 2], row
    for (p = 0; p < 2; p++) {
        line = "patch"
        for (row = 0; row < 4; row++)
            for (i = 0; i < 4; i++) line = line " " (7 * row + 3 * p + i)
        print line
    }
}' >tube.patches
ok 'a tube' awk -v name=Tube -v steps=8 -f "$script" tube.patches
echo "$tap_output" >tube.inc
like "$tap_output" '^#declare Tube = mesh2' 'its name'
is "$(block vertex_vectors tube.inc | wc -l) $(block face_indices tube.inc | wc -l)" '162 256' \
    'all its points and triangles'
block vertex_vectors tube.inc >points.txt
block normal_vectors tube.inc >normals.txt
is "$(awk '{
        r = sqrt($1 ^ 2 + $3 ^ 2)
        if (r < 0.9997 || r > 1.0003 || $2 < 0 || $2 > 3) bad++
    } END { print bad + 0 }' points.txt)" 0 'its points lie on the tube, y upwards'
is "$(paste -d' ' points.txt normals.txt | awk '{
        along = $1 * $4 + $3 * $6; size = $4 ^ 2 + $5 ^ 2 + $6 ^ 2
        if (along ^ 2 < 0.99999 || size < 0.99999 || size > 1.00001) bad++
    } END { print bad + 0 }')" 0 'its normals stand on it'
is "$(block uv_vectors tube.inc | paste -d' ' - points.txt | awk '{
        turn = atan2($5, $3) / 3.14159265 # half a turn is the strip
        if (($1 - turn) ^ 2 > 1e-4 || ($2 - $4 / 3) ^ 2 > 1e-9) bad++
    } END { print bad + 0 }')" 0 'u goes around over both patches, v along'

# The teapot has patches with an edge that is a point, at the top of the lid and in the middle of the bottom.
awk -v steps=4 -f "$script" "$srcdir/scenes/teapot.patches" >teapot.inc
is "$(block vertex_vectors teapot.inc | paste -d' ' - <(block normal_vectors teapot.inc) |
    awk '$1 == 0 && $3 == 0 && ($2 == 3.15 || $2 == 0) { count++; if ($5 ^ 2 < 0.9999) bad++ }
        END { print count, bad + 0 }')" '40 0' 'the teapot: upright normals where the edge of a patch is a point'
is "$(block face_indices teapot.inc | wc -l)" $((32 * 2 * 16 - 8 * 4)) '... and no triangle without an area'

refused() # NAME PATTERN STEPS
{
    fails "$1" awk -v steps="$3" -f "$script" bad.patches && like "$tap_output" "$2" '... and said why'
}
echo 'patch 1 2 3' >bad.patches
refused 'a patch of three points' "bad.patches: line 1: 'patch' with 16 points" 4
sed 's/^patch 0/patch 28/' tube.patches >bad.patches
refused 'a point that is not there' 'patch 0 has the point 28, but there are 28' 4
cp tube.patches bad.patches
refused 'no steps' 'steps must lie between 1 and 200, but is 0' 0
: >bad.patches
refused 'nothing in it' 'no patches in it' 4

done_testing
