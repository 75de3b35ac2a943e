# cli-bake.sh - `prefenv bake`: what it makes, every kind of bad input, outputs that cannot be written, interruption,
# and the progress bar.

. "$srcdir/tests/tap.sh"

work=$(mktemp -d) && cd "$work" || bail_out "no folder to work in"
trap 'rm -rf "$work"' EXIT

quick="--method representative --size 16x8 --normals 12"

# flat_hdr WIDTH HEIGHT: a Radiance picture without run lengths, all of one colour.
flat_hdr()
{
    printf '#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y %d +X %d\n' "$2" "$1"
    printf '\200\100\040\201%.0s' $(seq $(($1 * $2)))
}

flat_hdr 16 8 >env.hdr
oiiotool env.hdr -o env.exr || bail_out "oiiotool does not work"
oiiotool env.hdr --clamp:max=1 -d uint8 -o env.png || bail_out "oiiotool does not work"

# ---- what it makes ----

for kind in hdr exr png; do
    # shellcheck disable=SC2086 # words
    said=$("$PREFENV" bake env.$kind -o $kind.pe.exr $quick 2>&1)
    is "$?" 0 "bakes from $kind"
    like "$said" "^$kind.pe.exr: 6 maps of 16x8, [0-9.]+ MB, in [0-9.]+ s, exact$" "and sums up in a line"
done
# shellcheck disable=SC2086
is "$("$PREFENV" bake env.hdr -o q.exr --quiet $quick 2>&1)" "" "--quiet is quiet"
# shellcheck disable=SC2086
is "$("$PREFENV" bake env.hdr -o j.exr --json --alpha 0.2,0.1 $quick | jq -c '[.file, .images, .alpha, .accuracy]')" \
    '["j.exr",6,[0.2,0.1],"exact"]' "--json says what was made"
# shellcheck disable=SC2086
"$PREFENV" bake env.hdr -o f.exr --quiet --fast $quick
is "$("$PREFENV" info --json f.exr | jq -r .accuracy)" fast "--fast is fast, and recorded"
like "$("$PREFENV" bake env.exr -o h.exr --normals 42 --size 12x12 2>&1)" \
    "^h.exr: 42 maps of 12x12, [0-9.]+ MB, in [0-9.]+ s, exact; lookups [0-9.e-]+ %$" \
    "hemispheres by default, which say their error"
is "$("$PREFENV" bake env.hdr -o p.exr --json --paper | jq -c '[.method, .normals, .images, .width, .height]')" \
    '["representative",42,21,400,200]' "--paper is the paper's settings"
said=$("$PREFENV" bake env.hdr -o k.exr --json --normals 12 --size 12x12 --angles 4)
is "$(jq -c '[.angles, .images]' <<<"$said")" '[4,48]' "--angles"
"$PREFENV" bake env.hdr -o b.exr --quiet --method baseline --size 16x8
is "$("$PREFENV" info --json b.exr | jq -c '[.method, .images, .normals]')" '["baseline",1,0]' "--method baseline"

for threads in 1 2 3; do
    # shellcheck disable=SC2086
    "$PREFENV" bake env.hdr -o t$threads.exr --quiet --threads $threads $quick
done
ok "the same bytes for 1 and 2 threads" cmp t1.exr t2.exr
ok "the same bytes for 1 and 3 threads" cmp t1.exr t3.exr

echo old >old.exr
# shellcheck disable=SC2086
"$PREFENV" bake env.hdr -o old.exr --quiet $quick
ok "a file that exists is replaced" cmp old.exr t1.exr

# ---- repairs and brightness ----

oiiotool env.exr --fill:color=-1,0,0 2x1+0+0 -o negative.exr
# shellcheck disable=SC2086
said=$("$PREFENV" bake negative.exr -o n.exr $quick 2>&1)
like "$said" '^n.exr: 6 maps .*, exact; 2 source texels repaired$' "repaired texels are counted in the summary"
is "$("$PREFENV" bake env.hdr -o n.exr --json --paper --size 8x4 | jq .repairs)" 0 "and in JSON: none"
like "$said" 'warning: negative.exr: [0-9.]+ % of its light is negative and was left out' "much of them is warned of"
# shellcheck disable=SC2086
is "$("$PREFENV" bake negative.exr -o n.exr -q $quick 2>&1)" "" "which --quiet leaves out"
oiiotool env.exr --fill:color=-0.001,0,0 2x1+0+0 -o dim.exr
# shellcheck disable=SC2086
said=$("$PREFENV" bake dim.exr -o n.exr $quick 2>&1)
is "$(wc -l <<<"$said") $(grep -c '2 source texels repaired' <<<"$said")" "1 1" "little of them is not"
for value in nan inf 3e38; do
    oiiotool env.exr -d float --fill:color=$value,0,0 1x1+3+3 -o $value.exr
    # shellcheck disable=SC2086
    like "$("$PREFENV" bake $value.exr -o n.exr $quick 2>&1)" \
        "warning: $value.exr: 1 of 128 texels, NaN, infinite or above 1e\+30, was repaired" "$value is warned of"
done

# What the baker takes, the reader takes.
for value in 3e38 9e29; do
    oiiotool env.exr --resize 64x32 -d float --fill:color=$value,$value,$value 1x1+20+9 -o sun.exr
    "$PREFENV" bake sun.exr -o sun.pe.exr --alpha 0.3 --normals 12 --size 12x12 --quiet
    ok "maps of a texel of $value are read" "$PREFENV" info sun.pe.exr
done
is "$("$PREFENV" info --json sun.pe.exr | jq .suns)" 1 "the last had a sun"
said=$("$PREFENV" bake env.hdr -o n.exr --normals 10242 --size 120x120 2>&1)
is "$? $said" "2 prefenv: bake: 10242 maps of 120 x 120 are more than can be held; make them fewer, or smaller than \
13104 texels each" "more maps than the reader takes are refused before they are made"

oiiotool env.exr --resize 32x32 -o square.exr
# shellcheck disable=SC2086
like "$("$PREFENV" bake square.exr -o n.exr $quick 2>&1)" 'warning: square.exr: 32 x 32 texels are not twice as wide' \
    "an environment of another shape than 2:1 is warned of"
# shellcheck disable=SC2086
like "$("$PREFENV" bake env.png -o n.exr $quick 2>&1)" 'warning: env.png: a PNG holds no light brighter than white' \
    "and so is a PNG"

said=$("$PREFENV" bake negative.exr -o e.exr --error 0.0005 --normals 12 --size 8x8 2>&1)
like "$said" "warning: e.exr: the error of lookups is [0-9.]+ %, not the 0.05 % asked for; give more --normals" \
    "an error that was not reached is told"
oiiotool --create 32x16 3 --box:color=9,9,9:fill=1 20,4,20,4 -d half -o lamp.exr
said=$("$PREFENV" bake lamp.exr -o e.exr --normals 12 --size 8x8 --alpha 0.1 2>&1)
like "$said" "warning: e.exr: lookups are off by about [0-9]+ %, which shows; give more --normals, and a larger" \
    "and one that shows, too, where none was asked for"
"$PREFENV" surface blasted -o heights.exr --size 64x64 --quiet &&
    "$PREFENV" ndf heights.exr -o cut.exr --wrap --quiet
# shellcheck disable=SC2086
like "$("$PREFENV" bake heights.exr -o n.exr $quick 2>&1)" "heights.exr: is a height field; measure it with" \
    "a height field is no environment"
# shellcheck disable=SC2086
like "$("$PREFENV" bake cut.exr -o n.exr $quick 2>&1)" "cut.exr: is a table of slopes; give it behind --ndf" \
    "nor is a table of slopes"
oiiotool --pattern noise:type=uniform:min=0:max=1 256x128 3 -d half -o noise.exr
said=$("$PREFENV" bake noise.exr -o e.exr --paper --fast --size 40x20 --alpha 0.6,0.02 --error 0.0005 2>&1)
like "$said" "warning: e.exr: the error of texels is [0-9.]+ %, not the 0.05 % asked for; --exact has none$" \
    "of lat-long maps that of their texels"

oiiotool env.exr --mulc 1e6 -d float -o sun.exr
# shellcheck disable=SC2086
said=$("$PREFENV" bake sun.exr -o s.exr $quick 2>&1)
like "$said" "warning: s.exr: brighter than half floats can hold .*--float" \
    "too bright for half floats: written as floats"
like "$(oiiotool --info -v s.exr)" "float" "and has float channels"
# shellcheck disable=SC2086
is "$("$PREFENV" bake sun.exr -o s2.exr --float $quick 2>&1 | grep -c warning)" 0 "with --float there is no warning"

# ---- bad input ----

mkdir folder
: >empty.exr
echo "once upon a time" >text.exr
for kind in exr hdr png; do
    head -c $(($(stat -c %s env.$kind) * 2 / 3)) env.$kind >truncated.$kind
    head -c 12 env.$kind >head.$kind
done
printf '#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2000000000 +X 2000000000\n' >huge.hdr
printf '#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y -4 +X 4\n' >negative.hdr
printf '#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 4 +X 4\n' >xyze.hdr
# The width and height of a PNG stand in bytes 16 to 23, and their check sum in 29 to 32.
{ head -c 16 env.png; printf '\177\377\377\377\177\377\377\377'; tail -c +25 env.png; } >huge.png
# The dataWindow of an OpenEXR file: four 32-bit integers behind name, type and size.
cp env.exr huge.exr
offset=$(grep -abo dataWindow huge.exr | head -n 1 | cut -d: -f1)
printf '\0\0\0\0\0\0\0\0\377\377\377\177\377\377\377\177' |
    dd of=huge.exr bs=1 seek=$((offset + 11 + 6 + 4)) conv=notrunc status=none

cp t1.exr maps.exr
ls >before
for input in missing.exr folder empty.exr text.exr truncated.exr truncated.hdr truncated.png \
    head.exr head.hdr head.png huge.hdr huge.png huge.exr negative.hdr xyze.hdr maps.exr; do
    # shellcheck disable=SC2086
    said=$("$PREFENV" bake $input -o out.exr $quick 2>&1)
    is "$? $(wc -l <<<"$said")" "2 1" "$input: exit code 2, one line"
    like "$said" "^prefenv: bake: $input: ." "$input: the line names it"
done
is "$(ls | grep -v '^before$')" "$(grep -v '^before$' before)" "bad input leaves nothing behind"

# shellcheck disable=SC2086
said=$("$PREFENV" bake env.hdr -o out.exr --normals 43 --size 16x8 2>&1)
is "$? $said" "2 prefenv: bake: normals 43 is not 10 f^2 + 2 for a whole f from 1 to 32; the nearest are 42 and 92" \
    "a number of normals that there is not: the nearest are named"
fails "and nothing is written" test -e out.exr

# ---- outputs that cannot be written ----

refused() # NAME PATTERN OUTPUT
{
    local said

    # shellcheck disable=SC2086
    said=$("$PREFENV" bake env.hdr -o "$3" $quick 2>&1)
    is "$? $(wc -l <<<"$said")" "2 1" "$1: exit code 2, one line"
    like "$said" "$2" "$1: says so"
}

cp env.hdr keep.hdr
refused "the input itself" "env.hdr: is the input env.hdr itself" env.hdr
ln -s env.hdr link.hdr
refused "the input by another name" "link.hdr: is the input env.hdr itself" link.hdr
ok "the input is untouched" cmp env.hdr keep.hdr
refused "a folder" "folder: is a folder" folder
refused "a folder that is missing" "nowhere/x.exr: cannot write into nowhere: No such file" nowhere/x.exr
refused "a file as a folder" "env.hdr/x.exr: env.hdr is not a folder" env.hdr/x.exr
refused "no name" "the output's name is empty" ""
ln -s nowhere/x dangling.exr
# Before anything is read.
like "$("$PREFENV" bake missing.hdr -o dangling.exr 2>&1)" "bake: dangling.exr: is a link to nothing; remove it" \
    "a link to nothing: says so"
weights() # NAME PATTERN FILE
{
    like "$("$PREFENV" bake missing.hdr -o x.exr --method voxels --weights "$3" 2>&1)" "$2" "--weights $1: says so"
}
weights "in a folder that is missing" "bake: nowhere/w.bin: cannot write into nowhere" nowhere/w.bin
weights "as a link to nothing" "bake: dangling.exr: is a link to nothing" dangling.exr
weights "of the maps file's name" "bake: x.exr: is the maps file and that of --weights" x.exr
weights "of the maps file's name, written otherwise" "bake: x.exr: is the maps file and that of --weights" ./x.exr
weights "of the maps file's name, out of a folder" "bake: x.exr: is the maps file and that of --weights" folder/../x.exr
flat_hdr 4 2 >x1.hdr
like "$("$PREFENV" bake 'x%d.hdr' --frames 1 -o 'x%d.exr' --method voxels --weights ./x1.exr 2>&1)" \
    "bake: x1.exr: is the input ./x1.exr itself" "nor may a frame be the table of weights"
rm x1.hdr
touch there.exr
ln there.exr hard.exr
like "$("$PREFENV" bake missing.hdr -o hard.exr --method voxels --weights there.exr 2>&1)" \
    "bake: hard.exr: is the maps file and that of --weights" "nor both one file under two names"
rm there.exr hard.exr
weights "without a name" "bake: the name of --weights is empty" ""
rm dangling.exr
refused "a PNG" "x.y.png: what is written is an OpenEXR; name it so, x.y.exr" x.y.png
refused "a TIFF" "x.TIFF: what is written is an OpenEXR; name it so, x.exr" x.TIFF
refused "a full device" "/dev/full: cannot write: No space left on device" /dev/full

mkdir short
# shellcheck disable=SC2086
said=$(ulimit -f 1 && "$PREFENV" bake env.exr -o short/s.exr --normals 42 --fast --quiet 2>&1)
is "$? $said" "2 prefenv: bake: short/s.exr: cannot write: File too large" "a file that may not grow"
is "$(ls -A short)" "" "and nothing is left of it"
if [ "$(id -u)" -ne 0 ]; then
    mkdir closed && chmod a-w closed
    refused "a folder closed to us" "closed/x.exr: cannot write into its folder" closed/x.exr
else
    skip "root may write everywhere" 2
fi
if [ "$(id -u)" -eq 0 ] && mkdir small && mount -t tmpfs -o size=8k tmpfs small 2>/dev/null; then
    trap 'umount "$work/small"; rm -rf "$work"' EXIT
    said=$("$PREFENV" bake env.hdr -o small/x.exr --paper 2>&1)
    is "$? $(wc -l <<<"$said")" "2 1" "a full disk: exit code 2, one line"
    is "$(ls small)" "" "a full disk: nothing is left on it"
else
    skip "only root can make a small disk" 2
fi

# ---- interruption ----

# Minutes on any machine, if nobody stopped it.
slow="--exact --normals 2562 --size 200x100 --threads 1"
flat_hdr 200 100 >large.hdr
ls >before
for signal in INT TERM HUP; do
    # shellcheck disable=SC2086
    timeout --preserve-status -s $signal 1 "$PREFENV" bake large.hdr -o stopped.exr $slow >said 2>&1
    status=$?
    rm -f said
    is "$status" "$((128 + $(kill -l $signal)))" "SIG$signal ends the bake by its convention"
    is "$(ls | grep -v '^before$')" "$(grep -v '^before$' before)" "and leaves nothing behind"
done
# Of one colour, so that it is clustered and filtered in no time; what takes long is the estimate of the error, which
# sums over all texels.  Half the time of a bake is in the middle of that.
oiiotool --pattern constant:color=1,1,1 1600x800 3 -d half -o vast.exr || bail_out "oiiotool does not work"
estimated="--fast --normals 12 --size 16x8 --alpha 0.3 --threads 1 --quiet"
begun=$(date +%s%N)
# shellcheck disable=SC2086
ok "a bake whose time goes into the estimate" "$PREFENV" bake vast.exr -o stopped.exr $estimated
half=$((($(date +%s%N) - begun) / 2000000))
rm -f stopped.exr
ls >before
# Sooner, if the machine has less to do by now than it had then, and the bake is through before the signal.
for half in $half $((half / 2)) $((half / 4)); do
    rm -f stopped.exr
    # shellcheck disable=SC2086
    timeout --preserve-status -s TERM "$(printf '%d.%03d' $((half / 1000)) $((half % 1000)))" \
        "$PREFENV" bake vast.exr -o stopped.exr $estimated
    status=$?
    [ $status = 0 ] || break
done
is "$status $(ls | grep -v '^before$')" "143 $(grep -v '^before$' before)" \
    "a signal while the error is estimated ends the bake and leaves nothing behind"

# A pipe that nobody writes to, or reads from.
mkfifo silent
for signal in INT TERM; do
    # shellcheck disable=SC2086
    timeout --preserve-status -k 9 -s $signal 0.5 "$PREFENV" bake silent -o stopped.exr $quick
    is "$?" "$((128 + $(kill -l $signal)))" "SIG$signal while the pipe of ENV is opened"
    # shellcheck disable=SC2086
    timeout --preserve-status -k 9 -s $signal 0.5 "$PREFENV" bake silent -o stopped.exr $quick 9<>silent
    is "$?" "$((128 + $(kill -l $signal)))" "SIG$signal while ENV is read from a pipe"
    # shellcheck disable=SC2086
    timeout --preserve-status -k 9 -s $signal 2 "$PREFENV" bake env.hdr -o silent $quick
    is "$?" "$((128 + $(kill -l $signal)))" "SIG$signal while the pipe of MAPS is opened"
done
rm silent

# shellcheck disable=SC2086
timeout 2 sh -c 'trap "" HUP; "$0" "$@" & child=$!; sleep 0.5; kill -HUP $child; sleep 0.5; kill -0 $child; s=$?
                 kill -TERM $child; exit $s' "$PREFENV" bake large.hdr -o stopped.exr $slow 2>/dev/null
is $? 0 "a signal that the caller ignores, as nohup does, stays ignored"

# ---- progress ----

# shellcheck disable=SC2086
timeout -s TERM 1 "$PREFENV" bake large.hdr -o stopped.exr $slow 2>said
is "$(cat said)" "" "no bar if standard error is a file"
if script -qec true /dev/null >/dev/null 2>&1 </dev/null; then
    bake="timeout -s TERM 2 '$PREFENV' bake large.hdr -o stopped.exr $slow"
    drawn=$(TERM=xterm script -qec "$bake" /dev/null </dev/null | tr '\r' '\n')
    like "$drawn" "^ +[0-9]+ % \[#* *\] [0-9]+ (s|min [0-9]+ s) left" \
        "a bar with the time left on a terminal"
    is "$(TERM=xterm script -qec "$bake --quiet" /dev/null </dev/null)" "" "none with --quiet"
    is "$(TERM=dumb script -qec "$bake" /dev/null </dev/null)" "" "none on a dumb terminal"
else
    skip "script(1) cannot make a terminal here" 3
fi

# ---- many roughnesses ----

like "$("$PREFENV" bake env.exr -o voxels.exr --method voxels --size 16 --weights table.bin 2>&1)" \
    '^voxels.exr: 16\^3 voxels, ' "voxels: the summary"
like "$("$PREFENV" info voxels.exr)" '^threshold  0.001, what is left out is made up for$' "voxels: info"
cp table.bin kept.bin
is "$("$PREFENV" bake env.exr -o again.exr --method voxels --size 16 --weights table.bin --quiet; echo $?)" 0 \
    "voxels: a table that is there is read"
is "$(cmp voxels.exr again.exr && cmp table.bin kept.bin && echo same)" same "and gives the same, itself as it was"
like "$("$PREFENV" bake env.exr -o no.exr --method voxels --size 32 --weights table.bin 2>&1)" \
    'table.bin: weights for size 16, not the 32 asked for; name another file' "a table of another size is refused"
like "$("$PREFENV" bake env.exr -o no.exr --method voxels --size 16 --threshold 0.1 --weights table.bin 2>&1)" \
    'table.bin: weights of threshold 0.001, not the 0.1 asked for' "and of another threshold"
like "$("$PREFENV" bake env.exr -o no.exr --method voxels --size 16 --weights env.exr 2>&1)" \
    'env.exr: is not a file of weights' "and what is none"
like "$("$PREFENV" bake env.exr -o table.bin --method voxels --size 16 --weights table.bin 2>&1)" \
    'table.bin: is the maps file and that of --weights' "a table is not written over by voxels"
"$PREFENV" bake env.exr -o dark.exr --method voxels --size 16 --threshold 0.1 --no-renormalise --quiet
like "$("$PREFENV" info dark.exr)" '^threshold  0.1, what is left out is missing$' "--no-renormalise"
"$PREFENV" bake env.exr -o exact.exr --method voxels --size 16 --exact --quiet
like "$("$PREFENV" info --json exact.exr | jq -c '[.accuracy, .threshold, .size, .window, .levels, .images]')" \
    '^\["exact",0,16,6.2,256,16\]$' "voxels --exact, in JSON"
like "$("$PREFENV" bake env.exr -o layers.exr --method layers --size 16 --window 3 2>&1)" \
    '^layers.exr: [0-9]+ layers of up to [0-9]+x[0-9]+, ' "layers: the summary"
for option in "--alpha 0.1" "--normals 42" "--angles 8" "--weight microfacet" "--material gold"; do
    # shellcheck disable=SC2086 # words
    like "$("$PREFENV" bake env.exr -o no.exr --method layers $option 2>&1)" \
        "${option%% *} does not go with --method layers and voxels" "layers: $option is refused"
done
like "$("$PREFENV" bake env.exr -o grades.exr --method layers --ndf beckmann --normals 12 --size 12x12 2>&1)" \
    'grades' "layers of --ndf beckmann are grades"
like "$("$PREFENV" bake env.exr -o no.exr --method voxels --error 0.01 2>&1)" \
    '--error does not go with --method voxels' "voxels: --error is refused"
like "$("$PREFENV" bake env.exr -o fine.exr --method layers --error 0.0005 2>&1 | grep warning)" \
    'the error of lookups is [0-9.e-]+ %, not the 0.05 % asked for; finer layers were no better|^$' "layers: --error"
like "$("$PREFENV" bake env.exr -o no.exr --threshold 0.1 2>&1)" '--threshold is for --method voxels' \
    "--threshold alone"
like "$("$PREFENV" bake env.exr -o no.exr --method layers --size 64x32 2>&1)" 'of layers and voxels it is one number' \
    "layers: two numbers for --size"
is "$(ls no.exr 2>/dev/null)" "" "nothing is written where something is refused"

done_testing
