#!/bin/bash
# image-formats.sh - every kind of picture an environment may come as reads as the same picture: OpenEXR of every pixel
# type, storage and compression, Radiance HDR with and without run lengths, PNG of every depth and colour type.

. "$srcdir/tests/tap.sh"

for tool in oiiotool jq; do
    command -v $tool >/dev/null || bail_out "$tool is missing; ./bootstrap installs it"
done
folder=$(mktemp -d) || bail_out 'no temporary folder'
trap 'rm -rf "$folder"' EXIT
cd "$folder" || exit 1

# same PICTURE REFERENCE BOUND NAME: the largest difference of a value is at most BOUND.
same()
{
    local worst
    worst=$("$PREFENV" diff --json "$1" "$2" 2>error | jq '.worst.difference | numbers')
    [ -n "$worst" ] || worst="nothing: $(cat error)"
    is "$(jq -n "$worst <= $3" 2>/dev/null)" true "$4 ($worst)"
}

# 50 x 27 texels, so that tiles and blocks are cut; values exact in half.
oiiotool --pattern fill:topleft=0.125,0.25,0.5:topright=2,0.5,0.0625:bottomleft=0.25,1,8:bottomright=1,3,0.5 50x27 3 \
    -d half --compression none -o base.exr || bail_out 'oiiotool cannot make a picture'

for type in half float; do
    for storage in scanline tile; do
        tiles=; [ $storage = scanline ] || tiles='--tile 16 16'
        for compression in none rle zips zip piz; do
            oiiotool base.exr -d $type $tiles --compression $compression -o a.exr
            same a.exr base.exr 0 "EXR $type $storage $compression"
        done
        # Lossy ones: the bound is theirs, not ours.
        for compression in pxr24 b44 b44a dwaa dwab; do
            oiiotool base.exr -d $type $tiles --compression $compression -o a.exr
            same a.exr base.exr 0.1 "EXR $type $storage $compression"
        done
    done
done
oiiotool base.exr --ch R,G,B,A=0.5 -d float -o rgba.exr
same rgba.exr base.exr 0 'EXR with alpha'
oiiotool base.exr --ch R=G,G=G,B=G -d float -o gray.exr
oiiotool base.exr --ch Y=G -d float -o y.exr
same y.exr gray.exr 0 'EXR with Y alone'
oiiotool base.exr --ch B,G,R,Z=R,extra=G -d half -o extra.exr
same extra.exr base.exr 0 'EXR with more channels, in another order'

# A data window that covers part of the display window, and one that reaches beyond it.
oiiotool base.exr --cut 20x10+5+7 --fullsize 50x27+0+0 -o part.exr
oiiotool base.exr --cut 20x10+5+7 --fullsize 50x27+0+0 --croptofull -o whole.exr
same part.exr whole.exr 0 'EXR whose data window is smaller than its display window'
oiiotool base.exr --fullsize 20x10+5+7 -o beyond.exr
oiiotool base.exr --cut 20x10+5+7 --origin +0+0 --fullpixels -o inner.exr
same beyond.exr inner.exr 0 'EXR whose data window is larger than its display window'

# Radiance: a step of the mantissa is 1/256 of the brightest channel, at most 8 here.
oiiotool base.exr -o rle.hdr
same rle.hdr base.exr 0.032 'HDR with run lengths'
# Scan lines shorter than 8 texels are flat.
oiiotool base.exr --cut 7x5 --origin +0+0 --fullpixels -o narrow.exr
oiiotool narrow.exr -o flat.hdr
same flat.hdr narrow.exr 0.032 'HDR, flat'
# All eight orientations of a 2 x 1 picture, red then green.
hdr() # RESOLUTION FIRST SECOND
{
    printf '#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n%s\n' "$1"
    for texel in "$2" "$3"; do
        case $texel in red) printf '\200\0\0\201' ;; green) printf '\0\200\0\201' ;; esac
    done
}
hdr '-Y 1 +X 2' red green >wanted.hdr
for order in '+Y 1 +X 2:red:green' '-Y 1 -X 2:green:red' '+Y 1 -X 2:green:red' '+X 2 -Y 1:red:green' \
    '+X 2 +Y 1:red:green' '-X 2 -Y 1:green:red' '-X 2 +Y 1:green:red'; do
    IFS=: read -r resolution first second <<<"$order"
    hdr "$resolution" "$first" "$second" >a.hdr
    same a.hdr wanted.hdr 0 "HDR of resolution $resolution"
done
{ printf '#?RADIANCE\nEXPOSURE=2\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n'; printf '\200\200\200\202'; } >exposed.hdr
{ printf '#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n'; printf '\200\200\200\201'; } >plain.hdr
same exposed.hdr plain.hdr 0 'HDR whose EXPOSURE is 2'

# PNG: linear light from sRGB, within half a step of the depth.
oiiotool --pattern fill:topleft=0,0.1,0.5:topright=1,0.5,0:bottomleft=0.2,1,0.7:bottomright=0.9,0.3,0.5 50x27 3 \
    -d float --iscolorspace sRGB -o srgb.exr
oiiotool srgb.exr --colorconvert sRGB linear -d float -o linear.exr
oiiotool srgb.exr --iscolorspace sRGB -d uint8 -o 8.png
oiiotool srgb.exr --iscolorspace sRGB -d uint16 -o 16.png
same 8.png linear.exr 0.006 'PNG, 8 bit'
same 16.png linear.exr 0.00003 'PNG, 16 bit'
oiiotool srgb.exr --iscolorspace sRGB --ch R,G,B,A=1 -d uint8 -o alpha.png
same alpha.png linear.exr 0.006 'PNG with alpha'
oiiotool srgb.exr --iscolorspace sRGB --ch G -d uint8 -o gray.png
oiiotool linear.exr --ch R=G,G=G,B=G -d float -o gray.exr
same gray.png gray.exr 0.006 'PNG, gray'

# What is not read is named.
oiiotool base.exr --ch X=R,Z=G -o depth.exr
"$PREFENV" diff depth.exr base.exr >out 2>error
is "$?:$(grep -c 'depth.exr.*channel' error)" 2:1 "EXR without colour: $(cat error)"
done_testing
