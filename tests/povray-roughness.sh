#!/bin/bash
# Roughness that varies, point by point: what POV-Ray shows with `samples all` is what `prefenv exact` answers for the
# same normal, viewer and roughness, and with maps what `prefenv eval` does, whether the roughness comes from numbers, a
# pattern, a pigment or a function, and however the texture stands.

. "$srcdir/tests/tap.sh"
. "$srcdir/tests/povray/render.sh"

size=24
chart chart.hdr 32 16
"$rays" rays $size 3 30,40,10 0,0,0 >rays.txt

file='hdr "chart.hdr"'

# sphere NAME BLOCK [OF-THE-TEXTURE [OF-THE-OBJECT]]: NAME.exr; a point of the sphere is its own normal
sphere()
{
    scene "$1.pov" <<END
camera { location -3*z direction z right x up y rotate <30, 40, 10> }
#declare Height = function { 0.5 + 0.4 * y };
sphere {
    0, 1
    ${5:-}
    texture {
        pigment { rgb 1 }
        finish { ambient 0 diffuse 0 reflection { 1 prefiltered_environment { $file $2 } } }
        ${3:-}
    }
    ${4:-}
}
END
    rm -f "$1.exr"
    render "$1.pov" +W$size +H$size +FE "+O$1.exr" || note "$said"
}

# exactly NAME PICTURE LAMBDA OPTION...: prefenv exact with LAMBDA, an expression of awk in x, y, z
exactly()
{
    awk "{ x = \$1; y = \$2; z = \$3; print \$0, ($3) }" rays.txt |
        "$PREFENV" exact chart.hdr --phong "${@:4}" >wanted.txt || note 'prefenv exact failed'
    ok "$1" "$rays" check "$2.exr" 3 1e-3 <wanted.txt && note "$tap_output"
}

# looked_up NAME PICTURE MAPS LAMBDA OPTION...: prefenv eval
looked_up()
{
    awk "{ x = \$1; y = \$2; z = \$3; print \$0, ($4) }" rays.txt | "$PREFENV" eval "$3" "${@:5}" >wanted.txt ||
        note 'prefenv eval failed'
    ok "$1" "$rays" check "$2.exr" 3 1e-3 <wanted.txt && note "$tap_output"
}

same()
{
    ok "$1" "$PREFENV" diff "$2.exr" "$3.exr" --fail-above-relative "${4:-0.0005}" || note "$tap_output"
}

# ---- one roughness ----

sphere all 'roughness 0.4, 0.2 direction y samples all'
"$PREFENV" exact chart.hdr --alpha 0.4,0.2 <rays.txt >wanted.txt
ok 'roughness, samples all: prefenv exact' "$rays" check all.exr 3 1e-3 <wanted.txt && note "$tap_output"
sphere many 'roughness 0.4, 0.2 direction y samples 20000'
same '... which a number of samples comes near, though it looks between texels' many all 0.03
sphere smooth 'lambda 0.6 samples all'
exactly 'lambda, samples all: Phong, the light from below the surface hidden' smooth 0.6 --horizon dark
sphere rough 'lambda 0.05 samples all'
exactly '... which tells on rough surfaces' rough 0.05 --horizon dark
sphere below 'lambda 0.05 samples all shadowless'
exactly 'shadowless: it counts' below 0.05
fails '... and makes a difference' "$PREFENV" diff rough.exr below.exr --fail-above-relative 0.01

# ---- what varies ----

varying='samples all shadowless'
sphere function "lambda function { 0.5 + 0.4 * y } $varying"
exactly 'a function' function '0.5 + 0.4 * y'
sphere named "lambda function { Height(x, y, z) } rotate 0 $varying"
exactly 'a function by its name' named '0.5 + 0.4 * y'
sphere steep "lambda function { 3 * y } $varying"
exactly '... beyond 0 and 1: as if it ended there' steep '3 * y < 0 ? 0 : 3 * y > 1 ? 1 : 3 * y'
sphere range "lambda 0.2, 0.8 function { 2 * y } $varying"
exactly 'two numbers and a function: from the one to the other' range \
    '0.2 + 0.6 * (2 * y < 0 ? 0 : 2 * y > 1 ? 1 : 2 * y)'
gradient='gradient y translate -y/2 scale 4'
sphere pattern "lambda 0.9, 0.1 pattern { $gradient } $varying"
exactly 'two numbers and a pattern' pattern '0.9 - 0.8 * (y / 4 + 0.5)'
sphere bare "lambda pattern { $gradient } $varying"
exactly 'a pattern by itself' bare 'y / 4 + 0.5'
sphere pigment "lambda pigment { $gradient color_map { [0 rgb 0.1] [1 rgb 0.9] } } $varying"
exactly 'a pigment: its brightness' pigment '0.1 + 0.8 * (y / 4 + 0.5)'
# Four squares, each as large as a quadrant of x and y.
oiiotool --create 2x2 3 --point:color=0.2,0.2,0.2 0,0 --point:color=0.4,0.4,0.4 1,0 --point:color=0.6,0.6,0.6 0,1 \
    --point:color=0.8,0.8,0.8 1,1 --attrib oiio:ColorSpace Linear -d uint8 -o stains.png
stains='png "stains.png" gamma 1'
quadrants='y > 0 ? (x < 0 ? 0.2 : 0.4) : (x < 0 ? 0.6 : 0.8)'
sphere image "lambda pigment { image_map { $stains } translate -1/2 scale 2 } $varying"
exactly 'an image' image "$quadrants"
sphere values "lambda 0.9, 0.1 pattern { image_pattern { $stains } translate -1/2 scale 2 } $varying"
exactly '... and as a pattern, between two numbers' values "0.9 - 0.8 * ($quadrants)"
# Rings about the z axis, up to a whole one and down again.
sphere wood "lambda 0.2, 0.9 pattern { wood scale 0.6 } $varying"
rings='d = sqrt(x * x + y * y) / 0.6 - int(sqrt(x * x + y * y) / 0.6)'
exactly 'wood' wood "0.2 + 0.7 * (($rings) < 0.5 ? 2 * d : 2 - 2 * d)"

sphere checker 'roughness 0.2, 0.5 pattern { checker } samples all'
sphere both 'roughness pigment { checker rgb 0.2 rgb 0.5 } samples all'
same 'roughness takes the same words as lambda' checker both
sphere even 'roughness 0.4 samples all'
sphere same 'roughness function { 0.4 } samples all'
same '... and a function of one value is that value' same even 0
sphere drawn 'roughness function { 0.4 } samples 300'
sphere alone 'roughness 0.4 samples 300'
same '... with a number of samples, too' drawn alone 0

sphere zero 'roughness 0.2, 0.5 function { 0 } samples all'
sphere nothing 'roughness 0.2, 0.5 function { sqrt(-1 - y * y) } samples all'
same 'what is not a number counts as 0' nothing zero 0

# ---- where it stands ----

sphere texture "lambda function { 0.5 + 0.4 * x } $varying" 'rotate 90*z'
exactly 'it follows the texture' texture '0.5 + 0.4 * y'
sphere object "lambda function { 0.5 + 0.4 * x } $varying" '' 'rotate 90*z'
exactly 'it follows the object' object '0.5 + 0.4 * y'
sphere block "lambda function { 0.5 + 0.4 * y } rotate 90*y $varying" 'rotate 90*z rotate -90*z'
"$rays" rays $size 3 30,40,10 0,90,0 | paste -d' ' - rays.txt |
    awk '{ print $1, $2, $3, $4, $5, $6, 0.5 + 0.4 * $8 }' | "$PREFENV" exact chart.hdr --phong >wanted.txt
ok 'the transformations of the block are those of the environment alone' "$rays" check block.exr 3 1e-3 <wanted.txt
sphere uv "lambda function { y } $varying" '' '' uv_mapping
exactly 'uv-mapped: along u and v' uv '0.5 + atan2(y, sqrt(x * x + z * z)) / 3.14159265358979'
sphere brush "roughness 0.2, 0.5 pattern { checker } direction x pattern { bozo } samples all"
same 'the pattern of the brush is another' brush checker

# ---- maps of many roughnesses ----

bake chart.hdr -o layers.exr --method layers --float
bake chart.hdr -o voxels.exr --method voxels --size 32 --float
for maps in layers voxels; do
    file="exr \"$maps.exr\""
    sphere $maps-even 'lambda 0.7'
    looked_up "$maps: lambda" $maps-even $maps.exr 0.7 --horizon dark
    sphere $maps-rough 'lambda 0.1'
    looked_up "$maps: what is rough, the light from below the surface hidden" $maps-rough $maps.exr 0.1 --horizon dark
    sphere $maps-below 'lambda 0.1 shadowless'
    looked_up "$maps: shadowless" $maps-below $maps.exr 0.1
    fails '... which makes a difference' "$PREFENV" diff $maps-rough.exr $maps-below.exr --fail-above-relative 0.01
    sphere $maps-function 'lambda function { 0.5 + 0.4 * y }'
    looked_up "$maps: a function" $maps-function $maps.exr '0.5 + 0.4 * y' --horizon dark
    sphere $maps-halves 'lambda 1, 0.1 function { y < 0 }'
    looked_up "$maps: half and half, with nothing between" $maps-halves $maps.exr 'y < 0 ? 0.1 : 1' --horizon dark
done
# Lambda of alpha: the exponent is (1 / alpha^2 - 1) / 2, and its lambda in 32 voxels by [Okumura Eq. 13].
lambda='6.2 / (32 * sqrt(exp(4 * log(256) / (1 / (0.3 + 0.2 * y) ^ 2 - 1)) - 1))'
sphere alpha 'roughness function { 0.3 + 0.2 * y }'
looked_up 'roughness as well: alpha, turned into lambda' alpha voxels.exr "$lambda" --horizon dark

# ---- microfacets of many roughnesses ----

bake chart.hdr -o grades.exr --alpha 0.15-0.6 --float
file='exr "grades.exr"'
sphere grades-even 'roughness 0.3'
looked_up 'grades: one roughness' grades-even grades.exr 0.3
sphere grades-function 'roughness function { 0.3 + 0.2 * y }'
looked_up 'grades: a function' grades-function grades.exr '0.3 + 0.2 * y'
sphere grades-beyond 'roughness function { 0.5 + y }'
looked_up '... that goes beyond them' grades-beyond grades.exr '0.5 + y'
sphere grades-beside 'roughness function { 0.3 + 0.2 * y } interreflection 8 hdr "chart.hdr"'
same 'grades: interreflection changes nothing where there is nothing else' grades-beside grades-function 0
file='hdr "chart.hdr"'
sphere grades-truth 'roughness function { 0.3 + 0.2 * y } samples all'
same 'grades: near to every texel summed up' grades-function grades-truth 0.03
bake chart.hdr -o brushed.exr --alpha 0.15-0.6 --aspect 2 --ndf ggx --angles 8 --float
file='exr "brushed.exr"'
sphere grades-brushed "roughness 0.15, 0.6 pattern { $gradient } direction z"
awk '{ print $0, 0.15 + 0.45 * ($2 / 4 + 0.5), 0, 0, 1 }' rays.txt | "$PREFENV" eval brushed.exr >wanted.txt
ok 'grades of a brushed metal: along the brush as said, across it in proportion' \
    "$rays" check grades-brushed.exr 3 1e-3 <wanted.txt && note "$tap_output"
sphere grades-pair 'roughness 0.4, 0.2 direction z'
awk '{ print $0, 0.4, 0, 0, 1 }' rays.txt | "$PREFENV" eval brushed.exr >wanted.txt
ok '... two numbers in their proportion' "$rays" check grades-pair.exr 3 1e-3 <wanted.txt && note "$tap_output"
sphere grades-range 'roughness 0.1, 0.5 pattern { checker }'
like "$said" 'from 0.15 to 0.6 along the brush, which 0.1 to 0.5 goes beyond' \
    '... and a range that it has not, warned of'

file='hdr "chart.hdr"'
sphere baked 'lambda function { 0.5 + 0.4 * y }'
same 'a plain environment is baked in layers for lambda' baked layers-function 0.002
bake chart.hdr -o default.exr --method grades --float
sphere alphas 'roughness function { 0.3 + 0.2 * y }'
like "$said" 'baking chart.hdr, for roughness that varies' '... in grades for a roughness that varies, and says so'
looked_up '... and shows what a file would' alphas default.exr '0.3 + 0.2 * y'
bake chart.hdr -o gold.exr --alpha 0.2-0.5 --ndf ggx --weight microfacet --material gold --float
sphere golden "roughness 0.5, 0.2 pattern { $gradient } type 2 metallic \"gold\""
looked_up '... of the two numbers, type and metal that are said' golden gold.exr '0.5 - 0.3 * (y / 4 + 0.5)'

# ---- errors, each in line 5 ----

wrong() # TEXT WORDS PATTERN
{
    printf 'sphere { 0, 1 pigment { rgb 1 } finish { reflection { 1\nprefiltered_environment { %s } } } }\n' "$2" |
        scene error.pov
    rejected "$1" "File 'error.pov' line 5: Parse Error: $3" error.pov
}

bake chart.hdr -o maps.exr --alpha 0.3 --normals 12 --size 16x8
wrong 'lambda 1.5' 'hdr "chart.hdr" lambda 1.5 samples all' 'lambda must lie between 0 .* but 1.5, 1.5 was given'
wrong 'a range of nothing' 'hdr "chart.hdr" lambda 0.2, 0.5 samples all' 'lambda 0.2, 0.5 is a range: say by what'
wrong 'a range out of range' \
    'hdr "chart.hdr" roughness 0, 0.5 pattern { bozo } samples all' 'roughness must lie between'
wrong 'lambda with some samples' 'hdr "chart.hdr" lambda 0.5 samples 20' \
    "Phong's lobe is not drawn from: write samples all"
wrong 'lambda with a type' 'hdr "chart.hdr" lambda 0.5 type 2 samples all' \
    "lambda is that of Phong's lobe .*remove type"
wrong 'lambda with a metal' 'hdr "chart.hdr" lambda pattern { bozo } metallic "gold"' 'lambda is that .*remove type'
wrong 'lambda of grades' 'exr "grades.exr" lambda 0.5' "lambda is that of Phong's lobe, but .* such as roughness 0.1"
wrong 'grades, and no roughness' 'exr "grades.exr"' '.*say which the surface has, such as roughness 0.1\.'
wrong 'grades with a type' 'exr "grades.exr" roughness 0.2 type 2' '.*maps of one kind of surface: remove samples, type'
wrong 'grades of another shape' 'exr "brushed.exr" roughness 0.2, 0.4' '.*2 times as large along .* but 0.2, 0.4 was'
wrong 'grades without shadows' 'exr "grades.exr" roughness 0.2 shadowless' 'shadowless lets light .* lambda'
wrong 'shadowless microfacets' 'hdr "chart.hdr" roughness 0.5 samples all shadowless' 'shadowless lets light .* lambda'
wrong 'maps of one roughness' 'exr "maps.exr" roughness function { x }' "'maps.exr' holds maps baked for one roughness"
wrong 'maps with samples all' 'exr "maps.exr" samples all' "'maps.exr' holds maps baked for one roughness"
wrong 'a pigment with a roughness' 'hdr "chart.hdr" roughness' 'Numeric expression|Expected'
wrong 'many roughnesses, and none said' 'exr "layers.exr"' '.*many roughnesses: say which the surface has'
wrong 'many roughnesses with samples' 'exr "voxels.exr" roughness 0.2 samples all' \
    ".*maps of Phong's lobe: remove samples"
wrong 'many roughnesses with a type' 'exr "layers.exr" roughness 0.2 type 2' ".*maps of Phong's lobe: remove"
wrong 'two widths' 'exr "layers.exr" roughness 0.2, 0.3' '.*the same in all directions, but 0.2, 0.3 was given'

done_testing
