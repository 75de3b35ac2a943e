#!/bin/bash
# The patches: each has its header, and the series applies to POV-Ray's source without fuzz.

. "$srcdir/tests/tap.sh"

patches=$srcdir/patches
work=$(mktemp -d) || bail_out 'mktemp -d failed'
trap 'rm -rf "$work"' EXIT

series=$(sed -e 's/#.*//' -e '/^[[:space:]]*$/d' "$patches/series")
is "$(cd "$patches" && printf '%s\n' *.patch)" "$series" 'series names every patch, in the order of their numbers'

for patch in $series; do
    head=$(sed '/^---$/q' "$patches/$patch")
    wrong=
    grep -Eq '^[0-9]{4}-[a-z0-9-]+\.patch$' <<<"$patch" || wrong+=' its name is not NNNN-what-it-does.patch;'
    grep -Eq '^Subject: [a-z.]+: [a-z]' <<<"$head" || wrong+=' no "Subject: room: imperative";'
    grep -Eq '^Upstream: .+' <<<"$head" || wrong+=' no "Upstream:";'
    grep -Eq '^Signed-off-by: .+ <.+>$' <<<"$head" || wrong+=' no "Signed-off-by:";'
    [ "$(grep -Evc '^(Subject|Upstream|Signed-off-by):|^---$|^$' <<<"$head")" -ge 3 ] || wrong+=' no reason given;'
    ! grep -q '.\{121\}' <<<"$head" || wrong+=' a line of the header is longer than 120;'
    ! grep -Eq '^diff --git .*\.(orig|rej|bak)$|^diff --git .*~$' "$patches/$patch" ||
        wrong+=' it has a backup file in it;'
    is "$wrong" '' "$patch has its header, and no more than it needs"
done

source=${POVRAY_SOURCE:-${PREFENV_CACHE:-${XDG_CACHE_HOME:-$HOME/.cache}/prefenv}/source/povray_3.7.0.10.orig.tar.gz}
if [ ! -e "$source" ]; then
    skip "$source does not exist" "$(wc -w <<<"$series")"
    done_testing
    exit
fi

# Only the files that are patched, and not those that a patch makes for a later one to change.
files=$(cd "$patches" && comm -23 <(sed -n 's,^--- a/,,p' $series | sort -u) \
    <(sed -n '/^--- .dev.null$/ { n; s,^+++ b/,,p }' $series | sort -u))
if [ -d "$source" ]; then
    (cd "$source" && tar -cf - $files) | tar -C "$work" -xf -
else
    top=$(tar -tzf "$source" 2>/dev/null | head -n 1)
    # shellcheck disable=SC2086 # a list of names
    printf "${top%%/*}/%s\n" $files | tar -C "$work" --strip-components=1 -xzf "$source" -T - ||
        bail_out "$source cannot be unpacked"
fi

cd "$work" || exit
for patch in $series; do
    said=$(patch -p1 --fuzz=0 --batch <"$patches/$patch" 2>&1) && status=0 || status=$?
    is "$status$(grep -Ei 'fuzz|offset|reversed|fail' <<<"$said")" 0 "$patch applies where it says" || note "$said"
done

done_testing
