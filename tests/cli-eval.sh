# cli-eval.sh - `prefenv eval` and `prefenv exact`: lines in, lines out, in order, the same for any number of threads;
# what they say to bad lines; that they answer as lines arrive.

. "$srcdir/tests/tap.sh"

work=$(mktemp -d) && cd "$work" || bail_out "no folder to work in"
trap 'rm -rf "$work"' EXIT

# An environment whose radiance is (1, 1/2, 1/4) everywhere, and one where a single texel is lit above that.
oiiotool --pattern constant:color=1,0.5,0.25 32x16 3 -o flat.exr --fill:color=90,20,5 1x1+9+5 -o spot.exr ||
    bail_out "oiiotool does not work"
for env in flat.exr spot.exr; do
    "$PREFENV" bake $env -o "${env%.*}.pe.exr" --alpha 0.3 --paper --size 64x32 --float --quiet ||
        bail_out "bake does not work"
done

eval_of() # LINES [OPTION...]; what is printed to both streams, and the exit code
{
    local lines=$1

    shift
    printf '%b' "$lines" | "$PREFENV" eval flat.pe.exr "$@" 2>&1
    echo "exit $?"
}

# ---- answers ----

is "$(eval_of '0 0 1 0 1 1\n')" "1 0.5 0.25
exit 0" "a constant environment reflects itself"
is "$(eval_of '0 0 1 0 1 1')" "1 0.5 0.25
exit 0" "the last line needs no line feed"
is "$(eval_of '')" "exit 0" "no lines, no answers"
is "$(eval_of ' 0\t0  1\t0 1 1 \r\n\n  \n# a remark\n  # another\n0 1e0 0 0 +.1E+1 0.\n')" "1 0.5 0.25
1 0.5 0.25
exit 0" "blanks, tabs, carriage returns, remarks and all ways to write a number"
is "$(eval_of '0\v0\f1 0 1 1 \v\f\n\v\n')" "1 0.5 0.25
exit 0" "vertical tabs and form feeds are blanks, too"
is "$(eval_of '0 0 1e-200 0 1e300 1e300\n')" "1 0.5 0.25
exit 0" "vectors of any length"

# ---- bad lines ----

bad() # NAME LINE PATTERN; the line comes third, after a good one and a remark
{
    local said

    said=$(eval_of "0 0 1 0 1 1\\n# remark\\n$2\\n0 0 1 0 1 1\\n")
    is "$(head -n 1 <<<"$said") $(wc -l <<<"$said") $(tail -n 1 <<<"$said")" "1 0.5 0.25 3 exit 2" \
        "$1: the answer before it, one line of error, exit code 2"
    like "$said" "^prefenv: eval: line 3: $3" "$1: named"
}

bad "too few" "1 2 3" "3 values; six are wanted: nx ny nz ox oy oz"
bad "half a line and a vertical tab" '0 0 1 \v' "3 values; six are wanted"
bad "half a line and a form feed" '0 0 1 \f' "3 values; six are wanted"
bad "too many" "1 2 3 4 5 6 7" "7 values; six are wanted: nx ny nz ox oy oz, or nine, with the brush direction dx dy dz"
bad "no brush" "0 0 1 0 1 1 0 0 0" "the brush direction 0 0 0 has no direction"
bad "a brush that is a word" "0 0 1 0 1 1 1 0 along" 'dz is "along", which is not a number'
bad "a word" "0 0 north 0 1 1" 'nz is "north", which is not a number'
bad "a number with a tail" "0 0 1 0.5x 1 1" 'ox is "0.5x", which is not a number'
bad "commas" "0,0,1 0 1 1" 'nx is "0,0,1", which is not a number'
bad "NaN" "0 0 1 0 nan 1" 'oy is "nan", which is not finite'
bad "infinity" "0 0 1 0 1 -inf" 'oz is "-inf", which is not finite'
bad "too large" "1e999 0 1 0 1 1" 'nx is "1e999", which is not finite'
bad "no normal" "0 0 0 0 1 1" "the normal 0 0 0 has no direction"
bad "no viewer" "0 0 1 0 -0 0" "the direction to the viewer 0 0 0 has no direction"
bad "a long line" "0 0 1 0 1 $(printf '1%.0s' $(seq 2000))" "longer than 1024 bytes"
bad "a null byte" '0 0 1 0 1 1\00001' 'oz is "1", which is not a number'
is "$(head -c 5000000 /dev/zero | "$PREFENV" eval flat.pe.exr 2>&1)" "prefenv: eval: line 1: longer than 1024 bytes" \
    "a file of no lines is refused soon"

# ---- Phong's lobe ----

phong_of() # LINE [OPTION...]; the red of what it answers, or what it says
{
    local line=$1

    shift
    printf '%s\n' "$line" | "$PREFENV" exact spot.exr --phong "$@" 2>&1 | sed 's/^\([0-9.]*\) .*/\1/'
}

# The lit texel's centre is at u = 9.5/32, v = 5.5/16; n = o = r looks there.
lit="-0.2565 0.4714 0.8435 -0.2565 0.4714 0.8435"
holds() # EXPRESSION of awk; 1 or 0
{
    awk "BEGIN { print ($1) ? 1 : 0 }"
}
sharp=$(phong_of "$lit 1") blunt=$(phong_of "$lit 0.1") dull=$(phong_of "$lit 0")
is "$(holds "$sharp > $blunt && $blunt > $dull")" 1 "exact --phong: the smoother, the more of a spot"
is "$(phong_of "$lit 0.05")" "$(phong_of "$lit 0.1" --size 64)" "exact --phong: lambda means voxels"
floor="0 0 -1 0 1 -0.01"
dark=$(phong_of "$floor 0.02" --horizon dark) mean=$(phong_of "$floor 0.02" --horizon mean)
is "$(holds "$dark < 0.7 && $mean >= 1 && $(phong_of "$floor 0.02") >= 1")" 1 \
    "exact --phong --horizon: dark, mean, ignored"
like "$(phong_of "$lit 1" --alpha 0.3)" "exact: --alpha does not go with --phong" "exact --phong: another lobe"
like "$("$PREFENV" exact spot.exr --horizon dark </dev/null 2>&1)" "exact: --horizon is for --phong; give both" \
    "exact: --horizon of another lobe"
like "$(phong_of "0 0 1 0 1 1")" "6 values; seven are wanted: nx ny nz ox oy oz roughness, or ten, with" \
    "exact --phong: no roughness"
like "$(phong_of "0 0 1 0 1 1 rough")" 'roughness is "rough", which is not a number' "exact --phong: a word for it"
like "$(phong_of "0 0 1 0 1 1 1" --size 55)" "size 55 is not an even number from 8 to 256" "exact --phong: an odd size"

# ---- maps of many roughnesses ----

like "$("$PREFENV" eval spot.pe.exr --horizon dark </dev/null 2>&1)" "--horizon is for maps of the methods layers and" \
    "eval of other maps: --horizon is refused"

for method in layers voxels; do
    "$PREFENV" bake spot.exr -o $method.exr --method $method --size 32 --quiet || bail_out "bake --method $method"
    got=$(printf '%s 0.1\n' "$lit" | "$PREFENV" eval $method.exr)
    exact=$(printf '%s 0.1\n' "$lit" | "$PREFENV" exact spot.exr --phong --size 32)
    is "$(holds "(${got%% *} / ${exact%% *} - 1)^2 < 0.1")" 1 "eval of $method: ${got%% *} where ${exact%% *} is exact"
    got=$(echo "$floor 0.3" | "$PREFENV" eval $method.exr) dark=$(echo "$floor 0.3" |
        "$PREFENV" eval $method.exr --horizon dark)
    is "$(holds "0.5 < ${dark%% *} / ${got%% *} && ${dark%% *} / ${got%% *} < 0.6")" 1 \
        "eval of $method --horizon: half of the lobe is below a surface seen along it"
    like "$("$PREFENV" eval $method.exr --interpolation linear </dev/null 2>&1)" "--interpolation is between normals" \
        "eval of $method: --interpolation is refused"
    is "$(printf '0 0 1 0 1 1 2\n0 0 1 0 1 1 1\n' | "$PREFENV" eval $method.exr | uniq | wc -l)" 1 \
        "eval of $method: beyond 1 it is 1"
    like "$(echo '0 0 1 0 1 1' | "$PREFENV" eval $method.exr 2>&1)" "seven are wanted: nx ny nz ox oy oz roughness" \
        "eval of $method: no roughness"
done

# Any normal and viewer, and a roughness in the range: eval beside exact, by the root of their mean square.
awk 'BEGIN { srand(4); for (i = 0; i < 200; i++) { for (k = 0; k < 6; k++) printf "%.6f ", rand() - 0.5
    print 0.15 * 4 ^ rand() } }' >rough
for surface in "--ndf ggx" "--aspect 2 --weight microfacet --material gold"; do
    # shellcheck disable=SC2086 # words
    "$PREFENV" bake spot.exr -o grades.exr --alpha 0.15-0.6 $surface --quiet || bail_out "bake --alpha 0.15-0.6"
    # shellcheck disable=SC2086
    "$PREFENV" exact spot.exr --alpha 0.15-0.6 $surface <rough |
        paste -d ' ' - <("$PREFENV" eval grades.exr <rough) >both
    off=$(awk '{ e += ($1 - $4) ^ 2; n += $1 ^ 2 } END { print sqrt(e / n) }' both)
    is "$(wc -l <both) $(holds "$off < 0.1 && $off > 0")" "200 1" "eval of grades, $surface: exact within 10 %: $off"
done
is "$(printf '0 0 1 0 1 1 2\n0 0 1 0 1 1 0.6\n' | "$PREFENV" eval grades.exr | uniq | wc -l)" 1 \
    "eval of grades: beyond the range it is its end"
like "$(echo '0 0 1 0 1 1' | "$PREFENV" eval grades.exr 2>&1)" "seven are wanted: nx ny nz ox oy oz roughness" \
    "eval of grades: no roughness"
"$PREFENV" bake spot.exr -o layers.exr --method layers --alpha 0.15-0.6 --aspect 2 --weight microfacet --material gold \
    --quiet
ok "layers of a range are grades" cmp layers.exr grades.exr
is "$("$PREFENV" info --json grades.exr |
    jq -c '[.method, .alpha, .alpha_max, (.grades | length), .grades["0"].alpha]')" \
    '["grades",[0.15,0.075],0.6,'"$("$PREFENV" info grades.exr | grep -c ' normals, ')"',[0.15,0.075]]' \
    "info --json of grades"

for command in "eval flat.pe.exr" "exact flat.exr"; do
    # shellcheck disable=SC2086 # words
    like "$("$PREFENV" $command <. 2>&1; echo "exit $?")" "cannot read standard input: Is a directory" \
        "$command: a folder as input"
    # shellcheck disable=SC2086
    like "$("$PREFENV" $command <&- 2>&1; echo "exit $?")" "^exit 2$" "$command: no input at all"
    # shellcheck disable=SC2086
    is "$(echo 0 0 1 0 1 1 | "$PREFENV" $command 2>&1 >/dev/full; echo "exit $?")" \
        "prefenv: ${command%% *}: cannot write to standard output: No space left on device
exit 2" "$command: a full disk is noticed"
    # shellcheck disable=SC2086
    like "$(echo 0 0 1 0 1 1 | "$PREFENV" $command 2>&1 >&-; echo "exit $?")" "^exit 2$" "$command: no output at all"
done
like "$("$PREFENV" eval flat.exr 2>&1 </dev/null; echo "exit $?")" "^exit 2$" "an image is no maps file"
like "$("$PREFENV" exact missing.exr 2>&1 </dev/null; echo "exit $?")" "^exit 2$" "a missing environment"

# ---- order, threads, digits ----

# Normals and viewers spread by multiples of irrational numbers; awk prints 6 digits, enough to tell lines apart.
lines() # COUNT
{
    awk -v count="$1" 'BEGIN {
        for (i = 1; i <= count; i++)
            print sin(i * 1.7), cos(i * 2.3), sin(i * 3.1), cos(i * 0.7), sin(i * 1.9 + 1), cos(i * 4.3)
    }'
}

lines 20000 >lines
for interpolation in nearest weighted linear; do
    for threads in 1 2 3; do
        "$PREFENV" eval spot.pe.exr --interpolation $interpolation --threads $threads <lines >$interpolation.$threads
    done
    is "$(wc -l <$interpolation.1)" 20000 "$interpolation: an answer a line"
    ok "$interpolation: the same for 1 and 2 threads" cmp $interpolation.1 $interpolation.2
    ok "$interpolation: the same for 1 and 3 threads" cmp $interpolation.1 $interpolation.3
done
fails "nearest and linear differ" cmp -s nearest.1 linear.1
fails "weighted and linear differ" cmp -s weighted.1 linear.1
ok "linear is the default" sh -c '"$PREFENV" eval spot.pe.exr <lines | cmp - linear.1'
ok "the weights' default power is 50 for 42 normals" \
    sh -c '"$PREFENV" eval spot.pe.exr --interpolation weighted --exponent 50 <lines | cmp - weighted.1'
fails "another power gives another answer" \
    sh -c '"$PREFENV" eval spot.pe.exr --interpolation weighted --exponent 10 <lines | cmp -s - weighted.1'

# Each of some lines asked alone has the answer it had among the others: nothing is mixed up.
mixed=0
for line in 1 2 777 10240 19999 20000; do
    [ "$(sed -n ${line}p lines | "$PREFENV" eval spot.pe.exr)" = "$(sed -n ${line}p linear.1)" ] || mixed=$((mixed + 1))
done
is $mixed 0 "a line alone has the same answer as among others"
is "$(grep -Evc '^(-?[0-9]+(\.[0-9]+)?(e[-+][0-9]+)? ?){3}$' linear.1)" 0 "answers are three numbers"
ok "through a pipe of small pieces the same" \
    sh -c 'dd if=lines bs=7 status=none | "$PREFENV" eval spot.pe.exr | cmp - linear.1'
is "$(awk '{ for (i = 1; i <= 3; i++) if (sprintf("%.9g", $i) != $i) n++ } END { print n + 0 }' linear.1)" 0 \
    "digits are those of %.9g"

# ---- exact ----

is "$(printf '0 0 1 0 1 1\n0 1 0 0 1 0\n' | "$PREFENV" exact flat.exr --alpha 0.3)" "1 0.5 0.25
1 0.5 0.25" "exact: a constant environment reflects itself"
head -n 300 lines >few
for threads in 1 2 3; do
    "$PREFENV" exact spot.exr --alpha 0.3 --threads $threads <few >exact.$threads
done
ok "exact: the same for 1 and 2 threads" cmp exact.1 exact.2
ok "exact: the same for 1 and 3 threads" cmp exact.1 exact.3
fails "exact: the width matters" sh -c '"$PREFENV" exact spot.exr --alpha 0.2 <few | cmp -s - exact.1'
fails "exact: the brush direction matters" sh -c '"$PREFENV" exact spot.exr --alpha 0.3,0.1 <few >a
    "$PREFENV" exact spot.exr --alpha 0.3,0.1 --direction 1,0,0 <few | cmp -s - a'

# ---- answers arrive while the input is open ----

mkfifo questions
"$PREFENV" eval flat.pe.exr <questions >answers &
exec 3>questions
echo 0 0 1 0 1 1 >&3
for _ in $(seq 100); do
    [ -s answers ] && break
    sleep 0.1
done
is "$(cat answers)" "1 0.5 0.25" "an answer comes before the next question"
exec 3>&-
wait

mkfifo more
"$PREFENV" eval flat.pe.exr <more >/dev/null 2>said &
child=$!
exec 3>more
echo 0 0 nowhere 0 1 1 >&3
for _ in $(seq 100); do
    kill -0 $child 2>/dev/null || break
    sleep 0.1
done
is "$(kill -0 $child 2>/dev/null && echo waits || cat said)" \
    'prefenv: eval: line 1: nz is "nowhere", which is not a number' "a bad line ends it though the input is open"
exec 3>&-
wait

# ---- speed, for the log ----

for _ in $(seq 25); do cat lines; done >half
start=$(date +%s%N)
"$PREFENV" eval spot.pe.exr <half >/dev/null
note "500,000 lines in $((($(date +%s%N) - start) / 1000000)) ms"

# ---- interruption ----

mkfifo silent
for command in eval exact; do
    timeout --preserve-status -k 9 -s INT 0.5 "$PREFENV" $command silent 9<>silent </dev/null
    is "$?" 130 "$command: SIGINT while a pipe is read"
done

done_testing
