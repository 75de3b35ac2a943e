# patches2mesh.awk - bicubic Bezier patches, written as in teapot.patches, as a POV-Ray mesh2 with the surface's own
# normals, u and v.
#
#   awk -f patches2mesh.awk teapot.patches >teapot_mesh.inc         declares Teapot
#   awk -v name=Pot -v steps=8 -f patches2mesh.awk teapot.patches   declares Pot, each patch of 8 by 8 quadrilaterals
#
# The points are right-handed with z up, POV-Ray's frame is left-handed with y up: y and z change places, and the object
# is seen as it was meant.  Patches of which each starts where the one before it ends are one strip: u grows along it,
# from 0 to 1, and v across it, so that on a pot u goes around.
#
# Where an edge of a patch is a single point its normal is that of a place just beside it.

BEGIN {
    if (name == "") name = "Teapot"
    if (steps == "") steps = 20
    points = patches = 0
}

/^#/ || NF == 0 { next }

$1 == "patch" && NF == 17 {
    for (i = 0; i < 16; i++) patch[patches, i] = $(i + 2)
    patches++
    next
}

$1 == "point" && NF == 4 {
    for (i = 0; i < 3; i++) point[points, i] = $(i + 2)
    points++
    next
}

{
    complain("line " NR ": 'patch' with 16 points or 'point' with 3 coordinates was expected, but found: " $0)
}

function complain(words)
{
    print FILENAME ": " words >"/dev/stderr"
    failed = 1
    exit 1
}

# Does patch p start where the one before it ends?
function goes_on(p,    row)
{
    for (row = 0; row < 4; row++)
        if (patch[p, 4 * row] != patch[p - 1, 4 * row + 3]) return 0
    return 1
}

# Bernstein's polynomials of degree 3 at t into b, their derivatives into d.
function bernstein(t, b, d,    r)
{
    r = 1 - t
    b[0] = r * r * r; b[1] = 3 * r * r * t; b[2] = 3 * r * t * t; b[3] = t * t * t
    d[0] = -3 * r * r; d[1] = 3 * r * r - 6 * r * t; d[2] = 6 * r * t - 3 * t * t; d[3] = 3 * t * t
}

# The point of patch p at (s, t) into at, the unit normal there into normal; the length of it before.
function evaluate(p, s, t,    i, j, k, c, bs, ds, bt, dt, along, across, length_n)
{
    bernstein(s, bs, ds)
    bernstein(t, bt, dt)
    for (k = 0; k < 3; k++) {
        at[k] = across[k] = along[k] = 0
        for (i = 0; i < 4; i++)
            for (j = 0; j < 4; j++) {
                c = point[patch[p, 4 * i + j], k]
                at[k] += bs[i] * bt[j] * c
                across[k] += ds[i] * bt[j] * c
                along[k] += bs[i] * dt[j] * c
            }
    }
    for (k = 0; k < 3; k++)
        normal[k] = along[(k + 1) % 3] * across[(k + 2) % 3] - along[(k + 2) % 3] * across[(k + 1) % 3]
    length_n = sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2])
    for (k = 0; k < 3 && length_n > 0; k++) normal[k] /= length_n
    return length_n
}

function vector(v)
{
    return sprintf(",<%.7g,%.7g,%.7g>\n", v[0], v[2], v[1])
}

function vertex(p, s, t,    where, beside)
{
    if (evaluate(p, s, t) < 1e-6) {
        where = vector(at)
        beside = 1e-4
        evaluate(p, s + beside * (1 - 2 * s), t + beside * (1 - 2 * t))
    } else
        where = vector(at)
    vectors[vertices] = where
    normals[vertices] = vector(normal)
    vertices++
}

# Two corners at one place leave no triangle.
function triangle(a, b, c)
{
    if (vectors[a] == vectors[b] || vectors[b] == vectors[c] || vectors[c] == vectors[a]) return
    faces[triangles++] = sprintf(",<%d,%d,%d>\n", a, b, c)
}

function mesh_of(p, place, strip,    i, j, first)
{
    first = vertices
    for (i = 0; i <= steps; i++)
        for (j = 0; j <= steps; j++) {
            uvs[vertices] = sprintf(",<%.7g,%.7g>\n", (place + j / steps) / strip, i / steps)
            vertex(p, i / steps, j / steps)
        }
    for (i = 0; i < steps; i++)
        for (j = 0; j < steps; j++) {
            a = first + i * (steps + 1) + j
            triangle(a, a + 1, a + steps + 2)
            triangle(a, a + steps + 2, a + steps + 1)
        }
}

function list(words, entries, count,    i)
{
    print words " { " count
    for (i = 0; i < count; i++) printf "%s", entries[i]
    print "}"
}

END {
    if (failed) exit 1
    for (p = 0; p < patches; p++)
        for (i = 0; i < 16; i++)
            if (patch[p, i] !~ /^[0-9]+$/ || patch[p, i] + 0 >= points)
                complain("patch " p " has the point " patch[p, i] ", but there are " points)
    if (patches == 0) complain("no patches in it")
    if (steps !~ /^[0-9]+$/ || steps < 1 || steps > 200) complain("steps must lie between 1 and 200, but is " steps)
    vertices = triangles = 0
    for (p = 0; p < patches; p = end) {
        for (end = p + 1; end < patches && goes_on(end);) end++
        for (i = p; i < end; i++) mesh_of(i, i - p, end - p)
    }
    print "// " name ": " patches " patches, " triangles " triangles; written by patches2mesh.awk"
    print "#declare " name " = mesh2 {"
    list("vertex_vectors", vectors, vertices)
    list("normal_vectors", normals, vertices)
    list("uv_vectors", uvs, vertices)
    list("face_indices", faces, triangles)
    print "}"
}
