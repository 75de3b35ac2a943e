#!/bin/bash
# street.sh - `make street`: [Okumura Fig. 8], the teapot in surroundings that move: a drive down a street.
#
#   make street                  48 frames, 3 seconds of it
#   make FRAMES=695 street       all that the paper has, 46 seconds
#   make METHOD=voxels street    baked into the paper's 64 voxels cubed, whose weight table all frames share; by default
#                                into layers, which are sharper and do not flicker
#
# Written into figures/street/ of the build tree: street_001.exr, ..., what is seen all around (street.pov);
# street_001.pe.exr, ..., the same baked as a sequence; teapot8_001.png, ... (teapot8.pov); contact.png, twelve of them
# on a sheet; and film.webm, if ffmpeg is installed.  What is up to date is left as it is, and said to be.

set -euo pipefail

die()
{
    printf 'make street: %s\n' "$*" >&2
    exit 1
}

. "${srcdir:?call this through make}/scenes/common.sh"

all=695 # of the paper's sequence; the names have as many digits, however many frames are made
frames=${FRAMES:-48}
case $frames in
    *[!0-9]* | '' | 0*) die "FRAMES=$frames: give a number of frames from 1 to $all, such as FRAMES=$all" ;;
esac
[ "$frames" -le $all ] || die "FRAMES=$frames: give a number of frames from 1 to $all"

case ${METHOD:=layers} in
    layers) bake_options='--method layers' size=128 ;;
    voxels) bake_options='--method voxels --size 64' size=64 ;;
    *) die "METHOD=$METHOD: give layers or voxels" ;;
esac

figures=$top_builddir/figures/street
scenes=$srcdir/scenes
started=$(now)
mkdir -p "$figures"
cd "$figures"
trap 'rm -rf part ./*.part.*' EXIT
trap 'exit 130' INT TERM HUP

say()
{
    printf '%-10s %s\n' "$1" "$2"
}

# first_old NAME SUFFIX INPUT...: number of the first frame whose picture is missing or older than an INPUT, where %d in
# an INPUT is the frame's number; one more than all if there is none
first_old()
{
    local name=$1 suffix=$2 i number inputs

    shift 2
    for ((i = 1; i <= frames; i++)); do
        number=$(printf %03d "$i")
        inputs=("${@//%d/$number}")
        newer "${name}_$number.$suffix" "${inputs[@]}" || break
    done
    echo "$i"
}

# animate NAME SUFFIX FIRST SCENE OPTION...: the frames from FIRST on, some at a time, so that an interruption costs
# little; a frame appears when it is whole
animate()
{
    local name=$1 suffix=$2 first=$3 scene=$4 begun last i

    shift 4
    if [ "$first" -gt "$frames" ]; then
        say "$name" 'up to date'
        return
    fi
    begun=$(now)
    mkdir -p part
    for ((i = first; i <= frames; i = last + 1)); do
        last=$((i + 15 < frames ? i + 15 : frames))
        render "$name.log" "$scenes/$scene" "part/${name}_.$suffix" +KFI1 +KFF$all "+SF$i" "+EF$last" +L. "$@"
        mv "part/${name}_"*."$suffix" .
    done
    say "$name" "frames $first to $frames in $(seconds_since "$begun") s"
}

ffmpeg_missing='ffmpeg is not installed: ./bootstrap --film or apt-get install ffmpeg'
command -v ffmpeg >/dev/null || say film "will not be made, for $ffmpeg_missing"

make_teapot .
animate street exr "$(first_old street exr "$scenes/street.pov")" street.pov +W512 +H256 +A0.05 +AM1 +R3 -J

begun=$(now)
# shellcheck disable=SC2086 # options are a list of words
"$PREFENV" bake street_%03d.exr --frames "1-$frames" -o street_%03d.pe.exr $bake_options --quiet ||
    die 'the sequence was not baked; see above'
say bake "in $(seconds_since "$begun") s"

# Twelve frames at most, at forty points of the lower half's smoothness and the upper's.
measure_flicker()
{
    local i number frames_measured=$((frames < 12 ? frames : 12))

    awk 'function side() { return 2 * rand() - 1 }
        BEGIN {
            srand(1)
            while (done < 40) {
                x = side(); y = side(); z = side(); a = side(); b = side(); c = side()
                if (x * a + y * b + z * c > 0) print x, y, z, a, b, c, done++ % 2 ? 0.1 : 1
            }
        }' >points.part.txt
    for ((i = 1; i <= frames_measured; i++)); do
        number=$(printf %03d "$i")
        "$PREFENV" eval "street_$number.pe.exr" <points.part.txt >film.part.txt
        "$PREFENV" exact "street_$number.exr" --phong --size $size <points.part.txt | paste -d' ' film.part.txt -
    done | awk -v points=40 -f "$scenes/flicker.awk"
}

if [ "$frames" -ge 3 ]; then
    read -r flicker truth error < <(measure_flicker) || die 'the flicker was not measured; see above'
    say flicker "$flicker of 256 levels beside the picture's own $truth: second differences in time; error $error"
fi

animate teapot8 png "$(first_old teapot8 png street_%d.pe.exr "$scenes"/teapot{8.pov,_scene.inc})" teapot8.pov \
    +W640 +H480 +A0.1 +AM2 +R2 -J

render contact.log "$scenes/contact.pov" contact.part.png +W1304 +H743 +A0.0 +AM1 +R2 -J +L. "Declare=Frames=$frames"
mv contact.part.png contact.png
say contact 'done'

if command -v ffmpeg >/dev/null; then
    ffmpeg -nostdin -v error -y -framerate 15 -start_number 1 -i teapot8_%03d.png -frames:v "$frames" -c:v libvpx-vp9 \
        -crf 24 -b:v 0 -pix_fmt yuv420p -f webm film.part.webm || die 'ffmpeg could not make the film; see above'
    mv film.part.webm film.webm
    say film "$frames frames, 15 a second"
else
    say film "not made, for $ffmpeg_missing, then make street again: pictures are kept"
fi
echo "$figures: in $(seconds_since "$started") s"
