#!/bin/bash
# bootstrap: what configure was told, now or when the tree was configured, says whether POV-Ray's packages are wanted.

. "$srcdir/tests/tap.sh"

work=$(mktemp -d) || bail_out 'mktemp -d failed'
trap 'rm -rf "$work"' EXIT
mkdir "$work/bin" "$work/tree" || bail_out 'mkdir failed'
cp "$srcdir/bootstrap" "$work/tree" || bail_out 'there is no bootstrap'
cd "$work/tree" || bail_out "$work/tree cannot be entered"

# A machine where nothing is installed, so that all that is wanted is named.
printf '#!/bin/sh\nexit 1\n' | tee ../bin/apt-get >../bin/dpkg-query
chmod +x ../bin/*
wants_povray() # BOOTSTRAP ARGUMENT...
{
    PATH=$work/bin:$PATH PREFENV_CACHE=$work/cache ./bootstrap --no-install "$@" | grep -Eq 'missing:.* libboost-dev '
}

# configured ARGUMENT...: a tree that configure made with these
configured()
{
    {
        printf '%s\n' '#!/bin/sh' "cat <<'END'"
        printf "'%s' " "$@"
        printf '\n%s\n' END
    } >config.status
    chmod +x config.status
    echo "PREFENV_CACHE = $work/cache" >Makefile
}

ok 'POV-Ray is wanted' wants_povray
ok '... with another prefix, too' wants_povray --prefix=/opt/p
for argument in --without-povray --with-povray=no --enable-sanitizer --enable-sanitizer=address; do
    rm -f config.status
    fails "not with $argument" wants_povray $argument
    configured --prefix=/opt/p "$argument"
    fails "... nor where the tree was configured so" wants_povray
done
rm -f config.status
ok 'but with --enable-sanitizer=no' wants_povray --enable-sanitizer=no
configured --enable-sanitizer=no
ok '... and where the tree was configured so' wants_povray
configured "--prefix=/opt/my own --without-povray"
ok 'the words of a folder are no choice' wants_povray

done_testing
