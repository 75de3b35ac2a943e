#!/bin/bash
# test-layers.sh - the rooms of src/ stand in a row, and none includes a header of a room to its right.

. "$srcdir/tests/tap.sh"

# From the ground up.  Rooms joined by a slash stand side by side.  A file belongs to the room that its name begins
# with: image_png.c to image.  prefenv.h is the house, and open to all.
rooms=(
    status vector lanes/quad occluders sequence parallel file image/exr env/shrink pyramid ndf heights slopes geodesic
    dome mipmap poles
    disc/spline/atlas globe/layering surface viewer directions lobe filter cluster/tiles strip kernel denominator suns
    truth/phong/horizon highlight weights maps look baseline/hemispheres/pairs/layers/voxels sample estimate choose
    multiscale bake cli
)

declare -A place
for i in "${!rooms[@]}"; do
    for room in ${rooms[i]//\// }; do
        place[$room]=$i
    done
done

room_of() # FILE
{
    case $1 in
        */cli/*) echo cli ;;
        *) basename "$1" | sed 's/[_.].*//' ;;
    esac
}

cd "$srcdir/src" || bail_out "$srcdir/src is not there"
for file in *.c *.h *.cpp cli/*.[ch]; do
    case $file in
        prefenv.h | *'*'*) continue ;;
    esac
    room=$(room_of "./$file")
    if [ -z "${place[$room]:-}" ]; then
        is "$room" 'a room in the list of this test' "$file stands in the row"
        continue
    fi
    right=
    while read -r header; do
        [ "$header" != prefenv.h ] || continue
        # A header of the command's own is beside the file that includes it.
        if [ "$room" = cli ] && [ -f "cli/$header" ]; then
            continue
        fi
        other=$(room_of "./$header")
        [ "${place[$other]:-99}" -le "${place[$room]}" ] || right="$right $header"
    done < <(sed -n 's/^#include "\(.*\)"$/\1/p' "$file")
    is "$right" '' "$file includes nothing to its right"
done
done_testing
