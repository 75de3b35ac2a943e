#!/bin/bash
# A film does not flicker: of a drive down a street, baked as a sequence, what is looked up in frame after frame stays
# within one of 256 levels of the pace of the truth.  scenes/flicker.awk says what is measured.

. "$srcdir/tests/tap.sh"
. "$srcdir/tests/povray/render.sh"

frames=6
points=30

# Normals, viewers that see them, and two smoothnesses; 0.25 is to 128x64 what 1 is to 512x256.
awk -v points=$points '
    function side() { return 2 * rand() - 1 }
    BEGIN {
        srand(1)
        while (done < points) {
            x = side(); y = side(); z = side(); a = side(); b = side(); c = side()
            if (x * a + y * b + z * c <= 0) continue
            print x, y, z, a, b, c, done++ % 2 ? 0.1 : 0.25
        }
    }' >points.txt

# measured PATTERN: of the maps of that name; into flicker
measured()
{
    local i

    for ((i = 1; i <= frames; i++)); do
        # shellcheck disable=SC2059 # the pattern is a format
        "$PREFENV" eval "$(printf "$1" "$i")" <points.txt >film.txt || note "prefenv eval failed"
        paste -d' ' film.txt "truth_$i.txt"
    done | awk -v points=$points -f "$srcdir/scenes/flicker.awk" >measured.txt
    read -r flicker truth error <measured.txt
}

below() # A B
{
    awk -v a="$1" -v b="$2" 'BEGIN { exit !(a < b) }'
}

render "$srcdir/scenes/street.pov" +Ostreet_.exr +FE +W128 +H64 +KFI1 +KFF695 +SF1 +EF$frames +A0.05 +AM1 +R2 -J
is "$(echo street_*.exr)" "$(printf 'street_%03d.exr ' $(seq $frames) | sed 's/ $//')" 'the street: a picture a frame'
fails '... which moves' "$PREFENV" diff street_001.exr street_00$frames.exr --fail-above-relative 0.1
for ((i = 1; i <= frames; i++)); do
    "$PREFENV" exact "street_00$i.exr" --phong <points.txt >"truth_$i.txt" || bail_out 'prefenv exact failed'
done

bake street_%03d.exr --frames 1-$frames -o street_%03d.pe.exr --method layers
measured street_%03d.pe.exr
note "film: error $error levels, second difference of the error $flicker, of the truth $truth"
ok 'the error keeps its pace to one level of 256' below "$flicker" 1
ok '... while the picture changes its own ten times as much' \
    below "$(awk -v f="$flicker" 'BEGIN { print 10 * f }')" "$truth"

# One frame of maps made otherwise, as a bake would make them that chose anew for every frame.
bake street_003.exr -o street_003.pe.exr --method voxels --size 32
measured street_%03d.pe.exr
ok 'one frame of other maps would be noticed' below 1 "$flicker"

done_testing
