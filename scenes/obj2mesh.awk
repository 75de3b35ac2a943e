# obj2mesh.awk - a Wavefront OBJ of vertices and polygons as a POV-Ray mesh2 with smooth normals.
#
#   awk -f obj2mesh.awk bunny.obj >bunny.inc       declares Bunny
#   awk -v name=Teapot -f obj2mesh.awk teapot.obj  declares Teapot
#
# A vertex's normal is the mean of its triangles' normals, each weighted by the angle it spans at the vertex: long thin
# triangles beside it then count no more than they should. [Thuermer and Wuethrich 1998]
#
# OBJ files are right-handed and POV-Ray's frame is left-handed, so z changes its sign: the object is seen as it was
# meant, not as in a mirror.  The order of a triangle's corners is turned round with it.

BEGIN {
    if (name == "") name = "Bunny"
    vertices = triangles = 0
}

$1 == "v" {
    vertices++
    x[vertices] = $2 + 0
    y[vertices] = $3 + 0
    z[vertices] = -$4
    nx[vertices] = ny[vertices] = nz[vertices] = 0
}

$1 == "f" {
    for (i = 2; i <= NF; i++) {
        corner = $i
        sub(/\/.*/, "", corner)
        corner += 0
        if (corner < 0) corner += vertices + 1
        if (corner < 1 || corner > vertices) {
            print FILENAME ": line " NR ": there is no vertex " $i >"/dev/stderr"
            failed = 1
            exit 1
        }
        polygon[i - 1] = corner
    }
    for (i = 2; i < NF - 1; i++) triangle(polygon[1], polygon[i + 1], polygon[i])
}

function triangle(a, b, c,    ax, ay, az, bx, by, bz, length_n, px, py, pz)
{
    ax = x[b] - x[a]; ay = y[b] - y[a]; az = z[b] - z[a]
    bx = x[c] - x[a]; by = y[c] - y[a]; bz = z[c] - z[a]
    px = ay * bz - az * by; py = az * bx - ax * bz; pz = ax * by - ay * bx # outwards, the order having been turned
    length_n = sqrt(px * px + py * py + pz * pz)
    if (length_n == 0) return # no area: nothing to see
    px /= length_n; py /= length_n; pz /= length_n
    corners[triangles * 3] = a
    corners[triangles * 3 + 1] = b
    corners[triangles * 3 + 2] = c
    triangles++
    add(a, b, c, px, py, pz)
    add(b, c, a, px, py, pz)
    add(c, a, b, px, py, pz)
}

# The triangle's normal, into the normal of its corner a.
function add(a, b, c, px, py, pz,    ax, ay, az, bx, by, bz, qx, qy, qz, angle)
{
    ax = x[b] - x[a]; ay = y[b] - y[a]; az = z[b] - z[a]
    bx = x[c] - x[a]; by = y[c] - y[a]; bz = z[c] - z[a]
    qx = ay * bz - az * by; qy = az * bx - ax * bz; qz = ax * by - ay * bx
    angle = atan2(sqrt(qx * qx + qy * qy + qz * qz), ax * bx + ay * by + az * bz)
    nx[a] += angle * px
    ny[a] += angle * py
    nz[a] += angle * pz
}

END {
    if (failed) exit 1
    if (triangles == 0) {
        print FILENAME ": no triangles in it" >"/dev/stderr"
        exit 1
    }
    print "// " name ": " vertices " vertices, " triangles " triangles; written by obj2mesh.awk"
    print "#declare " name " = mesh2 {"
    print "vertex_vectors { " vertices
    for (i = 1; i <= vertices; i++) printf ",<%.6g,%.6g,%.6g>\n", x[i], y[i], z[i]
    print "}\nnormal_vectors { " vertices
    for (i = 1; i <= vertices; i++) {
        length_n = sqrt(nx[i] * nx[i] + ny[i] * ny[i] + nz[i] * nz[i])
        if (length_n == 0) { # a vertex of no triangle, or of two that lie on each other
            ny[i] = length_n = 1
        }
        printf ",<%.6g,%.6g,%.6g>\n", nx[i] / length_n, ny[i] / length_n, nz[i] / length_n
    }
    print "}\nface_indices { " triangles
    for (i = 0; i < triangles; i++)
        printf ",<%d,%d,%d>\n", corners[i * 3] - 1, corners[i * 3 + 1] - 1, corners[i * 3 + 2] - 1
    print "} }"
}
