# cli-sequence.sh - `prefenv bake --frames`: the same files as one by one, what is left alone and what is made anew,
# shards, interruption, and every kind of bad pattern.

. "$srcdir/tests/tap.sh"

work=$(mktemp -d) && cd "$work" || bail_out "no folder to work in"
trap 'rm -rf "$work"' EXIT

# Eighteen frames: a ramp that turns.  The last but one is one whose error is estimated again.
for k in $(seq -w 8 25); do
    oiiotool --pattern fill:top=1,2,3:bottom=4,1,0.5 64x32 3 --cshift "+$k+0" --addc "0.$k" -d half -o "in_00$k.exr" ||
        bail_out "oiiotool does not work"
done

quick="--normals 42 --size 16x16 --alpha 0.3 --fast"

sequence() # ARGUMENT...: what the summary says of made and left
{
    # shellcheck disable=SC2086 # words
    "$PREFENV" bake 'in_%04d.exr' -o 'out_%04d.pe.exr' --json $quick "$@" | jq -c '[.frames, .made, .left]'
}

errors() # FILE
{
    "$PREFENV" info --json "$1" | jq -c '[.error_estimate, .lookup_error]'
}

# ---- as one by one ----

is "$(sequence --frames 8-25)" "[18,18,0]" "a sequence is made"
is "$(echo out_*.pe.exr | wc -w)" 18 "a file for each frame"
for k in 0008 0012 0024 0025; do
    # shellcheck disable=SC2086
    "$PREFENV" bake in_$k.exr -o alone_$k.exr --quiet $quick
    ok "frame $k is that of one baked alone, within 0.2 % of 3" \
        idiff -q -fail 0.006 -hardfail 0.01 alone_$k.exr out_$k.pe.exr
done
fails "frames differ" idiff -q -fail 0.006 out_0012.pe.exr out_0013.pe.exr
errors=$(errors out_0008.pe.exr)
is "$(errors out_0012.pe.exr)" "$errors" "between estimates, that of the first frame is recorded"

# Forty even frames, of no error to speak of, and one that is not.
mkdir even
oiiotool --pattern constant:color=1,2,3 64x32 3 -d half -o even/1.exr
for k in $(seq 2 40); do
    ln -s 1.exr even/$k.exr
done
cp in_0008.exr even/41.exr
# shellcheck disable=SC2086
"$PREFENV" bake even/%d.exr -o even/%d.pe.exr --quiet $quick --frames 1-41
is "$(errors even/40.pe.exr)" "$(errors even/1.pe.exr)" "forty frames record the errors of the first"
is "$(errors even/41.pe.exr)" "$errors" "the next is looked at itself"

# In other company, with other places in the lanes; two numbers of eight bytes each are the errors.
"$PREFENV" bake 'in_%04d.exr' -o 'other_%04d.pe.exr' --quiet $quick --frames 8-25 --shard 2/3
for k in 0009 0012 0024; do
    differing=$(cmp -l other_$k.pe.exr out_$k.pe.exr | wc -l)
    ok "frame $k of a shard has all bytes but those of its errors" test "$differing" -le 16
    is "$(stat -c %s other_$k.pe.exr)" "$(stat -c %s out_$k.pe.exr)" "and its size"
done

mkdir one
for k in 0008 0024; do
    cp in_$k.exr one/in_$k.exr
done
"$PREFENV" bake 'one/in_%04d.exr' -o 'one/%%_%d.exr' --quiet --paper --size 16x8 --frames 8
"$PREFENV" bake one/in_0008.exr -o one/alone.exr --quiet --paper --size 16x8
ok "a single number, %d and %%, lat-long maps, which are exact here" cmp one/alone.exr one/%_8.exr

# ---- what is left alone ----

cp -p out_0010.pe.exr kept
is "$(sequence --frames 8-25)" "[18,0,18]" "what is there is left alone"
rm out_0010.pe.exr
is "$(sequence --frames 8-25)" "[18,1,17]" "what is missing is made"
is "$(sequence --frames 8-12 --force)" "[5,5,0]" "--force makes all anew"
until [ in_0011.exr -nt out_0011.pe.exr ]; do touch in_0011.exr; done # the file system's clock ticks slowly
is "$(sequence --frames 8-25)" "[18,1,17]" "so is the output of a newer source"
head -c 9000 out_0012.pe.exr >short && mv short out_0012.pe.exr
is "$(sequence --frames 8-25)" "[18,1,17]" "and what is not whole"
echo text >out_0013.pe.exr
cp alone_0008.exr out_0014.pe.exr
is "$(sequence --frames 8-25)" "[18,2,16]" "and what is something else, or of another source"
for change in "--alpha 0.31" "--alpha 0.3,0.2" "--ndf ggx" "--weight microfacet" "--direction 1,0,0" "--error 0.05" \
    "--normals 12" "--size 16x18" "--angles 4" "--quality high" "--method representative"; do
    cp alone_0008.exr out_0008.pe.exr
    # shellcheck disable=SC2086
    is "$(sequence --frames 8 $change)" "[1,1,0]" "and what was made without $change"
done
# shellcheck disable=SC2086
like "$("$PREFENV" bake 'in_%04d.exr' -o 'out_%04d.pe.exr' $quick --frames 8-9 2>&1)" \
    '^out_%04d.pe.exr: 1 of 2 frames made, 1 left as they were, in [0-9.]+ s; 42 maps of 16x16 each, fast, .* %$' \
    "a line sums up"

# ---- shards ----

rm -f out_*
is "$(sequence --frames 8-14 --shard 2/3)" "[2,2,0]" "a shard is every N-th frame"
is "$(echo out_*)" "out_0009.pe.exr out_0012.pe.exr" "from the I-th on"
is "$(sequence --frames 8-14 --shard 1/3) $(sequence --frames 8-14 --shard 3/3)" "[3,3,0] [2,2,0]" "the others"
is "$(sequence --frames 8-14)" "[7,0,7]" "all together are the sequence"
is "$(sequence --frames 8-9 --shard 3/3)" "[0,0,0]" "a shard may be empty"
mv in_0011.exr away
is "$(sequence --frames 8-14 --shard 2/3)" "[2,0,2]" "only a shard's own frames are asked for"
mv away in_0011.exr

# ---- bad input ----

refused() # NAME PATTERN ARGUMENT...
{
    local name=$1 pattern=$2 said

    shift 2
    rm -f x_*
    # shellcheck disable=SC2086
    said=$("$PREFENV" bake "$@" $quick 2>&1)
    is "$? $(wc -l <<<"$said")" "2 1" "$name: exit code 2, one line"
    like "$said" "$pattern" "$name: says so"
    is "$(echo x_*)" 'x_*' "$name: nothing is written"
}

in=in_%04d.exr out=x_%d.exr
refused "no place in ENV" "in.exr: has no place for the frame's number" in.exr -o $out --frames 8-9
refused "no place in MAPS" "x_.exr: has no place for the frame's number" $in -o x_.exr --frames 8-9
refused "%% is no place" "x_%%.exr: has no place" $in -o x_%%.exr --frames 8-9
refused "two places" "has more than one place for the frame's number" $in -o x_%d_%d.exr --frames 8-9
for conversion in s x 4d -4d 0d 010d n .3d ld '*d' 04 ''; do
    refused "%$conversion" "x_%.*: '%.*' does not stand for a frame's number" $in -o "x_%$conversion" --frames 8-9
done
for range in '' 9-8 8- -8 a-b 8-9-10 ' 8-9' 8,9 1-12345678901; do
    refused "--frames '$range'" "--frames '.*' is not FIRST-LAST" $in -o $out --frames="$range"
done
for shard in '' 0/2 3/2 1 1/ /2 1/2/3 a/b; do
    refused "--shard '$shard'" "--shard '.*' is not I/N" $in -o $out --frames 8-9 --shard="$shard"
done
refused "--shard alone" "--shard is for sequences; give --frames, too" in_0008.exr -o x_1.exr --shard 1/2
refused "a pattern without --frames" "in_%04d.exr: no such file; give --frames FIRST-LAST if it is a sequence" \
    in_%04d.exr -o x_%04d.exr
refused "--force alone" "--force is for sequences; give --frames, too" in_0008.exr -o x_1.exr --force
refused "a missing frame" "in_0026.exr: No such file or directory; --frames 8-30 needs it" $in -o $out --frames 8-30
refused "its own input" "in_0008.exr: is the input in_0008.exr itself" $in -o $in --frames 8-9
mkdir links
ln -s ../in_0008.exr links/8.exr
ln -s ../in_0009.exr links/9.exr
ln -s ../in_0009.exr links/x_8.exr
refused "the input of a later frame" \
    "links/x_8.exr, the output of frame 8, is links/9.exr, the input of frame 9; give other names after -o" \
    links/%d.exr -o links/x_%d.exr --frames 8-9
refused "of another machine's share" "links/x_8.exr, the output of frame 8, is links/9.exr" \
    links/%d.exr -o links/x_%d.exr --frames 8-9 --shard 1/2
refused "a folder that is not there" "nowhere/x_8.exr: cannot write into nowhere" $in -o nowhere/$out --frames 8-9

oiiotool in_0010.exr --resize 32x16 -o other.exr && mv other.exr in_0010.exr
rm -f x_*
# shellcheck disable=SC2086
said=$("$PREFENV" bake $in -o $out --frames 8-11 $quick 2>&1)
is "$? $said" "2 prefenv: bake: in_0010.exr: has 32 x 16 texels where 64 x 32 are expected, as the first has" \
    "a frame of another size"
is "$(echo x_*)" "x_8.exr x_9.exr" "what came before it is there"

# ---- interruption and progress ----

# About a second a frame, and thousands of frames.
slow="--exact --normals 42 --size 40x40 --threads 1"
mkdir many
for k in $(seq 400); do
    ln -s ../in_0008.exr "many/$k.exr"
done
# shellcheck disable=SC2086
timeout --preserve-status -s INT 4 "$PREFENV" bake many/%d.exr -o many/%d.pe.exr --frames 1-400 --quiet $slow
is "$?" 130 "SIGINT ends a sequence"
made=$(find many -name '*.pe.exr' | wc -l)
note "$made frames were made"
ok "frames that were made stay, others are not there" test "$made" -ge 1 -a "$made" -lt 400
whole=1
for file in many/*.pe.exr; do
    "$PREFENV" info "$file" >/dev/null || whole=0
done
is "$whole $(find many -name '.*' -type f)" "1 " "each is whole, and nothing else is left"
# As under nohup: what is ignored is pending all the same while signals wait, as they do once files are being written.
(
    trap '' HUP
    exec "$PREFENV" bake many/%d.exr -o many/ignored_%d.exr --frames 1-30 --quiet --exact --normals 42 --size 30x30
) &
pid=$!
until [ -e many/ignored_1.exr ] || ! kill -0 $pid 2>/dev/null; do sleep 0.01; done
sent=0
while kill -HUP $pid 2>/dev/null; do
    sent=$((sent + 1))
    sleep 0.01
done
wait $pid
is "$? $(find many -name 'ignored_*.exr' | wc -l)" "0 30" "a signal that is ignored ends nothing"
ok "... and it was there while frames were made" test $sent -ge 5
if script -qec true /dev/null >/dev/null 2>&1 </dev/null; then
    bake="timeout -s TERM 4 '$PREFENV' bake many/%d.exr -o many/%d.pe.exr --force --frames 1-400 $slow"
    drawn=$(TERM=xterm script -qec "$bake" /dev/null </dev/null | tr '\r' '\n')
    like "$drawn" "^ +[0-9]+ % \[#* *\] [0-9]+ (s|min [0-9]+ s) left" "one bar for the whole sequence on a terminal"
else
    skip "script(1) cannot make a terminal here"
fi

done_testing
