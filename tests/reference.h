/* reference.h - the naive truth: [Motegi Eq. 4-6] in double precision, written from the formulas alone.
 *
 * Nothing here calls the library, so that an error there is not repeated here.  Frame and units as in prefenv.h. */
#ifndef REFERENCE_H
#define REFERENCE_H

/* Centre of texel (x, y) of a width x height lat-long image; its polar angle is *theta. */
void reference_direction(int width, int height, int x, int y, double direction[3], double *theta);

/* D(h) of unit vectors: h, normal n, tangents t and b. [Motegi Eq. 6] */
double reference_beckmann(double alpha_x, double alpha_y, const double h[3], const double t[3], const double b[3],
                          const double n[3]);

/* The same for the kinds of pe_ndf_kind that have a formula, by its number: 0 Beckmann, 1 GGX, 2 Phong. */
double reference_density(int kind, double alpha_x, double alpha_y, const double h[3], const double t[3],
                         const double b[3], const double n[3]);

/* Texels this close to the horizon are on neither side of it: their cosine is rounding. */
#define REFERENCE_HORIZON 1e-9

/* The reflection at a surface of unit normal n and brush direction d towards the unit vector o: [Motegi Eq. 5] over the
 * texels in the hemisphere of n. */
void reference_reflection(const float *rgb, int width, int height, double alpha_x, double alpha_y, const double d[3],
                          const double n[3], const double o[3], double out[3]);

/* The same for any of the kinds. */
void reference_reflection_of(int kind, const float *rgb, int width, int height, double alpha_x, double alpha_y,
                             const double d[3], const double n[3], const double o[3], double out[3]);

/* F of a conductor of index eta + i k, by complex arithmetic; 1 where both are 0. */
double reference_reflectance(double eta, double k, double cosine);

/* D G2 F / (4 o.n) of the lights w: height-correlated Smith masking of Beckmann (0) and GGX (1), all vectors unit. */
double reference_microfacet(int kind, double alpha_x, double alpha_y, double eta, double k, const double o[3],
                            const double w[3], const double t[3], const double b[3], const double n[3]);

/* Its integral over the hemisphere, by the midpoint rule with side x side steps of the angles; o in the tangent
 * frame. */
double reference_furnace(int kind, double alpha_x, double alpha_y, double eta, double k, const double o[3], int side);

/* Its sum over the texels in the hemisphere of n, for each channel with an index of its own. */
void reference_scattering(int kind, const float *rgb, int width, int height, double alpha_x, double alpha_y,
                          const double eta[3], const double k[3], const double d[3], const double n[3],
                          const double o[3], double out[3]);

/* ---- environments that hurt, and the means to make more; release with free() ---- */

float *reference_constant(int width, int height, float value);
float *reference_noise(int width, int height, unsigned seed);                 /* each channel uniform in [0, 1) */
float *reference_lit_texel(int width, int height, int x, int y, float value); /* black but for one texel */
float *reference_half_white(int width, int height, const double n[3]);        /* 1 where direction.n > 0, else 0 */
float *reference_room(int width, int height);     /* a sky, a ground and a few lamps, none of them small */
float *reference_gradient(int width, int height); /* (1 + w)^2 of the direction w: differs on all sides */

/* A fixed sequence in [0, 1), and unit vectors spread evenly over the sphere by it. */
double reference_random(unsigned *state);
void reference_random_direction(unsigned *state, double direction[3]);

#endif
