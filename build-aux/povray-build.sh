#!/bin/bash
# povray-build.sh - build POV-Ray 3.7.0.10, patched or as it is, once, in a cache; then link it here.
#
#   povray-build.sh --source=DIR|TARBALL --cache=DIR --output=FILE --share=DIR
#                   [--patches=DIR --header=FILE LIBRARY...]
#
# The slow part, everything but the final link, is kept in the cache under a key: a hash of all that decides what comes
# out (source, patches, the header they include, compiler, flags, how it is built here).  A change in libprefenv alone
# only links again; a change in a comment of the header does not even count.  A build is made in a temporary folder and
# renamed when it is whole, under a lock, so that an interrupted one is never taken for good.
#
# In a key's folder: objects/, link (the flags of the link), include/, scenes/, ini/, doc/, build.log.
#
# With --patches, OUTPUT is linked with the libraries given, and SHARE/include gets POV-Ray's include files.  Without,
# it is the renderer as POV-Ray ships it, for comparison, and SHARE gets scenes/ too.
#
# Environment: CC, CXX (configure's); CCACHE=no does without ccache.

set -euo pipefail
export LC_ALL=C
unset MAKEFLAGS MFLAGS MAKELEVEL MAKEOVERRIDES CDPATH GREP_OPTIONS

keep=6 # built trees, of about 40 MB each

# No -march=native and no -ffast-math: a scene gives the same picture on every machine.
optimisation='-O3 -ffp-contract=off -w'

die()
{
    printf 'povray-build: %s\n' "$*" >&2
    exit 1
}

absolute()
{
    case $1 in
        /*) echo "$1" ;;
        *) echo "$PWD/$1" ;;
    esac
}

source= cache= patches= header= output= share=
while [ $# -gt 0 ]; do
    case $1 in
        --source=*) source=$(absolute "${1#*=}") ;;
        --cache=*) cache=$(absolute "${1#*=}") ;;
        --patches=*) patches=$(absolute "${1#*=}") ;;
        --header=*) header=$(absolute "${1#*=}") ;;
        --output=*) output=${1#*=} ;;
        --share=*) share=${1#*=} ;;
        --*) die "unknown option $1" ;;
        *) break ;;
    esac
    shift
done
[ -n "$source" ] && [ -n "$cache" ] && [ -n "$output" ] && [ -n "$share" ] ||
    die '--source, --cache, --output and --share are needed'
[ -e "$source" ] || die "$source does not exist: run ./bootstrap, or configure --with-povray-source=DIR|TARBALL"

CC=${CC:-gcc} CXX=${CXX:-g++}
compiler=$($CXX --version | head -n 1) || die "$CXX does not run"
[ "${CCACHE:-}" != no ] && command -v ccache >/dev/null && case $CXX in *ccache*) false ;; esac &&
    CC="ccache $CC" CXX="ccache $CXX"

# Not needed to build or to test; `libraries` holds old copies of libraries that the system has.
excluded=(--exclude=libraries --exclude=windows --exclude='.git*')

series()
{
    sed -e 's/#.*//' -e 's/[[:space:]]*$//' -e '/^$/d' "$patches/series"
}

# ---- the build ----

build_objects()
{
    local tree=$1/tree

    mkdir "$tree"
    if [ -d "$source" ]; then
        tar -C "$source" "${excluded[@]}" --exclude='*.[oa]' -cf - . | tar -C "$tree" -xf -
    else
        tar -C "$tree" "${excluded[@]}" --strip-components=1 -xf "$source"
    fi
    cd "$tree"
    [ -f unix/prebuild.sh ] || { echo "$source is not POV-Ray's source: it has no unix/prebuild.sh" && return 1; }
    ! [ -f Makefile ] || make distclean

    if [ -n "$patches" ]; then
        for patch in $(series); do
            echo "== $patch"
            patch -p1 --fuzz=0 --no-backup-if-mismatch --batch <"$patches/$patch"
        done
        mkdir prefenv
        cp "$header" prefenv/prefenv.h
    fi

    # All of POV-Ray is compiled one folder down, so the path is right everywhere; being relative, it suits ccache.
    (cd unix && ./prebuild.sh)
    ./configure CC="$CC" CXX="$CXX" CPPFLAGS="-I../prefenv" CFLAGS="$optimisation" CXXFLAGS="$optimisation" \
        --prefix=/usr --sysconfdir=/etc --without-x --without-libsdl --disable-optimiz --disable-strip \
        --disable-dependency-tracking --with-boost-thread=boost_thread COMPILED_BY=prefenv

    cat >unix/parts.mk <<'END'
include Makefile
parts: $(povray_OBJECTS)
	echo '$(povray_OBJECTS)' >parts
	echo '$(CXXFLAGS) $(LDFLAGS)' >flags
	echo '$(LIBS)' >libs
END
    make -j"$(nproc)" -C source
    make -j"$(nproc)" -C vfe
    make -j"$(nproc)" -C unix -f parts.mk parts

    mkdir "$1/objects"
    for part in $(cat unix/parts); do
        mv "unix/$part" "$1/objects/"
    done
    mv vfe/libvfe.a source/libpovray.a "$1/objects/"
    { cat unix/flags && cat unix/parts && echo libvfe.a libpovray.a && cat unix/libs; } >"$1/link"
    mkdir "$1/doc"
    mv include scenes ini "$1/"
    mv LICENSE AUTHORS "$1/doc/"
    cd "$1"
    rm -rf "$tree"
}

# ---- the key ----

if [ -d "$source" ]; then
    source_hash=$(cd "$source" && find . -type f ! -name '*.[oa]' ! -path './.git/*' ! -path './libraries*' -print0 |
        sort -z | xargs -0 sha256sum | sha256sum)
else
    source_hash=$(sha256sum <"$source")
fi

key=$({
    echo "$source_hash"
    declare -f build_objects series
    echo "$compiler $optimisation $(uname -m)"
    pkg-config --modversion OpenEXR libpng libtiff-4 2>&1 || true
    if [ -n "$patches" ]; then
        echo patched
        for patch in $(series); do
            [ -f "$patches/$patch" ] || die "patches/series names $patch, which does not exist"
            cat "$patches/$patch"
        done
        $CXX -fpreprocessed -dD -E -P -x c "$header" 2>/dev/null # the header without its comments
    fi
} | sha256sum | cut -c 1-20)

# ---- the cache ----

# How far the build is, on a terminal: POV-Ray has about 150 files to compile.
show_progress()
{
    local log=$1 count

    while sleep 1; do
        count=$(grep -c -- ' -c -o ' "$log" || true)
        printf '\r  POV-Ray: %d of about 150 files ' "$count" >&2
    done
}

build()
{
    local work=$cache/.tmp.$key log=$cache/$key.log what status=0 builder= watcher=

    rm -rf "$cache"/.tmp.* "$cache"/*.log # left by builds that failed or were killed: we hold the lock
    mkdir "$work"
    trap '[ -z "$watcher" ] || kill "$watcher" || true
        [ -z "$builder" ] || { kill -- -"$builder" && wait "$builder" || true; }
        rm -rf "$work"' EXIT
    trap 'exit 130' INT TERM HUP

    what='unpatched, for the tests'
    [ -z "$patches" ] || what="with Prefenv's $(series | wc -l) patches"
    printf '  POV-Ray 3.7.0.10, %s: building, once; about 5 minutes on two cores\n  log: %s\n' "$what" "$log" >&2
    : >"$log"
    if [ -t 2 ]; then
        show_progress "$log" &
        watcher=$!
    fi
    # In a shell of its own, for `set -e` is off wherever a status is looked at; in a process group of its own, so that
    # an interruption ends all of it.
    set -m
    (build_objects "$work") >"$log" 2>&1 </dev/null &
    set +m
    builder=$!
    wait "$builder" || status=$?
    builder=
    if [ -n "$watcher" ]; then
        kill "$watcher" && wait "$watcher" || true
        watcher=
        printf '\r\033[K' >&2
    fi
    if [ $status -ne 0 ]; then
        { echo "---- end of $log" && tail -n 25 "$log" && echo '----'; } >&2
        die "POV-Ray could not be built; the whole log is $log"
    fi
    mv "$log" "$work/build.log"
    mv "$work" "$cache/$key"
    trap - EXIT INT TERM HUP
}

mkdir -p "$cache"
exec 9>"$cache/.lock"
if ! flock -n 9; then
    echo '  POV-Ray: waiting for another build in the same cache' >&2
    flock 9
fi
[ -d "$cache/$key" ] || build
touch "$cache/$key"

# Old trees go; the newest stay.
ls -dt "$cache"/*/ | tail -n "+$((keep + 1))" | while read -r old; do
    rm -rf "$old"
done

# ---- the link ----

{
    read -r flags
    read -r parts
    read -r archives
    read -r libs
} <"$cache/$key/link"

objects=()
for part in $parts $archives; do
    objects+=("$cache/$key/objects/$part")
done
rm -f "$output.tmp"
# shellcheck disable=SC2086 # flags and libraries are lists of words
${CXX#ccache } $flags -o "$output.tmp" "${objects[@]}" "$@" $libs

rm -rf "$share"
mkdir -p "$share"
cp -R "$cache/$key/include" "$cache/$key/ini" "$cache/$key/doc" "$share/"
[ -n "$patches" ] || cp -R "$cache/$key/scenes" "$share/"
mv "$output.tmp" "$output"
