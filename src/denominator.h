/* denominator.h - the denominator of Eq. 5 in closed form: how much weight a whole hemisphere of light has. */
#ifndef PE_DENOMINATOR_H
#define PE_DENOMINATOR_H

#include "prefenv.h"

/* W(o), the integral of D(h) over the directions w of the hemisphere, h = normalize(o + w), for every viewer o: what
 * the sum of D(h_j) over an environment's solid angles approximates.  [Motegi Eq. 4] */
typedef struct pe_denominator pe_denominator;

/* Takes a few milliseconds. */
pe_status pe_denominator_make(const pe_ndf *ndf, pe_denominator **out, pe_error *error);
void pe_denominator_free(pe_denominator *denominator); /* NULL is allowed */

/* W(o), o unit and above the horizon of the tangent frame; INFINITY where o sees no normal, so that nothing is left of
 * what is divided by it. */
double pe_denominator_at(const pe_denominator *denominator, const double o[3]);

/* The same without a table, in some tens of microseconds: for surfaces that are met once. */
double pe_denominator_of(const pe_ndf *ndf, const double o[3]);

/* 1 / cos^2(theta_h) of the farthest half vectors that count; may be INFINITY. */
double pe_denominator_farthest(const pe_denominator *denominator);

/* What suns are divided by: W(o) of one lobe, or of a lobe between up to four others, whose shares add up to 1.  Zeros
 * are none. */
typedef struct pe_denominators {
    int count;
    const pe_denominator *of[4];
    double shares[4], farthest; /* the farthest of all */
} pe_denominators;

/* Of a surface that needs none, NULL. */
void pe_denominators_add(pe_denominators *denominators, const pe_denominator *denominator, double share);
double pe_denominators_at(const pe_denominators *denominators, const double o[3]);

#endif
