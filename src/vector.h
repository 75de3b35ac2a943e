/* vector.h - directions as double[3], and the tangent frame of a normal. */
#ifndef PE_VECTOR_H
#define PE_VECTOR_H

#include <math.h>

static inline double pe_dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline void pe_scale(double s, const double a[3], double out[3])
{
    for (int c = 0; c < 3; c++)
        out[c] = s * a[c];
}

static inline void pe_cross(const double a[3], const double b[3], double out[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

static inline void pe_normalize(const double a[3], double out[3])
{
    pe_scale(1 / sqrt(pe_dot(a, a)), a, out);
}

/* The same for any length but zero, though its square be out of range. */
static inline void pe_normalize_any(const double a[3], double out[3])
{
    double square = pe_dot(a, a), largest;
    double tame[3];

    if (square > 1e-250 && square < 1e250) {
        pe_scale(1 / sqrt(square), a, out);
        return;
    }
    largest = fmax(fabs(a[0]), fmax(fabs(a[1]), fabs(a[2])));
    for (int c = 0; c < 3; c++)
        tame[c] = a[c] / largest;
    pe_normalize(tame, out);
}

/* r = 2 (o.n) n - o: the mirror direction of o about the unit normal n, and the other way round. */
static inline void pe_reflect(const double o[3], const double n[3], double r[3])
{
    double twice = 2 * pe_dot(o, n);

    for (int c = 0; c < 3; c++)
        r[c] = twice * n[c] - o[c];
}

/* Rows t, b, n: an orthonormal frame.  frame * v gives v's tangent coordinates (x, y, z). */
typedef struct pe_frame {
    double t[3], b[3], n[3];
} pe_frame;

static inline void pe_frame_coordinates(const pe_frame *frame, const double v[3], double out[3])
{
    out[0] = pe_dot(frame->t, v);
    out[1] = pe_dot(frame->b, v);
    out[2] = pe_dot(frame->n, v);
}

static inline void pe_frame_direction(const pe_frame *frame, const double xyz[3], double out[3])
{
    for (int c = 0; c < 3; c++)
        out[c] = xyz[0] * frame->t[c] + xyz[1] * frame->b[c] + xyz[2] * frame->n[c];
}

/* t = normalize(d - (d.n) n), b = n x t, for the unit normal n and the brush direction d of any length.  Where n is
 * parallel to d (to within rounding), t is made from the axis least along n. */
static inline void pe_frame_make(const double n[3], const double d[3], pe_frame *frame)
{
    double unit[3], t[3];
    double along;

    pe_normalize_any(d, unit);
    along = pe_dot(unit, n);
    for (int c = 0; c < 3; c++)
        t[c] = unit[c] - along * n[c];
    if (pe_dot(t, t) < 1e-20) {
        int least = 0;

        for (int c = 1; c < 3; c++)
            if (fabs(n[c]) < fabs(n[least]))
                least = c;
        for (int c = 0; c < 3; c++)
            t[c] = (c == least) - n[least] * n[c];
    }
    pe_normalize(t, frame->t);
    for (int c = 0; c < 3; c++)
        frame->n[c] = n[c];
    pe_cross(frame->n, frame->t, frame->b);
}

#endif
