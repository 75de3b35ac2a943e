# cli-diff.sh - `prefenv diff` on pictures whose measures are computed by hand.

. "$srcdir/tests/tap.sh"

work=$(mktemp -d) && cd "$work" || bail_out "no folder to work in"
trap 'rm -rf "$work"' EXIT

# picture NAME COLOUR [OPTION...]: 4x4 texels of one colour; oiiotool's options change some of them.
picture()
{
    local name=$1 colour=$2 type=float

    shift 2
    [ "${name##*.}" = png ] && type=uint8
    oiiotool --pattern "constant:color=$colour" 4x4 "$(tr ',' '\n' <<<"$colour" | wc -l)" "$@" -d $type -o "$name" ||
        bail_out "oiiotool does not work"
}

# close NAME FILTER VALUE ARGUMENT...: what jq's filter picks from diff --json is VALUE, to six digits.
close()
{
    local name=$1 filter=$2 value=$3 got

    shift 3
    got=$("$PREFENV" diff --json "$@" | jq "$filter")
    ok "$name: $got is $value" awk -v got="$got" -v value="$value" \
        'BEGIN { d = got - value; exit !(got != "" && got != "null" && d * d <= 1e-12 * value * value) }'
}

# exits STATUS NAME ARGUMENT...
exits()
{
    local status=$1 name=$2

    shift 2
    "$PREFENV" diff "$@" >/dev/null 2>&1
    is $? "$status" "$name"
}

# ---- measures ----

# Four of 16 pixels differ by 1/4 in red.  N = 48 values, sum (a - b)^2 = 4/16, sum |b| = 15, sum b^2 = 6.5.
picture a.exr 0.5,0.25,0.125
picture b.exr 0.5,0.25,0.125 --fill:color=0.75,0.25,0.125 2x2+1+2
close "MSE" .mse 0.00520833333 a.exr b.exr
close "RMSE" .rmse 0.0721687836 a.exr b.exr
close "relative RMSE" .relative_rmse 0.230940108 a.exr b.exr
close "relative L2" .relative_l2 0.196116135 a.exr b.exr
close "PSNR" .psnr 22.8330123 a.exr b.exr
is "$("$PREFENV" diff --json a.exr b.exr | jq -c '[.pixels, .not_finite, .width, .height, .worst]')" \
    '[16,0,4,4,{"x":1,"y":2,"difference":0.25,"image":[0.5,0.25,0.125],"reference":[0.75,0.25,0.125]}]' \
    "the worst pixel is the first of them in reading order"

# 100 and 110 of 255 in red, in half of the pixels: 10 levels or 0, so mean 5 and variance 25.
picture a.png 0.392156863,0.5,0
picture b.png 0.392156863,0.5,0 --fill:color=0.431372549,0.5,0 4x2+0+0
close "mean of levels" '.level_mean[0]' 5 a.png b.png
close "variance of levels" '.level_variance[0]' 25 a.png b.png
is "$("$PREFENV" diff --json a.png b.png | jq -c '[.level_mean[1, 2], .level_variance[1, 2]]')" '[0,0,0,0]' \
    "channels that are equal"

# Levels are clipped as a display does: 2 and 8 look the same.
picture two.exr 2,2,2
picture eight.exr 8,8,8
is "$("$PREFENV" diff --json two.exr eight.exr | jq -c '[.mse, .level_mean]')" '[36,[0,0,0]]' "levels are clipped"

is "$("$PREFENV" diff --json a.exr a.exr | jq -c '[.mse, .relative_rmse, .relative_l2, .psnr]')" '[0,0,0,null]' \
    "equal pictures; an infinite PSNR is null"
picture black.exr 0,0,0
is "$("$PREFENV" diff --json black.exr black.exr | jq -c '[.relative_rmse, .relative_l2]')" '[0,0]' "black is black"
is "$("$PREFENV" diff --json a.exr black.exr | jq -c '[.relative_rmse, .relative_l2]')" '[null,null]' \
    "nothing is relative to black"

# A PNG is linear when it is compared: 188 of 255 in sRGB is 0.502886.
picture mid.png 0.737254902,0.737254902,0.737254902
picture mid.exr 0.50288645,0.50288645,0.50288645
ok "a PNG's values are made linear" "$PREFENV" diff mid.png mid.exr --fail-above 1e-6

text=$("$PREFENV" diff a.exr b.exr)
like "$text" '^relative RMSE  23.094 %$' "the text has the relative RMSE in percent"
like "$text" '^worst pixel    \(1, 2\) differs by 0.25: 0.5 0.25 0.125, reference 0.75 0.25 0.125$' \
    "and the worst pixel"
is "$("$PREFENV" diff -q a.exr b.exr 2>&1)" "" "--quiet is quiet"

# ---- masks ----

picture mask.png 0,0,0 --fill:color=1,1,1 2x2+1+2
close "a mask's luminance" .mse 0.0208333333 a.exr b.exr --mask mask.png
picture alpha.exr 0,0,0,0 --fill:color=0,0,0,1 2x2+1+2
close "a mask's alpha" .pixels 4 a.exr b.exr --mask alpha.exr
picture opaque.exr 0,0,0,1 --fill:color=1,1,1,1 2x1+1+2
close "an opaque mask's luminance" .pixels 2 a.exr b.exr --mask opaque.exr
exits 2 "a mask that keeps nothing" a.exr b.exr --mask black.exr
exits 2 "a mask that is missing" a.exr b.exr --mask missing.png

# ---- limits ----

exits 0 "no limit: any difference is fine" a.exr b.exr
exits 0 "below the limit" a.exr b.exr --fail-above 0.0722
exits 1 "above the limit" a.exr b.exr --fail-above 0.0721
exits 0 "below the relative limit" a.exr b.exr --fail-above-relative 0.231
exits 1 "above the relative limit" a.exr b.exr --fail-above-relative 0.230
exits 1 "anything is above a relative limit on black" a.exr black.exr --fail-above-relative 1000000
exits 0 "equal pictures pass a limit of 0" a.exr a.exr --fail-above 0 --fail-above-relative 0
is "$("$PREFENV" diff -q a.exr b.exr --fail-above 0.05 2>&1)" "prefenv: diff: the RMSE of 0.0721688 is above 0.05" \
    "one line says why"

# ---- pixels that are not finite ----

picture nan.exr 0.5,0.25,0.125 --fill:color=nan,0,0 1x1+1+2 --fill:color=0,0,inf 1x1+0+0
exits 1 "NaN and infinity fail without a limit" nan.exr a.exr
exits 1 "in the reference too" a.exr nan.exr
is "$("$PREFENV" diff --json nan.exr a.exr 2>/dev/null | jq -c '[.pixels, .not_finite, .mse]')" '[14,2,0]' \
    "they are counted and left out"
picture drop.png 1,1,1 --fill:color=0,0,0 1x1+1+2 --fill:color=0,0,0 1x1+0+0
exits 0 "a mask may drop them" nan.exr a.exr --mask drop.png
picture all-nan.exr nan,nan,nan
exits 1 "nothing but NaN" all-nan.exr a.exr
is "$("$PREFENV" diff --json all-nan.exr a.exr 2>/dev/null | jq -c '[.pixels, .not_finite, .mse]')" '[0,16,null]' \
    "has no measures"

# ---- the picture of differences ----

"$PREFENV" diff -q a.exr b.exr -o d.png --amplify 2
# |a - b| is 1/4 in red at four pixels, 1/2 after amplification: 188 of 255 in sRGB.
lit=$(oiiotool --dumpdata d.png | sed -n 's/.*Pixel (\(.*\)): \([0-9]* [0-9]* [0-9]*\) (.*/\1: \2/p' |
    grep -v ': 0 0 0')
is "$(tr '\n' '|' <<<"$lit")" "1, 2: 188 0 0|2, 2: 188 0 0|1, 3: 188 0 0|2, 3: 188 0 0|" "amplified, in sRGB"
"$PREFENV" diff -q nan.exr a.exr -o n.png 2>/dev/null
like "$(oiiotool --dumpdata n.png)" 'Pixel \(0, 0\): 255 0 255' "what is not finite is magenta"
exits 2 "the picture is a PNG" a.exr b.exr -o d.exr
exits 2 "the picture is not one of the inputs" a.png b.png -o a.png
exits 2 "its folder must be there" a.exr b.exr -o nowhere/d.png

# ---- bad input ----

oiiotool --pattern constant:color=0,0,0 4x5 3 -o tall.exr
is "$("$PREFENV" diff a.exr tall.exr 2>&1; echo "exit $?")" \
    "prefenv: diff: a.exr is 4x4, but tall.exr is 4x5; the sizes must be the same
exit 2" "sizes must be the same"
exits 2 "a mask of another size" a.exr b.exr --mask tall.exr
exits 2 "a picture that is missing" missing.exr a.exr
exits 2 "a reference that is missing" a.exr missing.exr
exits 2 "one picture alone" a.exr
is "$("$PREFENV" diff a.exr b.exr 2>&1 >/dev/full; echo "exit $?")" \
    "prefenv: diff: cannot write to standard output: No space left on device
exit 2" "a full disk is noticed"

done_testing
