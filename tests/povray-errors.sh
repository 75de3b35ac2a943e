#!/bin/bash
# What can be wrong in a prefiltered_environment block: each is one error of POV-Ray's own with file and line, says the
# way out, and leaves no picture.  Files are looked for and opened as POV-Ray's others.

. "$srcdir/tests/tap.sh"
. "$srcdir/tests/povray/render.sh"

chart chart.hdr 16 8
bake chart.hdr -o maps.exr --alpha 0.3 --normals 12 --size 16x8
"$PREFENV" surface blasted -o cut.exr --size 64x64 --quiet &&
    "$PREFENV" ndf cut.exr -o cut.ndf.exr --wrap --quiet || bail_out 'cut.exr was not measured'
bake chart.hdr -o measured.exr --ndf cut.ndf.exr --method representative --normals 12 --size 16x8
echo 'not a picture' >text.exr
head -c 2000 maps.exr >cut.exr
: >empty.hdr
cp maps.exr wrong.png

# The block stands in line 5: three lines of the scene's head, then the sphere.
reflection() # WORDS
{
    printf 'sphere { 0, 1 pigment { rgb 1 } finish { reflection { 1\nprefiltered_environment { %s } } } }\n' "$1" |
        scene error.pov
}

wrong() # TEXT WORDS PATTERN
{
    reflection "$2"
    rejected "$1" "File 'error.pov' line 5: Parse Error: $3" error.pov
}

wrong 'no file at all' '' 'Expected .*exr, hdr or png'
wrong 'a file without its kind' '"maps.exr"' 'Expected .*exr, hdr or png'
wrong 'a missing file' 'exr "missing.exr"' "Cannot find 'missing.exr': check the name or add its folder to Library_Path"
wrong 'not an EXR' 'exr "text.exr"' "'text.exr' is not an OpenEXR file"
wrong 'an EXR called a PNG' 'png "wrong.png"' "'wrong.png' is not a PNG file: write exr, hdr or png as its contents are"
wrong 'an EXR called a PNG, the second time it is named' \
    'exr "maps.exr" } } } } sphere { 0, 1 finish { reflection { 1 prefiltered_environment { png "maps.exr"' \
    "'maps.exr' is not a PNG file"
wrong 'an empty file' 'hdr "empty.hdr"' "'empty.hdr' is not a Radiance HDR file"
wrong 'a file that was cut short' 'exr "cut.exr"' "cut.exr"
wrong 'method 0' 'exr "maps.exr" method 0' \
    'method must be 1 \(nearest\), 2 \(weighted\) or 3 \(linear\), but 0 was given'
wrong 'method 2.5' 'exr "maps.exr" method 2.5' 'method must be 1 .*but 2.5 was given'
wrong 'exponent 0' 'exr "maps.exr" exponent 0' 'exponent must be above 0'
wrong 'a negative exponent' 'exr "maps.exr" method 2 exponent -3' 'exponent must be above 0 .*-3 was given'
wrong 'roughness 0' 'hdr "chart.hdr" roughness 0 samples 4' 'roughness must lie between 0.001 and 2, but 0, 0 was given'
wrong 'a second roughness out of range' 'hdr "chart.hdr" roughness 0.1, 7 samples 4' \
    'roughness must lie .* but 0.1, 7 was'
wrong 'samples 0' 'hdr "chart.hdr" roughness 0.1 samples 0' 'samples must be a whole number from 1'
wrong 'samples 1.5' 'hdr "chart.hdr" roughness 0.1 samples 1.5' 'samples must be a whole number .*1.5 was given'
wrong 'traced without samples' 'hdr "chart.hdr" roughness 0.1 traced' \
    'traced says that the directions of samples are traced: give their number, such as samples 64'
wrong 'maps traced' 'exr "maps.exr" traced' "'maps.exr' holds maps baked for one roughness: remove .*traced"
wrong 'a negative highlight' 'exr "maps.exr" highlight -1' \
    'highlight must be on, off or an amount that is not negative, but -1 was given'
wrong 'a highlight with what is no distribution' 'exr "measured.exr" highlight exr "maps.exr"' 'maps.exr'
wrong 'a highlight of measured maps without their file' 'exr "measured.exr" highlight' \
    "'measured.exr' holds maps of a measured distribution, .*highlight exr \"cut.ndf.exr\""
wrong '... with a file for others' 'exr "maps.exr" highlight exr "cut.ndf.exr"' \
    'highlight takes a file with maps of a measured distribution only'
wrong '... and in the scene' 'hdr "chart.hdr" type exr "cut.ndf.exr" highlight exr "cut.ndf.exr"' \
    'highlight takes a file with maps of a measured distribution only'
wrong 'half a ray' 'hdr "chart.hdr" roughness 0.1 interreflection 1.5' \
    'interreflection must be a whole number of rays from 0 to 1000000, but 1.5 was given'
wrong 'maps without their environment' 'exr "maps.exr" interreflection 8' \
    "interreflection needs the environment that 'maps.exr' was baked from: .*interreflection 8 exr \"chart.hdr\""
wrong 'maps for their environment' 'exr "maps.exr" interreflection 8 exr "maps.exr"' \
    "interreflection needs the environment that 'maps.exr' was baked from"
wrong 'an environment twice' 'hdr "chart.hdr" roughness 0.1 interreflection 8 hdr "chart.hdr"' \
    'interreflection takes a file behind its number with maps only'
wrong 'interreflection and samples' 'hdr "chart.hdr" roughness 0.1 samples 4 interreflection 8' \
    'interreflection corrects what is looked up in maps, but samples asks for none'
wrong 'accuracy and samples' 'hdr "chart.hdr" roughness 0.1 samples 4 accuracy 0.01' \
    'accuracy says how exact the maps are that are baked, but samples asks for none: remove either'
wrong 'an accuracy out of range' 'hdr "chart.hdr" roughness 0.1 accuracy 0' \
    'accuracy, a relative error, must lie between 0.0005 and 0.1, but 0 was given'
wrong 'a misspelled word' 'hdr "chart.hdr" rougness 0.1' \
    'rougness is not a word of prefiltered_environment. Its words are: .*roughness, lambda, .*highlight'
wrong 'no direction' 'hdr "chart.hdr" roughness 0.1 samples 4 direction 0' 'direction must not be <0, 0, 0>'
wrong 'maps with a roughness' 'exr "maps.exr" roughness 0.2' "'maps.exr' holds maps baked for one roughness.*remove"
wrong 'maps with samples' 'exr "maps.exr" samples 20' "'maps.exr' holds maps"
wrong 'uv_mapping without a direction' 'hdr "chart.hdr" roughness 0.1 uv_mapping' \
    'uv_mapping and pattern say how .*give a direction'
wrong 'a pattern without a direction' 'exr "maps.exr" pattern { bozo }' 'uv_mapping and pattern say how'
wrong 'no axis' 'hdr "chart.hdr" roughness 0.1 direction rotate 0' 'direction must not be <0, 0, 0>'
wrong 'no metal' 'hdr "chart.hdr" roughness 0.1 metallic "gould"' \
    "'gould' is not a metal that is known here: write one of aluminium, .*titanium"
wrong 'a metal without quotes' 'hdr "chart.hdr" roughness 0.1 metallic copper' \
    'metallic takes the name of a metal in quotes: write metallic "copper"'
wrong 'alpha' 'hdr "chart.hdr" alpha 0.1' 'alpha, .* is called roughness here: write roughness 0.1'
wrong 'a word of something else' 'hdr "chart.hdr" roughness 0.1 ambient 0.1' \
    'Expected .*method, exponent, .* or \}.*, ambient found instead'
wrong 'an index of nothing' 'hdr "chart.hdr" roughness 0.1 ior 0.1, 0.1' \
    'the index of refraction 0.1 .* is no conductor'
wrong 'type 4' 'hdr "chart.hdr" roughness 0.1 type 4' 'type must be 1 \(Beckmann\), 2 .*but 4 was given'
wrong 'maps with a type' 'exr "maps.exr" type 2' "'maps.exr' holds maps"
wrong 'a type out of no distribution' 'hdr "chart.hdr" type exr "maps.exr"' 'maps.exr'
wrong 'a plain environment alone' 'hdr "chart.hdr"' \
    "'chart.hdr' is a plain environment: give the roughness of the surface"
wrong 'a plain environment without roughness' 'hdr "chart.hdr" samples 4' \
    "'chart.hdr' is a plain environment: .*roughness"
wrong 'a plain environment with samples and a method' 'hdr "chart.hdr" roughness 0.1 samples 4 method 2' \
    'method and exponent say how prefiltered maps are looked up, but samples'
wrong 'three roughnesses' 'hdr "chart.hdr" roughness <0.1, 0.2, 0.3>' 'roughness takes one or two values, .* but 3 were'
wrong 'a roughness out of range in a vector' 'hdr "chart.hdr" roughness <0.1, 0>' 'roughness must lie .* 0.1, 0 was'
wrong 'a stretched environment' 'exr "maps.exr" scale <1, 2, 1>' \
    'An environment can be rotated, mirrored and scaled evenly'
wrong 'an unknown word' 'exr "maps.exr" gloss 3' ''

scene error.pov <<<'sky_sphere { pigment { prefiltered_environment { exr "maps.exr" } } }'
rejected 'maps as a pigment' \
    "File 'error.pov' line 4: Parse Error: 'maps.exr' holds prefiltered maps, .*baked from" error.pov
scene error.pov <<<'sky_sphere { pigment { prefiltered_environment {
    hdr "chart.hdr" interreflection 0 exr "maps.exr" } } }'
rejected 'a file behind interreflection in a pigment' 'line 5: Parse Error: In a pigment, .*interreflection' error.pov
scene error.pov <<<'sky_sphere { pigment { prefiltered_environment { hdr "chart.hdr" method 3 } } }'
rejected 'a method in a pigment' "File 'error.pov' line 4: Parse Error: In a pigment, .*move method" error.pov
scene error.pov <<<'plane { y, 0 normal { prefiltered_environment { hdr "chart.hdr" } } }'
rejected 'as a normal' "line 4: Parse Error: .*prefiltered_environment.* can only be used in a pigment" error.pov
scene error.pov <<<'sky_sphere { pigment { prefiltered_environment { hdr "chart.hdr" } color_map { [0 rgb 1] } } }'
rejected 'a pigment with a color_map' "line 4: Parse Error: Cannot use color_map" error.pov

# ---- the environment behind interreflection ----

# source_of NAME ENVIRONMENT WARNINGS [MAPS]: how often maps are said to be of another environment.
source_of()
{
    local maps=${4:-maps.exr}

    reflection "exr \"$maps\" interreflection 2 hdr \"$2\""
    render error.pov +W8 +H8 -F
    is "$render_status $(grep -o "line 5: Parse Warning: '$maps' was baked from .* names another: '${2##*/}' of" \
        <<<"$said" | wc -l)" "0 $3" "$1" || note "$said"
}

mkdir others
cp chart.hdr copy.hdr
"$rays" chart 16 8 0 >others/chart.hdr || bail_out 'no other chart'
chart larger.hdr 32 16
LC_ALL=C sed 's/sourceFingerprint/sourceFingerprinT/' maps.exr >older.exr
LC_ALL=C sed 's/prefenv:source\x00/prefenv:sourcE\x00/' older.exr >nameless.exr
source_of 'the environment that maps are of, behind interreflection' chart.hdr 0
source_of '... a copy of it' copy.hdr 0
source_of '... another of its name and size is warned of' others/chart.hdr 1
source_of '... and one of another size' larger.hdr 1
source_of 'maps that have no fingerprint go by the name' chart.hdr 0 older.exr
source_of '... which a copy has not' copy.hdr 1 older.exr
source_of '... if there is one' others/chart.hdr 0 nameless.exr
source_of '... and by the size' larger.hdr 1 nameless.exr

# ---- identifiers of the scene's own ----

# own NAME DECLARATIONS: NAME.exr of words that are not reserved
own()
{
    scene own.pov <<END
$2
camera { location -5*z look_at 0 right 2*x up y }
light_source { <3, 4, -5> rgb Grey }
sphere { -x, 1 pigment { rgb 1 } finish { ambient Grey diffuse 0
  reflection { 1 prefiltered_environment { hdr "chart.hdr" roughness 0.3 highlight samples 4 traced } } } }
sphere { x, 1 pigment { rgb 1 } finish { ambient 0 diffuse 0
  reflection { 1 prefiltered_environment { exr "maps.exr" highlight 2 interreflection 4 hdr "chart.hdr" } } } }
sphere { -y, 0.3 pigment { rgb 1 } finish { ambient 0 diffuse 0
  reflection { 1 prefiltered_environment { hdr "chart.hdr" lambda 0.7 highlight highlight off } } } }
END
    render own.pov +W32 +H16 +FE "+O$1.exr" || note "$said"
}

own free '#declare Grey = 0.7;'
own floats '#declare traced = 0.7; #declare interreflection = 0; #declare highlight = 0.9; #declare Grey = traced;'
ok 'identifiers of the names of words: these are words still' "$PREFENV" diff floats.exr free.exr --fail-above 0
own others '#declare traced = function { x }; #declare interreflection = "none"; #declare highlight = <1, 2, 3>;
    #declare Grey = 0.7 * highlight.x;'
ok '... of whatever they are' "$PREFENV" diff others.exr free.exr --fail-above 0
wrong 'a word in quotes' 'hdr "chart.hdr" roughness 0.1 "highlight"' 'Expected .*method, exponent'

# ---- where files are found ----

mkdir -p library/deeper
cp maps.exr library/deeper/elsewhere.exr
reflection 'exr "elsewhere.exr"'
rejected 'a file in a folder that is not on the path' "Cannot find 'elsewhere.exr'" error.pov
ok 'a file on Library_Path' render error.pov +Llibrary/deeper +W8 +H8 -F
reflection 'exr "elsewhere"'
ok 'the extension may be left out' render error.pov +Llibrary/deeper +W8 +H8 -F

reflection 'exr "maps.exr" translate 3*x'
ok 'a translation changes nothing' render error.pov +W8 +H8 -F
render error.pov +W8 +H8 -F
like "$said" 'Parse Warning: .*infinitely far away' '... and is warned of'

printf '#version unofficial 3.7;\nglobal_settings { assumed_gamma 2.2 }\nsky_sphere { %s }' \
    'pigment { prefiltered_environment { hdr "chart.hdr" } }' >gamma.pov
render gamma.pov +W8 +H8 -F
like "$said" "File 'gamma.pov' line 3: Parse Warning: The radiance of an environment is linear: use assumed_gamma 1.0" \
    'another assumed_gamma than 1 is warned of'

chart square.hdr 16 16
oiiotool chart.hdr --clamp:max=1 -d uint8 -o eight.png
scene odd.pov <<<'sky_sphere { pigment { prefiltered_environment { hdr "square.hdr" } } }'
render odd.pov +W8 +H8 -F
like "$said" "line 4: Parse Warning: 'square.hdr': 16 x 16 texels are not twice as wide as high" \
    'an environment of another shape than 2:1 is warned of'
scene odd.pov <<<'sky_sphere { pigment { prefiltered_environment { png "eight.png" } } }'
render odd.pov +W8 +H8 -F
like "$said" "line 4: Parse Warning: 'eight.png': a PNG holds no light brighter than white" '... and so is a PNG'

printf '%s\n' 'sphere { 0, 1 finish { reflection { 1 prefiltered_environment { exr "maps.exr" } } } }' >hint.pov
rejected 'without #version unofficial the way out is said' \
    "line 1: Parse Error: .*'prefiltered_environment' found instead: it is a word .* #version unofficial 3.7" hint.pov

# amount NAME WORDS WARNINGS: how often a reflection of these words is warned of for showing nothing.
amount()
{
    scene amount.pov <<<"sphere { 0, 1 finish { reflection { $2 } } }"
    render amount.pov +W8 +H8 -F
    is "$render_status $(grep -o "line 4: Parse Warning: .* amount is missing or 0" <<<"$said" |
        wc -l)" "0 $3" "$1"
}

amount 'a block without an amount is warned of' 'prefiltered_environment { exr "maps.exr" }' 1
amount '... with fresnel, too' 'fresnel prefiltered_environment { exr "maps.exr" }' 1
amount 'an amount by fresnel is one' '1 fresnel prefiltered_environment { exr "maps.exr" }' 0
amount 'an amount at normal incidence only is one' '1, 0 prefiltered_environment { exr "maps.exr" }' 0

reflection 'exr "maps.exr" scale <1, 0, 1>'
render error.pov +W8 +H8 -F
like "$render_status $said" "^0 .*line 5: Parse Warning: Illegal Value: Scale Y by 0.0. Changed to 1.0" \
    'a scale of 0 is taken as 1, with a warning'

printf '%s\n' '#version 3.7;' '#declare prefiltered_environment = 1; sphere { 0, prefiltered_environment }' \
    '#version unofficial 3.7;' 'sphere { 0, prefiltered_environment }' >name.pov
rejected 'an identifier of the new name holds until #version unofficial' "File 'name.pov' line 4: Parse Error" name.pov

# POV-Ray 3.7.0.10's restrictions let everything through on Unix (patches/README.md), so all that can be held is that
# they treat an environment as they treat a picture.
mkdir -p .povray/3.7 forbidden
cp chart.hdr forbidden/
printf '[File I/O Security]\nrestricted\n[Permitted Paths]\nread+write* = %s/library\n' "$work" >.povray/3.7/povray.conf
scene picture.pov <<<'sky_sphere { pigment { image_map { hdr "forbidden/chart.hdr" map_type 1 } } }'
scene environment.pov <<<'sky_sphere { pigment { prefiltered_environment { hdr "forbidden/chart.hdr" } } }'
render picture.pov +W8 +H8 -F
picture_status=$render_status
render environment.pov +W8 +H8 -F
is "$render_status" "$picture_status" "the I/O restrictions treat an environment as they treat an image_map"
rm -r .povray

if [ "$(id -u)" -eq 0 ]; then
    skip 'root may read every file'
else
    cp maps.exr closed.exr && chmod 0 closed.exr
    wrong 'a file that may not be read' 'exr "closed.exr"' "Cannot (find|open) 'closed.exr'"
fi

# ---- no noise ----

reflection 'exr "maps.exr"'
said=$("$POVRAY_PREFENV" +Ierror.pov -D +W8 +H8 -F -V 2>&1)
is "$(grep -Ei 'cannot|warning:|error:|restrictions are' <<<"$said")" '' 'nothing is complained of where all is well'

done_testing
