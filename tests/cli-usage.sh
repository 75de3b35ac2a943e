# cli-usage.sh - the command's help, its version, and what it says to wrong usage: one sentence, exit code 2.

. "$srcdir/tests/tap.sh"

work=$(mktemp -d) && cd "$work" || bail_out "no folder to work in"
trap 'rm -rf "$work"' EXIT

commands="bake info eval exact diff ndf surface"

# What the command prints to one stream while the other is thrown away, and its exit code after it.
out()
{
    "$PREFENV" "$@" 2>/dev/null
    echo "exit $?"
}

err()
{
    "$PREFENV" "$@" 2>&1 >/dev/null </dev/null
    echo "exit $?"
}

# refused NAME PATTERN ARGUMENT...: exit code 2, and one line on standard error that the pattern matches.
refused()
{
    local name=$1 pattern=$2 said

    shift 2
    said=$(err "$@")
    is "$(wc -l <<<"$said") $(tail -n 1 <<<"$said")" "2 exit 2" "$name: one line and exit code 2"
    like "$said" "$pattern" "$name: says so"
}

# ---- help and version ----

version=$(sed -n 's/^#define PE_VERSION "\(.*\)"$/\1/p' "$srcdir/src/prefenv.h")
is "$(out --version)" "prefenv $version
exit 0" "--version is the header's"

for command in $commands; do
    like "$(out --help)" "^  $command " "--help lists $command"
    is "$(out help "$command")" "$(out "$command" --help)" "help $command is $command --help"
    like "$(out "$command" --help)" "^exit 0$" "$command --help exits with 0"
    is "$(out "$command" -h)" "$(out "$command" --help)" "$command -h is $command --help"
    is "$("$PREFENV" "$command" --help | awk 'length > 79')" "" "$command --help fits 80 columns"
done
is "$(out help)" "$(out --help)" "help is --help"
is "$(out -h)" "$(out --help)" "-h is --help"
is "$("$PREFENV" --help | awk 'length > 79')" "" "--help fits 80 columns"

# options_of COMMAND: the long options its help names, a line each.
options_of()
{
    "$PREFENV" "$1" --help | sed -n 's/^  \(-., \|    \)--\([a-z-]*\).*/\2/p' | sort | tr '\n' ' '
}

is "$(options_of bake)" \
    "alpha angles aspect direction error exact fast float force frames help ior json k levels material method ndf \
no-renormalise normals output paper quality quiet shard size threads threshold weight weights window " \
    "the options of bake"
is "$(options_of info)" "help json " "the options of info"
is "$(options_of eval)" "exponent help horizon interpolation threads " "the options of eval"
is "$(options_of exact)" \
    "alpha aspect direction help horizon ior k levels material ndf phong quiet size threads weight window " \
    "the options of exact"
is "$(options_of diff)" "amplify fail-above fail-above-relative help json mask output quiet " "the options of diff"

is "$(options_of ndf)" \
    "height help json keep-tilt normal-map output pitch quiet range raw scale smooth turn wrap " "the options of ndf"
is "$(options_of surface)" "feed help length output pitch quiet radius roughness seed size slope " \
    "the options of surface"

for command in $commands; do
    page=$srcdir/man/prefenv-$command.1.scd
    for option in $(options_of "$command"); do
        like "$(cat "$page")" "\\*--$option\\*" "the man page of $command has --$option"
    done
    like "$(cat "$page")" "^\\*-h\\*, \\*--help\\*$" "and -h"
done

# ---- wrong usage ----

refused "no command" "no command given"
refused "unknown command" "unknown command 'bakke'; did you mean 'bake'" bakke
refused "a command like no other" "unknown command 'sing'; see 'prefenv --help'" sing
refused "unknown option before the command" "unknown option '--versoin'; did you mean '--version'" --versoin
refused "help of an unknown command" "unknown command 'evil'; did you mean 'eval'" help evil
refused "more than --version" "'--bogus' is one argument too many" --version --bogus
refused "more than --help" "'bake' is one argument too many" --help bake
refused "more than help of a command" "'zzz' is one argument too many" help bake zzz
refused "unknown option" "bake: unknown option --nromals; did you mean --normals" bake x.hdr -o y.exr --nromals 42
refused "unknown option like no other" "bake: unknown option --frobnicate; see 'prefenv bake --help'" bake --frobnicate
refused "unknown letter" "bake: unknown option -x; see" bake --quiet -x
refused "option cut too short" "diff: --fail could be --fail-above or --fail-above-relative" diff --fail 1
refused "option without its value" "bake: --alpha needs a value: --alpha A" bake --alpha
refused "value for a switch" "info: --json takes no value" info --json=yes
refused "missing operand" "bake: ENV is missing" bake -o y.exr
refused "a PNG of slopes" "ndf: x.png: what is written is an OpenEXR; name it so, x.exr" ndf x.exr -o x.png
refused "a PNG of heights" "surface: x.png: what is written is an OpenEXR" surface turned -o x.png
refused "missing output" "bake: -o MAPS is missing" bake x.hdr
refused "operand too many" "info: 'b' is one argument too many" info a b

while IFS='|' read -r arguments pattern; do
    # shellcheck disable=SC2086 # words
    refused "$arguments" "$pattern" bake x.hdr -o y.exr $arguments
done <<'TABLE'
--alpha 0|--alpha 0: out of range: 0.001 to 2
--alpha 2.5|out of range: 0.001 to 2
--alpha 0.1,7|--alpha 0.1,7: out of range
--alpha thick|one number is wanted, two as in 0.1,0.03, or a range as in 0.02-0.5
--alpha nan|one number is wanted, two
--alpha 0.1,0.2,0.3|one number is wanted, two
--alpha 0.5-0.1|a range is from the smaller number to the larger
--alpha 0.1-3|--alpha 0.1-3: out of range: 0.001 to 2
--alpha 0.1-0.2-0.3|one number is wanted, two
--alpha 0.1,0.2-0.3|one number is wanted, two
--alpha 0.1-0.5 --paper|--alpha 0.1-0.5: a range is for --method grades; give one width, or leave out --paper
--alpha 0.1-0.5 --method voxels|--alpha 0.1-0.5: a range is for --method grades; give one width, or leave out the other
--alpha 0.1-1.5 --aspect 0.5|alpha 1.5, 3 is out of range
--alpha 0.1,0.2 --aspect 3|--aspect 3 contradicts --alpha 0.1,0.2, which says both widths; leave it out
--alpha 0.2,0.2 --aspect 2|--aspect 2 contradicts --alpha 0.2,0.2
--alpha 0.1,0.03 --aspect 3.33333|x.hdr: cannot open: No such file
--error 0.01 --quality high|--quality does not go with --error, which takes what memory it needs
--error 0.0004|--error 0.0004: out of range: 0.0005 to 0.1
--error 0.11|--error 0.11: out of range: 0.0005 to 0.1
--alpha 0.1 --method grades|--method grades has a range of widths; give --alpha as in 0.02-0.5, or leave it out
--ndf ./no.ndf.exr --aspect 2|--aspect does not go with --ndf
--direction 1,2|three numbers are wanted
--direction 0,0,0|the zero vector has no direction
--direction 1,inf,0|three numbers are wanted
--normals 11|out of range: 12 to 10242
--normals 10243|out of range: 12 to 10242
--normals 99999999999999999999|out of range: 12 to 10242
--normals many|a whole number is wanted
--normals 42.5|a whole number is wanted
--size 9000|out of range: 2 to 8192
--size 400x|width and height are wanted
--size 1x200|--size 1x200: out of range: 2 to 8192
--size 400x8193|out of range: 2 to 8192
--material gold|--material, --ior and --k are for --weight microfacet
--weight microfacet --material unobtainium|--material unobtainium: not known
--weight microfacet --material golf|did you mean gold?
--weight microfacet --material brass|brass: not known; what there is: aluminium, .*, titanium; or give --ior and --k
--weight microfacet --material gold --k 1,1,1|exclude each other
--weight microfacet --ior 1.5,1.5,1.5 --k 0,0,0|x.hdr: cannot open: No such file
--weight microfacet --ior 0,0,0 --k 0,0,0|the zero vector has no direction
--weight microfacet --ior 0.1,2,2 --k 0.2,1,1|of red is no conductor
--weight microfacet --ndf phong|does not go with ndf phong
--weight best|not known; what there is: ndf, microfacet
--ndf ggg|--ndf ggg: not known; did you mean ggx?
--ndf gaussian|--ndf gaussian: not known; what there is: beckmann, ggx, phong, or a file
--ndf ./no.ndf.exr|no.ndf.exr
--ndf ./no.ndf.exr --alpha 0.1|--alpha does not go with --ndf
--ndf phong --alpha 1.5|alpha 1.5, 1.5 is out of range for phong; each lies between 0.001 and 1
--method best|not known; what there is: hemispheres, representative, baseline
--threads 0|out of range: 1 to 256
--exact --fast|--exact and --fast exclude each other
--method layers --direction 1,0,0|--direction does not go with --method layers and voxels
--method layers --weight ndf|--weight does not go with --method layers and voxels
--method voxels --k 1,1,1|--k does not go with --method layers and voxels
--method voxels --ndf beckmann|--ndf does not go with --method voxels
--window 3|--window is for --method layers and voxels
--levels 256|--levels is for --method layers and voxels
--method baseline --normals 92|--normals does not go with --method baseline
--method voxels --exact --weights w.bin|--weights is for a table of weights, which --exact goes without
--method voxels --exact --threshold 0.1|--threshold is for a table of weights
--method voxels --exact --no-renormalise|--no-renormalise is for a table of weights
TABLE
is "$(ls)" "" "nothing was written"

refused "exponent without weighted" "--exponent is for --interpolation weighted" eval x.exr --exponent 50
refused "unknown interpolation" "what there is: nearest, weighted, linear" eval x.exr --interpolation cubic

for option in "--ndf beckmann" "--direction 1,0,0" "--aspect 2" "--ior 1,1,1"; do
    # shellcheck disable=SC2086 # words
    refused "exact --phong $option" "exact: ${option%% *} does not go with --phong" exact x.hdr --phong $option
done
for option in "--size 64" "--window 6.2" "--levels 100" "--horizon ignored"; do
    # shellcheck disable=SC2086 # words
    refused "exact $option" "exact: ${option%% *} is for --phong" exact x.hdr $option
done
refused "amplify without a picture" "diff: --amplify is for the picture of differences" diff a.exr b.exr --amplify 4

like "$(out eval --help | tr '\n' ' ')" "'nx ny nz ox oy oz dx dy dz', with the brush direction" \
    "eval says that nine will do"
# The defaults that the help of surface states are those of the library.
while read -r kind option value; do
    like "$("$PREFENV" surface --help | tr -s ' \n' ' ')" "--$option [^[]* Default: [^[]*$value" \
        "surface: --$option, $value"
    "$PREFENV" surface "$kind" -o default.exr -q && "$PREFENV" surface "$kind" -o given.exr -q "--$option" "$value"
    ok "it is the default of $kind" cmp default.exr given.exr
    rm -f default.exr given.exr
done <<'TABLE'
turned feed 100um
milled feed 128um
turned radius 400um
milled slope 0.12
turned roughness 0.04um
milled roughness 0.06um
blasted roughness 0.4um
brushed roughness 0.6um
turned length 16um,8um
blasted length 8um
brushed length 40um,8um
TABLE

# ---- output that cannot be written ----

is "$("$PREFENV" --help 2>&1 >/dev/full; echo "exit $?")" \
    "prefenv: cannot write to standard output: No space left on device
exit 2" "a full disk is noticed"
like "$("$PREFENV" bake --help 2>&1 >&-; echo "exit $?")" "^exit 2$" "a closed standard output is noticed"

done_testing
