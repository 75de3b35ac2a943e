/* prefenv.h - glossy reflection of a prefiltered environment: the public interface of libprefenv.
 *
 * FRAME.  POV-Ray's: left-handed, +y up.  A lat-long environment of width W and height H is oriented as
 * POV-Ray's `image_map { ... map_type 1 }`: column x of texel centres lies at u = (x + 1/2) / W with
 * u = atan2(z, x) / 2 pi (so +x at u = 0, +z at u = 1/4), row y at v = (y + 1/2) / H, v = 0 at +y and v = 1 at -y.
 * Seen from inside the sphere such a picture is mirrored, as it is in POV-Ray.
 *
 * UNITS.  Radiance is linear, scene-referred RGB.  Angles are in radians.  `alpha` is the microfacet width of the
 * normal distribution - sqrt 2 times the root mean square of the slope along one tangent - not a perceptual roughness.
 * Directions point away from the surface.  n: surface normal.  o: direction to the viewer.  r = 2 (o.n) n - o.
 *
 * TANGENTS.  A brush direction d gives t = normalize(d - (d.n) n) and b = n x t; alpha_x is the width along t,
 * alpha_y the width along b.  Where n is parallel to d, any perpendicular serves.
 *
 * ERRORS.  Every call that can fail returns a pe_status and takes a pe_error, which may be NULL; it receives the
 * status and one sentence that names file, field and value.  On failure nothing is stored in the outputs.  The
 * library never prints, never exits and keeps no globals.  What is validated on load cannot fail later.
 *
 * THREADS.  Objects are immutable once made: any number of threads may read one.  The results of every function
 * are the same bits for any number of threads.
 *
 * Keys such as [Motegi Eq. 5] are listed in REFERENCES.md.
 */
#ifndef PREFENV_H
#define PREFENV_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

#define PE_VERSION "0.1.0"

/* ---- status ------------------------------------------------------------------------------------------------- */

typedef enum pe_status {
    PE_OK = 0,
    PE_ERROR_ARGUMENT, /* a value given by the caller is out of range */
    PE_ERROR_FILE,     /* a file cannot be opened, read, written or renamed */
    PE_ERROR_FORMAT,   /* the bytes are not what they should be */
    PE_ERROR_LIMIT,    /* larger than this library is willing to handle */
    PE_ERROR_MEMORY,   /* out of memory */
    PE_ERROR_CANCELLED /* the progress function asked to stop */
} pe_status;

typedef struct pe_error {
    pe_status status;
    char message[512]; /* one sentence, no newline, no trailing stop */
} pe_error;

/* Called now and then, from the calling thread only, with fraction in [0, 1].  Return non-zero to cancel. */
typedef int pe_progress(double fraction, void *data);

/* ---- images ------------------------------------------------------------------------------------------------- */

#define PE_IMAGE_TEXELS_MAX (16384u * 8192u)

/* A picture of any kind: height rows from the top, width texels from the left, three floats each, linear RGB. */
typedef struct pe_image {
    int width, height;
    float *rgb;   /* 3 * width * height floats */
    float *alpha; /* width * height floats, clipped to [0, 1], or NULL if the file has no alpha channel */
} pe_image;

/* Reads OpenEXR (every pixel type, storage and compression; RGB, RGBA or Y), Radiance HDR or PNG (8 and 16 bit,
 * sRGB or the file's own gamma made linear), told apart by their first bytes.  Values are as in the file: NaN and
 * infinities stay.  The memory form reads from bytes; `name` is used in messages only.  Release with pe_image_free. */
pe_status pe_image_read(const char *path, pe_image *image, pe_error *error);
pe_status pe_image_read_memory(const void *bytes, size_t size, const char *name, pe_image *image, pe_error *error);

/* The same for data, which is not colour - heights, normals: the values of a PNG are those it stores, 0 to 1. */
pe_status pe_image_read_data(const char *path, pe_image *image, pe_error *error);
pe_status pe_image_read_data_memory(const void *bytes, size_t size, const char *name, pe_image *image, pe_error *error);

/* Writes an 8-bit RGB PNG: linear values are clipped to [0, 1] and encoded as sRGB.  The file appears whole or not at
 * all: it is written beside its target and renamed. */
pe_status pe_image_write_png(const char *path, const pe_image *image, pe_error *error);

void pe_image_free(pe_image *image); /* frees what the picture holds, not the struct; NULL is allowed */

/* The sRGB transfer function of IEC 61966-2-1: linear to encoded, both in [0, 1]; arguments outside are clipped. */
double pe_srgb_encode(double linear);
double pe_srgb_decode(double encoded);

/* ---- environments ------------------------------------------------------------------------------------------- */

/* A lat-long environment: radiance from every direction. */
typedef struct pe_env pe_env;

#define PE_RADIANCE_MAX 1e30f /* of a texel: sums and powers of such are floats, still */

/* Reads what pe_image_read reads.  Values that are NaN, negative, infinite or above PE_RADIANCE_MAX are repaired (0;
 * the infinite and those above become the largest of their channel that is not) and counted: see pe_env_repairs. */
pe_status pe_env_read(const char *path, pe_env **env, pe_error *error);
pe_status pe_env_read_memory(const void *bytes, size_t size, const char *name, pe_env **env, pe_error *error);

/* Copies 3 * width * height floats, rows from +y down; repairs as pe_env_read does. */
pe_status pe_env_create(int width, int height, const float *rgb, pe_env **env, pe_error *error);

void pe_env_free(pe_env *env); /* NULL is allowed */

int pe_env_width(const pe_env *env);
int pe_env_height(const pe_env *env);
const float *pe_env_texels(const pe_env *env); /* 3 * width * height floats, rows from +y down */
const char *pe_env_name(const pe_env *env);    /* the file's name without its folder; "" if made from memory */
size_t pe_env_repairs(const pe_env *env);      /* texels repaired on load */
const char *pe_env_remark(const pe_env *env);  /* what is doubtful as an environment, a sentence; or "" */

/* Tells environments apart, whatever their files are called: a number that is the same for the same texels, and for
 * others hardly ever.  Never 0. */
unsigned long long pe_env_fingerprint(const pe_env *env);

/* Radiance from `direction` (any length but zero), bilinear between texel centres, over the poles and around. */
void pe_env_lookup(const pe_env *env, const double direction[3], double rgb[3]);

/* The mean radiance over the sphere. */
void pe_env_mean(const pe_env *env, double rgb[3]);

/* An environment as footprints of any size see it: for rays that each stand for a solid angle [Křivánek].  Immutable;
 * the environment must outlive it.  It takes 3 MB and a fraction of a second; a lookup, a tenth of a microsecond. */
typedef struct pe_mipmap pe_mipmap;

pe_status pe_mipmap_make(const pe_env *env, pe_mipmap **mipmap, pe_error *error);
void pe_mipmap_free(pe_mipmap *mipmap); /* NULL is allowed */

/* The mean radiance around `direction`, unit, over solid_angle_sr, or half or twice as much, in [0, infinity]. */
void pe_mipmap_lookup(const pe_mipmap *mipmap, const double direction[3], double solid_angle_sr, double rgb[3]);

/* Direction (unit) of the point (u, v) of a lat-long map, and back: u in [0, 1), v in [0, 1]. */
void pe_latlong_direction(double u, double v, double direction[3]);
void pe_latlong_coordinates(const double direction[3], double *u, double *v);

/* ---- normal distributions ----------------------------------------------------------------------------------- */

typedef enum pe_ndf_kind {
    PE_NDF_BECKMANN = 0, /* [Motegi Eq. 6] */
    PE_NDF_GGX,          /* Trowbridge-Reitz, which has long tails [Walter] */
    PE_NDF_PHONG,        /* a power of cos(theta_h): 2 / alpha^2 - 2 [Ashikhmin] */
    PE_NDF_TABLE         /* measured: `table` */
} pe_ndf_kind;

typedef struct pe_ndf_table pe_ndf_table;

/* alpha_x along the tangent t, alpha_y along b: both in [PE_ALPHA_MIN, PE_ALPHA_MAX], of Phong's at most
 * PE_PHONG_ALPHA_MAX.  `table` is for PE_NDF_TABLE, which ignores the alphas, and lives as long as what uses it. */
typedef struct pe_ndf {
    pe_ndf_kind kind;
    double alpha_x, alpha_y;
    const pe_ndf_table *table;
} pe_ndf;

#define PE_ALPHA_MIN 0.001
#define PE_ALPHA_MAX 2.0
#define PE_PHONG_ALPHA_MAX 1.0 /* beyond it the exponent is negative, and D infinite at the horizon */

/* A density over the plane of slopes (p, q) = tan(theta_h) (cos phi_h, sin phi_h), p along t, q along b:
 * D(h) = P(p, q) / cos^4(theta_h).  `density` holds width * height floats, none below 0, in cells that divide the two
 * ranges evenly: the first row is that of the least q, the first of a row that of the least p, and each is the density
 * at its cell's centre.  Between centres it is bilinear, outside it falls to 0 within half a cell.  It is scaled so
 * that its integral is 1.  Each side of the table lies between 2 and 8192, 2^24 cells in all, slopes up to 1000.
 * The mean slope ought to be 0: the surface that they are measured against is then the one seen from afar. */
pe_status pe_ndf_table_create(int width, int height, const double p_range[2], const double q_range[2],
                              const float *density, pe_ndf_table **table, pe_error *error);
void pe_ndf_table_free(pe_ndf_table *table); /* NULL is allowed */

/* OpenEXR: one channel Y of floats and the attributes prefenv:ndf-version, -p-min, -p-max, -q-min, -q-max.  The file
 * appears whole or not at all. */
pe_status pe_ndf_table_write(const pe_ndf_table *table, const char *path, pe_error *error);
pe_status pe_ndf_table_read(const char *path, pe_ndf_table **table, pe_error *error);
pe_status pe_ndf_table_read_memory(const void *bytes, size_t size, const char *name, pe_ndf_table **table,
                                   pe_error *error);

/* Do these bytes start an OpenEXR file that is a table?  Non-zero if so. */
int pe_ndf_table_detect(const void *bytes, size_t size);

/* Cells, and the slopes they reach from and to. */
void pe_ndf_table_size(const pe_ndf_table *table, int *width, int *height, double p_range[2], double q_range[2]);

const char *pe_ndf_table_name(const pe_ndf_table *table); /* the file's name without its folder; "" if made */
void pe_ndf_table_alpha(const pe_ndf_table *table, double alpha[2]); /* sqrt 2 times the rms slope along t, b */

pe_status pe_ndf_check(const pe_ndf *ndf, pe_error *error);

/* D(h) in 1/sr, h a unit vector in the tangent frame (t, b, n); 0 where h.n <= 0.  The integral of D cos(theta_h) over
 * the hemisphere is 1. */
double pe_ndf_evaluate(const pe_ndf *ndf, const double h[3]);

/* h (unit, tangent frame) with density D(h) cos(theta_h) per steradian, from u1, u2 in [0, 1). */
void pe_ndf_sample(const pe_ndf *ndf, double u1, double u2, double h[3]);

/* ---- surfaces ------------------------------------------------------------------------------------------------ */

/* How the light w is weighted when the viewer looks along o. */
typedef enum pe_weight {
    PE_WEIGHT_NDF = 0,   /* by D(h), and divided by the sum of weights: [Motegi Eq. 4] */
    PE_WEIGHT_MICROFACET /* by D(h) G2(o, w) F(o.h) / (4 o.n): single scattering, with its colour and its losses */
} pe_weight;

/* A surface that reflects.  eta + i k is a conductor's complex index of refraction for red, green and blue;
 * PE_WEIGHT_NDF ignores it, and where both are 0 the reflectance F is 1. */
typedef struct pe_surface {
    pe_ndf ndf;
    pe_weight weight;
    double eta[3], k[3];
} pe_surface;

#define PE_INDEX_MAX 15.0

/* With PE_WEIGHT_MICROFACET: phong is refused; the size of eta + i k lies between 1 and PE_INDEX_MAX. */
pe_status pe_surface_check(const pe_surface *surface, pe_error *error);

/* The index of a metal, measured at 617, 549 and 451 nm, by its name; 0 if it is not known.  pe_material_name: the
 * names, index 0 and on, NULL after the last. */
int pe_material(const char *name, double eta[3], double k[3]);
const char *pe_material_name(int index);

/* ---- measured surfaces ----------------------------------------------------------------------------------------
 *
 * A machined surface as an instrument measured it, or a map of it, is a picture of the surface seen from outside.  Its
 * rows run along the tangent t, which is the brush direction, and follow each other along b.  A machined surface lies
 * with its lay - the direction of its grooves - along the rows, so that the brush follows the grooves.
 *
 * SLOPES.  Where the surface's normal is h in the frame (t, b, n), its slopes are p = h.t / h.n and q = h.b / h.n: for
 * heights z, p = -dz/dx and q = -dz/dy.  The share of the projected area whose slopes lie in dp dq is P(p, q) dp dq,
 * and D(h) = P / (h.n)^4. */

/* Heights and the distance of neighbouring texels in the same unit of length.  NaN: not measured. */
typedef struct pe_heights {
    int width, height;
    double pitch;
    double own_pitch; /* that the file states, whatever was asked for; 0 if none */
    double step;      /* that all heights of the source are multiples of, so that it seems to round to it, as PNGs of
                         any depth and whole numbers do: 1/65535 of the value 1, or a multiple of that; 0 if there is
                         none */
    float *values;    /* width * height, rows from the top */
} pe_heights;

#define PE_HEIGHTS_SIDE_MIN 8 /* texels; a smaller field has no slopes worth measuring */

/* Reads grey heights: OpenEXR or PNG (16 bit, better than 8), a PNG's values as stored, its transparent texels not
 * measured.  `unit` is the height that the value 1 - white, in a PNG - stands for, `pitch` the distance of texels in
 * the same unit of length; both 0: as the file says, if pe_heights_write made it. */
pe_status pe_heights_read(const char *path, double unit, double pitch, pe_heights *heights, pe_error *error);
pe_status pe_heights_read_memory(const void *bytes, size_t size, const char *name, double unit, double pitch,
                                 pe_heights *heights, pe_error *error);

/* Do these bytes start an OpenEXR file that pe_heights_write wrote?  Non-zero if so. */
int pe_heights_detect(const void *bytes, size_t size);

/* Writes an OpenEXR of float heights with its pitch.  The file appears whole or not at all. */
pe_status pe_heights_write(const pe_heights *heights, const char *path, pe_error *error);

void pe_heights_free(pe_heights *heights); /* frees what it holds, not the struct; NULL is allowed */

typedef enum pe_machining {
    PE_TURNED = 0, /* parabolic grooves of a round-nosed tool: slopes across even over +-feed / (2 radius) */
    PE_MILLED,     /* grooves with straight flanks: two ridges, at slopes across of +-slope */
    PE_BLASTED,    /* a Gaussian surface, the same in all directions: Beckmann */
    PE_BRUSHED     /* a Gaussian surface, drawn out along x: Beckmann of two widths */
} pe_machining;

/* The field repeats itself.  Lengths in one unit, such as micrometres.  A Gaussian surface of root mean square height
 * `roughness`, whose autocorrelation falls to 1/e over `length` along x and y, lies by itself (blasted, brushed) or
 * over the grooves (turned, milled); its slopes are Beckmann's, alpha = 2 roughness / length.  0 means the default of
 * the kind. */
typedef struct pe_machining_options {
    pe_machining kind;
    int width, height; /* texels, PE_HEIGHTS_SIDE_MIN to 8192; 0: 1024 */
    double pitch;      /* distance of texels; 0: 1 */
    double feed;       /* turned, milled: from groove to groove, along y; rounded to fit into the field */
    double radius;     /* turned: of the tool's nose */
    double slope;      /* milled: of the flanks */
    double roughness, length[2];
    unsigned seed; /* the same seed, the same surface */
} pe_machining_options;

/* Fills the zeros of `options` with the defaults of the kind and checks the rest. */
pe_status pe_machining_complete(pe_machining_options *options, pe_error *error);
pe_status pe_heights_machine(const pe_machining_options *options, pe_heights *heights, pe_error *error);

/* Slopes of all texels that have them, row by row; those of the black squares of a chess board of 8 x 8 over the
 * picture, whose corner is black, come before the white ones': two measurements of one surface, which tell what of a
 * density is the surface's and what is chance. */
typedef struct pe_slopes {
    size_t count, black;
    float *p, *q;   /* of each, `count` floats */
    size_t missing; /* texels that have none: not measured, at an edge, or facing down */
    double step;    /* twice that of the source's values, as pe_heights has it; 0 if there is none */
    double noise;   /* root mean square of what the source's rounding adds to each slope */
} pe_slopes;

typedef enum pe_edges {
    PE_EDGES_OPEN = 0, /* texels nearer than three to an edge have no slope */
    PE_EDGES_WRAP      /* the field repeats itself */
} pe_edges;

typedef enum pe_green { PE_GREEN_UP = 0 /* OpenGL */, PE_GREEN_DOWN /* DirectX */ } pe_green;

/* By the seven-point formula of [ISO 25178-2]. */
pe_status pe_slopes_of_heights(const pe_heights *heights, pe_edges edges, pe_slopes *slopes, pe_error *error);

/* Of a tangent-space normal map as pe_image_read_data reads it: 2 rgb - 1 is the normal, red to the right, green up or
 * down, blue out of the surface.  `name` is used in messages only. */
pe_status pe_slopes_of_normals(const pe_image *image, const char *name, pe_green green, pe_slopes *slopes,
                               pe_error *error);

void pe_slopes_free(pe_slopes *slopes); /* frees what it holds, not the struct; NULL is allowed */

typedef struct pe_slope_statistics {
    double mean[2];  /* of p and q: the tilt */
    double rms[2];   /* about the mean */
    double alpha[2]; /* of the Beckmann distribution of the same rms slopes: sqrt 2 rms */
    double steepest; /* the greatest slope hypot(p, q), the mean left out */
} pe_slope_statistics;

void pe_slopes_measure(const pe_slopes *slopes, pe_slope_statistics *statistics);

/* Takes the mean slope off: the part is levelled. */
void pe_slopes_level(pe_slopes *slopes);

/* Turns the surface by a quarter, so that the brush direction is down the picture's columns. */
void pe_slopes_turn(pe_slopes *slopes);

/* P(p, q) in cells: cell (i, j) is centred at p = ((2i + 1) / width - 1) range[0], q likewise with j and range[1]. */
typedef struct pe_slope_density {
    int width, height;
    double range[2];  /* the cells reach from -range to range */
    float *values;    /* per dp dq, rows of equal q; the integral over the cells is 1 */
    double beyond;    /* the share of the area outside the range, which is left out */
    double smooth[2]; /* standard deviations of the Gaussian that it was blurred with, in slope */
} pe_slope_density;

typedef enum pe_smoothing {
    PE_SMOOTHING_AUTO = 0, /* as much as lets either half of the slopes foretell the other best [Bowman] */
    PE_SMOOTHING_NONE,
    PE_SMOOTHING_GIVEN
} pe_smoothing;

/* A struct of zeros means the defaults. */
typedef struct pe_density_options {
    double range; /* both axes; 0: on each, what holds all but 1/10000 of the area */
    pe_smoothing smoothing;
    double smooth; /* PE_SMOOTHING_GIVEN: the standard deviation, on both axes, above 0 and at most 1 */
} pe_density_options;

/* Cells are 1/64 of the range, but not below 0.0005 nor above 0.0025, and at most 1024 along an axis.  A slope counts
 * evenly over the width of one cell around it, or of the source's own step where that is wider. */
pe_status pe_slopes_density(const pe_slopes *slopes, const pe_density_options *options, pe_slope_density *density,
                            pe_error *error);

void pe_slope_density_free(pe_slope_density *density); /* frees what it holds, not the struct; NULL is allowed */

/* ---- the truth ---------------------------------------------------------------------------------------------- */

/* Both take n and o of any length but zero; if o lies behind the surface, n is turned to face it.  `direction` is the
 * brush direction.  The light is what lies in the hemisphere of n: [Motegi Eq. 4].
 *
 * pe_exact: every texel of the hemisphere weighted by D(h) and its solid angle, in double precision.  [Motegi Eq. 4]
 * pe_monte_carlo: `samples` >= 1 half vectors drawn from the NDF, weighted so that the mean is Eq. 4; the sequence
 * depends on n and o alone, so that a picture is the same in every run and for any number of threads. */
void pe_exact(const pe_env *env, const pe_surface *surface, const double direction[3], const double n[3],
              const double o[3], double rgb[3]);
void pe_monte_carlo(const pe_env *env, const pe_surface *surface, const double direction[3], int samples,
                    const double n[3], const double o[3], double rgb[3]);

/* ---- Phong's lobe and its roughness ---------------------------------------------------------------------------
 *
 * [Okumura]: the light at the angle theta to the mirror direction r has the weight cos^Lambda theta, where that is not
 * negative; the larger the exponent Lambda, the smoother the surface.  Three numbers say how smooth a surface is:
 *
 *   Lambda, the exponent;
 *   lambda, from 0 (rough) to 1 (a mirror, as far as a cube of size^3 voxels can hold it):
 *           Lambda = -ln(levels) / ln(cos(arctan(window / (lambda size)))) [Okumura Eq. 13];
 *   alpha,  the width of the normal distribution whose lobe, seen head on, is as wide:
 *           Lambda = (1 / alpha^2 - 1) / 2. */

/* What lambda means.  Zeros mean the defaults. */
typedef struct pe_smoothness {
    int size;      /* s: voxels along the cube's edge, even, PE_SMOOTHNESS_SIZE_MIN to PE_SMOOTHNESS_SIZE_MAX; 0: 128 */
    double window; /* u: how many voxels a lobe is wide, 0.1 to 100; 0: 6.2 */
    double levels; /* I: what falls below 1 / levels of the lobe's peak is not to be seen, 2 to 1000000; 0: 256 */
} pe_smoothness;

#define PE_SMOOTHNESS_SIZE_MIN 8
#define PE_SMOOTHNESS_SIZE_MAX 256

pe_status pe_smoothness_check(const pe_smoothness *scale, pe_error *error);

/* Lambda = g(lambda), and the other way round; 0 belongs to 0 and below. */
double pe_smoothness_exponent(const pe_smoothness *scale, double lambda);
double pe_smoothness_lambda(const pe_smoothness *scale, double exponent);

/* Lambda of alpha in (0, 1], and the other way round; 0 belongs to 1 and above. */
double pe_phong_exponent(double alpha);
double pe_phong_alpha(double exponent);

/* What becomes of the light that comes from below the surface. */
typedef enum pe_horizon {
    PE_HORIZON_IGNORED = 0, /* it counts, as if there were no surface [Okumura Eq. 3, 8]: a function of r alone */
    PE_HORIZON_DARK,        /* it is hidden, and the rest as bright as it was [Okumura Eq. 1, 2]: rims are dark */
    PE_HORIZON_MEAN         /* it is hidden, and the rest is averaged: white surroundings stay white [Motegi Eq. 4] */
} pe_horizon;

/* The truth: every texel of the environment weighted by Phong's lobe about r and by its solid angle, in double
 * precision; the weights of the whole lobe, or of PE_HORIZON_MEAN those of what counts, add up to 1.  r and the normal
 * n of any length but zero; n may be NULL where the horizon is ignored.  exponent is not negative. */
void pe_phong(const pe_env *env, double exponent, pe_horizon horizon, const double n[3], const double r[3],
              double rgb[3]);

/* ---- highlights: of light sources that are in no environment ---------------------------------------------------
 *
 * A light source that has no size has no radiance, but an irradiance E on whatever faces it.  What is reflected of it,
 * for each unit of E, is the limit of the truths above in an environment that is black but for one small texel of
 * radiance E / its solid angle.  With h halfway between viewer and light, both above the horizon,
 *
 *   PE_WEIGHT_NDF           D(h) / W(o), W(o) the integral of D over the lights above the horizon: [Motegi Eq. 4];
 *   PE_WEIGHT_MICROFACET    D(h) G2 F / (4 o.n): light that falls in aslant, on more of the surface, is no weaker;
 *   Phong's lobe            cos^Lambda theta (Lambda + 1) / 2 pi.
 *
 * A light source of POV-Ray's that has the colour c shows as c on white matter that faces it: its E is pi c. */

/* What the highlights of a surface share: W. */
typedef struct pe_highlights pe_highlights;

/* Checks the surface, whose table must outlive them; takes a few milliseconds. */
pe_status pe_highlights_make(const pe_surface *surface, pe_highlights **highlights, pe_error *error);
void pe_highlights_free(pe_highlights *highlights); /* NULL is allowed */

/* `light` is the direction to the light source, of any length but zero; the rest is as for pe_exact.  W is that of a
 * table, within 0.03 where o.n > 0.2 and 0.15 below, unless the lobe is drawn out by more than 10; of distributions
 * that lean to one side it is coarser where viewers see few normals, and nothing is reflected where they see none.
 * pe_highlight_once: for a surface that is met at one point, such as one of varying roughness; without a table, in some
 * tens of microseconds, of measured distributions a hundred or two. */
void pe_highlight(const pe_highlights *highlights, const double direction[3], const double n[3], const double o[3],
                  const double light[3], double rgb[3]);
void pe_highlight_once(const pe_surface *surface, const double direction[3], const double n[3], const double o[3],
                       const double light[3], double rgb[3]);

/* Of Phong's lobe; arguments as for pe_phong. */
double pe_phong_highlight(double exponent, pe_horizon horizon, const double n[3], const double r[3],
                          const double light[3]);

/* ---- directions: for renderers that trace the reflection ------------------------------------------------------- */

/* A surface point and its viewer, made ready.  For pe_directions_begin to fill; the surface's table must outlive it. */
typedef struct pe_directions {
    pe_surface surface;
    double t[3], b[3], n[3]; /* the tangent frame */
    double o[3], lambda;     /* the viewer in it, and what of the surface he does not see */
    double visible;          /* what of it he does, where visible normals have a formula; else 0 */
    double offsets[2];       /* of the points that directions are drawn with */
} pe_directions;

/* n, o and the brush's direction as for pe_exact.  Directions depend on `seed`, such as the point in the world, and o
 * alone: evenly spread at each point, unrelated between points, the same in every run. */
void pe_directions_begin(const pe_surface *surface, const double direction[3], const double n[3], const double o[3],
                         const double seed[3], pe_directions *directions);

/* Direction k = 0 ... count - 1: w, unit, from which the light L(w) comes.  What is reflected is the sum of share L(w),
 * channel by channel, over the sum of what is returned; visible normals are drawn where that has a formula (Beckmann
 * and GGX).  Where share is 0 nothing comes from w, which may lie below the surface. */
double pe_directions_draw(const pe_directions *directions, int k, int count, double w[3], double share[3]);

/* The density per steradian with which pe_directions_draw draws `w`, unit, those below the surface, too; 0 where it
 * draws none. */
double pe_directions_density(const pe_directions *directions, const double w[3]);

/* One direction alone: the mean of share L(w) over many points is what is reflected.  With phong or a table, and
 * PE_WEIGHT_NDF, nearly so: it is one of 32. */
void pe_directions_one(const pe_directions *directions, double w[3], double share[3]);

/* ---- occluders: where none is in the way, no direction need be traced ------------------------------------------- */

typedef enum pe_convex_kind {
    PE_CONVEX_BALL,       /* centre + axes * the unit ball */
    PE_CONVEX_BOX,        /* centre + axes * [-1, 1]^3 */
    PE_CONVEX_CONE,       /* around axes[2]: discs of radius[0] and radius[1] times axes 0 and 1 at its ends -1 and 1 */
    PE_CONVEX_TORUS,      /* the hull of one: a tube of radius[1] around the circle of radius[0] in axes 0 and 1 */
    PE_CONVEX_TRIANGLE,   /* corners centre + axes[i], which add up to 0 */
    PE_CONVEX_HALF_SPACE, /* behind the plane through centre with the normal axes[2] */
    PE_CONVEX_PLANE       /* that plane itself, all of it */
} pe_convex_kind;

/* A convex body, or one that holds what is not convex.  Rays that start on a triangle, whose corners may be in single
 * precision, may be off by `slack`, a length. */
typedef struct pe_convex {
    pe_convex_kind kind;
    double centre[3], axes[3][3], radius[2];
    double slack;
} pe_convex;

typedef struct pe_occluders pe_occluders;

pe_occluders *pe_occluders_create(void);         /* NULL if memory does not suffice */
void pe_occluders_free(pe_occluders *occluders); /* NULL is allowed */

/* Adds what stands where all of `count` bodies overlap; of none, or with a number that is not finite: it may be
 * anywhere.  0 if memory does not suffice. */
int pe_occluders_add(pe_occluders *occluders, const pe_convex *bodies, int count);

/* After the last is added, and before the first lobe is asked for.  0 if memory does not suffice. */
int pe_occluders_finish(pe_occluders *occluders);

typedef enum pe_sight {
    PE_SIGHT_UNKNOWN, /* something may be there: bodies may be larger than what is in them */
    PE_SIGHT_CLEAR,   /* nothing is */
    PE_SIGHT_COVERED  /* behind everything that may be is a plane without end, in all directions */
} pe_sight;

/* What stands in the directions less than half_angle, in radians, away from `axis` and above the facet (its normal),
 * both of length 1, as seen from `origin` on or off the bodies.  Some hundred nanoseconds, of meshes a microsecond; for
 * any number of threads at a time.  Unknown before pe_occluders_finish. */
pe_sight pe_lobe_sight(const pe_occluders *occluders, const double origin[3], const double facet[3],
                       const double axis[3], double half_angle);

/* The greatest angle between normals and the surface, in radians, but for a share of them: of the integral of
 * D cos(theta_h), 0 < share < 1. */
double pe_ndf_spread(const pe_ndf *ndf, double share);

/* ---- maps: bake, read, write -------------------------------------------------------------------------------- */

/* What is looked up: the environment filtered once for each representative normal, or once (baseline). */
typedef struct pe_maps pe_maps;

typedef enum pe_method {
    PE_METHOD_DEFAULT = 0,    /* hemispheres */
    PE_METHOD_HEMISPHERES,    /* a map of its hemisphere for each representative normal, in its own tangent frame; the
                                   suns apart: their highlights are exact */
    PE_METHOD_REPRESENTATIVE, /* [Motegi 3.1]: a pair of opposite normals shares one lat-long map */
    PE_METHOD_BASELINE,       /* one map, the lobe as at normal incidence for every direction [Motegi Fig. 3a] */

    /* For surfaces whose roughness varies: Phong's lobe about the mirror direction, of any smoothness lambda. */
    PE_METHOD_LAYERS, /* a lat-long map for each of some roughnesses, as fine as its lobe needs; splines between them */
    PE_METHOD_VOXELS, /* [Okumura]: a cube of voxels, linear between them */

    PE_METHOD_GRADES /* microfacets of any roughness: hemispheres for each of some alphas, a constant factor from one to
                        the next, each with the normals and texels that it needs; the suns apart from all of them */
} pe_method;

/* What of a lobe falls below the threshold of the voxels' weight table. */
typedef enum pe_lost_weight {
    PE_LOST_SPREAD = 0, /* is spread over the rest: white surroundings stay white */
    PE_LOST_DARK        /* is missing [Okumura Eq. 9, 14] */
} pe_lost_weight;

/* How much memory the automatic choice of normals and sizes may take, in half floats. */
typedef enum pe_quality {
    PE_QUALITY_NORMAL = 0, /* 10 MB: the paper's 21 maps of 400 x 200 */
    PE_QUALITY_HIGH        /* 64 MB */
} pe_quality;

typedef enum pe_accuracy {
    PE_ACCURACY_AUTO = 0, /* exact up to 128 x 64 environment texels, fast above */
    PE_ACCURACY_EXACT,    /* [Motegi Eq. 5], every texel */
    PE_ACCURACY_FAST      /* the environment in clusters; the error is estimated and recorded */
} pe_accuracy;

#define PE_GRADES_ALPHA_MIN 0.02
#define PE_GRADES_ALPHA_MAX 1.0

/* The relative error that may be asked for, and one of lookups that shows: worth a warning where none was asked for. */
#define PE_WANTED_ERROR_MIN 0.0005
#define PE_WANTED_ERROR_MAX 0.1
#define PE_VISIBLE_ERROR 0.05

/* A struct of zeros means the defaults. */
typedef struct pe_bake_options {
    pe_method method;
    pe_surface surface;  /* both alphas 0: 0.1, or those of the table.  Grades: of the smoothest; 0:
                            PE_GRADES_ALPHA_MIN */
    double alpha_max;    /* grades: alpha_x of the roughest, whose alpha_y is in proportion; 0: PE_GRADES_ALPHA_MAX */
    double direction[3]; /* brush direction, any length; 0 0 0: +y */
    int normals;         /* 10 f^2 + 2 for a frequency f in [1, 32]; 0: as many as fit.  Baseline: ignored */
    int width, height;   /* of a map, in texels, each in [8, 8192]; 0: as the lobe needs.  Lat-long maps: in [2, 8192];
                            0: 400 x 200 */
    int angles;          /* hemispheres: brush directions each normal is filtered for, 1 or 4 to 64; 0: 1 */
    pe_quality quality;  /* ignored where `error` is given, which takes what it needs, up to PE_QUALITY_HIGH's memory */
    double error;        /* the relative error wanted of what is looked up, PE_WANTED_ERROR_MIN to PE_WANTED_ERROR_MAX;
                            0: what `quality` gives */
    pe_accuracy accuracy;

    /* Layers and voxels, which heed of those above accuracy and, layers, width and height of the smoothest alone (its
     * height half its width).  AUTO is fast: voxels by the weight table, layers from smaller copies of the
     * environment. */
    pe_smoothness smoothness; /* what lambda means, and the voxels' number */
    int layers;               /* of grades, too: 4 to 64, or 32; 0: as many as the error wants */
    double threshold;         /* of the weight table, against the lobe's peak: 0.000001 to 0.5; 0: 0.001 */
    pe_lost_weight lost;
    const char *weights; /* a file that keeps the table: read if it is there, else written; NULL: it is not kept */

    int threads; /* 0: one a processor */
    pe_progress *progress;
    void *progress_data;
} pe_bake_options;

pe_status pe_bake(const pe_env *env, const pe_bake_options *options, pe_maps **maps, pe_error *error);

/* What a maps file says of itself.  Strings live as long as the maps. */
typedef struct pe_maps_info {
    int format_version;
    pe_method method;
    pe_surface surface;   /* of a table its name and alphas are kept, not itself: ndf.table is NULL; of grades the
                             smoothest's */
    int grades;           /* how many; 0: maps of another method */
    double alpha_max;     /* of grades: alpha_x of the roughest */
    const char *ndf_name; /* the table's; "" if there is none */
    double direction[3];
    int normals;        /* 0 for baseline */
    int frequency;      /* of the geodesic sphere; 0 for baseline */
    int angles;         /* brush directions, half a turn / angles apart, of a table a turn; 1: `direction` alone */
    int pole_angles;    /* hemispheres of one angle: brush directions of the normals about the brush; 0: one, too */
    double pole_cosine; /* those normals n have |n.direction| above this */
    int images;         /* held: normals * angles, and what the poles have more; lat-long: normals / 2, or 1 */
    int width, height;  /* of each.  Of grades normals, frequency, poles and sizes are the smoothest's, images all */
    int suns;           /* lights kept apart from the images */
    const char *source_name;
    int source_width, source_height;
    /* pe_env_fingerprint of the environment; 0: a file that does not tell */
    unsigned long long source_fingerprint;
    pe_accuracy accuracy;     /* EXACT or FAST */
    double error_estimate;    /* relative L2 error of the texels against Eq. 5 where n.r > 0.15; 0 for exact */
    double error_wanted;      /* of the options, or what their quality means; 0: a file that does not tell */
    double lookup_error;      /* the same of linear lookups for normals and views of every kind, against pe_exact; 0 for
                              lat-long maps: not measured.  Layers and voxels: of lookups anywhere, against pe_phong,
                              the estimate being that of texels and voxels */
    pe_smoothness smoothness; /* layers and voxels: what their roughness lambda means; else zeros */
    double threshold;         /* voxels: of the weight table; 0: made without one */
    pe_lost_weight lost;
} pe_maps_info;

/* Do lookups heed a point's roughness?  Non-zero if so: it is the lambda of info's smoothness, or of grades alpha_x. */
int pe_maps_have_roughness(const pe_maps *maps);

/* The maps of grade k, 0 the smoothest, whose info says which alphas it is for; they have no suns.  NULL of maps
 * without grades. */
const pe_maps *pe_maps_grade(const pe_maps *maps, int k);

/* Grades: the surface that a lookup of this roughness, which may lie out of range, is for.  Others: their own. */
void pe_maps_surface(const pe_maps *maps, double roughness, pe_surface *surface);

const pe_maps_info *pe_maps_get_info(const pe_maps *maps);

/* Many environments of one size, baked alike, one after the other: what does not depend on them is made once.
 *
 * pe_baker_make checks the options and decides what they leave open, for environments of this size.  A table that they
 * name, and their progress_data, must outlive the baker. */
typedef struct pe_baker pe_baker;
pe_status pe_baker_make(const pe_bake_options *options, int width, int height, pe_baker **baker, pe_error *error);
void pe_baker_free(pe_baker *baker); /* NULL is allowed */

/* What its maps will say of themselves, but for source_name, source_fingerprint, suns and errors. */
const pe_maps_info *pe_baker_get_info(const pe_baker *baker);

/* What maps record as error_estimate and lookup_error. */
typedef struct pe_bake_errors {
    double texels, lookups;
} pe_bake_errors;

/* The maps that pe_bake makes of env.  errors: NULL, and they are estimated; or those to be recorded instead, such as
 * the ones of an environment much like it. */
pe_status pe_baker_bake(const pe_baker *baker, const pe_env *env, const pe_bake_errors *errors, pe_maps **maps,
                        pe_error *error);

/* The maps of up to PE_FRAMES_MAX environments at once, in far less time than one after the other: their lights
 * are gathered at places that are the same for all.  The maps of each have the same bits in whatever company, and other
 * bits than pe_baker_bake's, within the same error.  errors: NULL, and those of the first are estimated and recorded
 * for all.  Bakers that cannot do so - exact ones, baseline's, and what is too large or too wide for it - bake them one
 * by one. */
#define PE_FRAMES_MAX 5
pe_status pe_baker_bake_frames(const pe_baker *baker, const pe_env *const *envs, int count,
                               const pe_bake_errors *errors, pe_maps **maps, pe_error *error);

/* Image k, 3 * width * height floats; of layers each has its own size: pe_maps_image_size.
 * Hemispheres: that of the normal n_k/angles with its brush turned by k % angles, half a turn being `angles`; of one
 * angle those with the brush as it is, n_k, before pole_angles - 1 for each normal at the poles.  src/disc.h says which
 * texel looks where, those beyond the horizon carry on as the last within.  Suns are not in it.
 * Lat-long: the half with d.n_k > 0 belongs to the normal n_k, the other to -n_k.
 * Layers: lat-long, what Phong's lobe of the exponent pe_maps_image_exponent gathers about each direction; the
 * smoothest first.
 * Grades: those of its hemispheres, one grade after the other.
 * Voxels: those of one z, rows of one y; voxel (x, y, z) is centred at lambda r = (2 (x, y, z) + 1) / size - 1.  Those
 * that no lookup takes are black. */
const float *pe_maps_image(const pe_maps *maps, int k);
void pe_maps_image_size(const pe_maps *maps, int k, int *width, int *height);
double pe_maps_image_exponent(const pe_maps *maps, int k);    /* of layers; else 0 */
void pe_maps_normal(const pe_maps *maps, int k, double n[3]); /* n_k, unit */

/* Do these bytes start an OpenEXR file that carries Prefenv's attributes?  Non-zero if so. */
int pe_maps_detect(const void *bytes, size_t size);

pe_status pe_maps_read(const char *path, pe_maps **maps, pe_error *error);
pe_status pe_maps_read_memory(const void *bytes, size_t size, const char *name, pe_maps **maps, pe_error *error);

typedef enum pe_pixel_type { PE_PIXEL_HALF = 0, PE_PIXEL_FLOAT } pe_pixel_type;

/* The file appears whole or not at all: it is written beside its target and renamed.  Half floats end at 65504: if a
 * texel is brighter, PE_ERROR_LIMIT says so and names the way out (PE_PIXEL_FLOAT). */
pe_status pe_maps_write(const pe_maps *maps, const char *path, pe_pixel_type type, pe_error *error);

void pe_maps_free(pe_maps *maps); /* NULL is allowed */

/* ---- sample: the lookup --------------------------------------------------------------------------------------- */

/* The numbers are those of `method` in POV-Ray's prefiltered_environment block. */
typedef enum pe_interpolation {
    PE_INTERPOLATION_DEFAULT = 0,  /* linear */
    PE_INTERPOLATION_NEAREST = 1,  /* the nearest representative normal [Motegi Fig. 4a] */
    PE_INTERPOLATION_WEIGHTED = 2, /* [Motegi Eq. 7] */
    PE_INTERPOLATION_LINEAR = 3    /* barycentric over the geodesic triangle that holds n */
} pe_interpolation;

typedef struct pe_sampling {
    pe_interpolation interpolation;
    double exponent; /* Eq. 7's a, for weighted; 0: 50 (f / 2)^2 */
    /* Of layers and voxels, which hold whole lobes: DARK takes the share of even light that the surface lets through,
     * MEAN and IGNORED take all.  Other maps know of the horizon by themselves. */
    pe_horizon horizon;
} pe_sampling;

/* A point of a surface that is looked at.  n, o and direction are of any length but zero; if o lies behind the surface,
 * n is turned to face it. */
typedef struct pe_point {
    double n[3], o[3];
    const double *direction; /* the brush's at this point; NULL, or maps of one angle: the one of the file */
    double roughness;        /* layers and voxels: lambda, what is outside [0, 1] as the nearer end; grades: alpha_x,
                                what is out of range likewise; others ignore it */
} pe_point;

/* The reflected radiance of a point: [Motegi Eq. 3] with the interpolation asked for; of layers and voxels
 * [Okumura Eq. 4], which have no normals to interpolate between.  `sampling` may be NULL
 * (defaults). */
void pe_sample(const pe_maps *maps, const pe_sampling *sampling, const pe_point *point, double rgb[3]);

#ifdef __cplusplus
}
#endif

#endif
