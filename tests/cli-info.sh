# cli-info.sh - `prefenv info`, and what other programs say of a maps file.

. "$srcdir/tests/tap.sh"

work=$(mktemp -d) && cd "$work" || bail_out "no folder to work in"
trap 'rm -rf "$work"' EXIT

{
    printf '#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 4 +X 8\n'
    printf '\200\100\040\201%.0s' $(seq 32)
} >'a "city".hdr'
"$PREFENV" bake 'a "city".hdr' -o maps.exr --alpha 0.2,0.05 --direction 1,0,0 --paper --size 16x8 --quiet ||
    bail_out "bake does not work"

json=$("$PREFENV" info --json maps.exr)
is "$(jq -cS 'del(.source_fingerprint)' <<<"$json")" "$(jq -cnS '{file: "maps.exr", kind: "maps",
    format_version: 4, method: "representative", weight: "ndf", eta: [0, 0, 0], k: [0, 0, 0],
    ndf: "beckmann", ndf_name: "", alpha: [0.2, 0.05], direction: [1, 0, 0],
    normals: 42, frequency: 2, angles: 1, suns: 0, images: 21, width: 16, height: 8,
    source_name: "a \"city\".hdr", source_width: 8, source_height: 4, accuracy: "exact", error_estimate: 0,
    lookup_error: 0}')" \
    "--json says all, and is JSON"
fingerprint() # ENV
{
    "$PREFENV" bake "$1" -o print.exr --paper --size 16x8 --json | jq -r .source_fingerprint
}
is "$(fingerprint 'a "city".hdr')" "$(jq -r .source_fingerprint <<<"$json")" "the environment has its own fingerprint"
like "$(jq -r .source_fingerprint <<<"$json")" '^[0-9a-f]{16}$' "of 16 digits"
oiiotool 'a "city".hdr' -d float --compression zips -o one.exr
oiiotool one.exr --compression none -o copy.exr
oiiotool one.exr --fill:color=0.1,0.1,0.1 1x1+5+3 -o other.exr
is "$(fingerprint copy.exr)" "$(fingerprint one.exr)" "which a copy, packed otherwise, has, too"
fails "and one with another texel has not" test "$(fingerprint other.exr)" = "$(fingerprint one.exr)"
LC_ALL=C sed 's/sourceFingerprint/sourceFingerprinT/' maps.exr >older.exr
is "$("$PREFENV" info --json older.exr | jq -c '[.normals, .source_fingerprint]')" '[42,""]' \
    "a file from before there was one does not tell"
LC_ALL=C sed "s/$(jq -r .source_fingerprint <<<"$json")/no number at all/" maps.exr >broken.exr
like "$("$PREFENV" info broken.exr 2>&1)" \
    "broken.exr: prefenv:sourceFingerprint 'no number at all' is not 16 hexadecimal digits" \
    "one that is no number is refused"

text=$("$PREFENV" info maps.exr)
like "$text" '^file       maps.exr$' "the text names the file"
like "$text" '^normals    42 \(frequency 2\)' "the normals"
like "$text" '^images     21 of 16x8$' "the images"
like "$text" '^alpha      0.2 along, 0.05 across the brush$' "the widths"
like "$text" '^source     a "city".hdr, 8x4$' "the source"
like "$text" '^accuracy   exact$' "the accuracy"

header=$(exrheader maps.exr) || bail_out "exrheader does not read a maps file"
like "$header" 'part 20' "exrheader sees 21 parts"
like "$header" 'dataWindow .*\(0 0\) - \(15 7\)' "of the right size"
like "$header" '(B|G|R), 16-bit floating-point' "of half floats"
like "$header" 'beckmann|Beckmann' "and the normal distribution"
like "$header" 'a "city".hdr' "and the source"
like "$(oiiotool --info -v maps.exr)" '21 subimages' "oiiotool sees the images"
like "$(oiiotool --info -v maps.exr)" 'prefenv' "and Prefenv's attributes"

"$PREFENV" bake 'a "city".hdr' -o hemispheres.exr --normals 42 --size 12x10 --quiet || bail_out "bake does not work"
text=$("$PREFENV" info hemispheres.exr)
like "$text" '^normals    42 \(frequency 2\), each with a picture of its hemisphere$' "hemispheres: the normals"
like "$text" '^images     42 of 12x10$' "and the images"
like "$text" '^accuracy   exact; lookups [0-9.e-]+ %$' "and the errors"
like "$(oiiotool --info hemispheres.exr)" '72 x +70' "an atlas of six by seven"

"$PREFENV" bake 'a "city".hdr' -o gold.exr --ndf ggx --weight microfacet --material gold --normals 12 --size 12x10 \
    --quiet || bail_out "bake does not work"
text=$("$PREFENV" info gold.exr)
like "$text" '^ndf        ggx$' "gold: its distribution of normals"
like "$text" '^weight     microfacet$' "its weight"
like "$text" '^index      0.21 \+ 3.272 i, 0.43 \+ 2.455 i, 1.38 \+ 1.914 i$' "and its index"
is "$("$PREFENV" info --json gold.exr | jq -c '[.weight, .eta, .k]')" \
    '["microfacet",[0.21,0.43,1.38],[3.272,2.455,1.914]]' "and in JSON"

# A file that is no maps file, each way one can be.
oiiotool maps.exr --subimage 0 --eraseattrib '.*' -o plain.exr
head -c 1500 maps.exr >truncated.exr
: >empty.exr
for input in missing.exr . 'a "city".hdr' plain.exr truncated.exr empty.exr; do
    said=$("$PREFENV" info "$input" 2>&1)
    is "$? $(wc -l <<<"$said")" "2 1" "$input: exit code 2, one line"
    like "$said" "^prefenv: info: $input: ." "$input: the line names it"
done

"$PREFENV" bake 'a "city".hdr' -o brushed.exr --alpha 0.3,0.1 --fast --quiet || bail_out "bake does not work"
like "$("$PREFENV" info brushed.exr)" 'poles +[0-9]+ brush directions for normals within [0-9.]+ degrees of the brush' \
    "brushed maps: poles"
is "$("$PREFENV" info --json brushed.exr | jq '.images > .normals and .pole_angles > 1')" true "and in JSON"

done_testing
