#!/bin/bash
# The block inherits everything of `reflection`: under each finish, texture, normal and object of povray/inherit.pov,
# the picture is that of an ordinary mirror,
#   - exactly, where the mirror sees a sky of one colour and the block maps baked from that colour;
#   - nearly, where the mirror sees an environment as its sky and the block reflects the same environment with the
#     smallest roughness there is.
# The cases are the frames of one animation, so that POV-Ray starts once for all of them.

. "$srcdir/tests/tap.sh"
. "$srcdir/tests/povray/render.sh"

{
    printf '#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 4 +X 8\n'
    for _ in {1..32}; do printf '\200\100\300\200'; done # each byte means its middle: (128 + 1/2) / 256 and so on
} >constant.hdr
bake constant.hdr -o constant.exr --alpha 0.3 --normals 42 --size 16x8
chart chart.hdr 512 256 0

# The names of the frames.
cases=(
    'plain'
    'a coloured amount'
    'an amount that depends on the angle, and falloff'
    'falloff with a fraction'
    'fresnel'
    'fresnel with minimum and maximum'
    'metallic'
    'metallic, half'
    'reflection exponent'
    'conserve_energy over a coloured, transparent layer'
    'layered textures, each with a block'
    'texture_map'
    'average of textures'
    'material_map'
    'bumps'
    'deep wrinkles: mirrored below the surface'
    'normal_map, layered'
    'uv-mapped mesh'
    'object and texture transformed'
    'union of declared finishes'
    'iridescence'
    'glass, from the inside'
    'plain, once more'
)

cp "$srcdir/tests/povray/inherit.pov" cases.pov
count=${#cases[@]}

frames() # NAME MODE SKY [OPTION...]
{
    render cases.pov +W60 +H60 +FE "+O$1.exr" +KFI1 "+KFF$count" "Declare=Mode=$2" "Declare=Sky=$3" "${@:4}" ||
        note "$said"
}

frames mirror0 0 0
is "$(grep -o 'Reflected Rays: *[1-9]' <<<"$said" | wc -l)" "$count" 'a mirror traces rays, in every frame'
frames block0 1 0
is "$(grep -o 'Reflected Rays: *[1-9]' <<<"$said" | wc -l)" 1 'the block traces none, but inside the glass'
frames mirror1 0 1
frames block1 1 1

k=0
for name in "${cases[@]}"; do
    k=$((k + 1))
    frame=$(printf '%02d.exr' $k)
    ok "$name: one colour" "$PREFENV" diff "block0$frame" "mirror0$frame" --fail-above 1e-5
    ok "$name: an environment" "$PREFENV" diff "block1$frame" "mirror1$frame" --fail-above-relative 0.01
done

# The last frame again, where reflections are off.
frames low 1 0 +Q7 "+KFI$count"
"$PREFENV" diff "low$count.exr" "block0$count.exr" --fail-above 1e-3 >/dev/null 2>&1 && same=yes || same=no
is $same no 'below quality 8 there is no reflection'
done_testing
