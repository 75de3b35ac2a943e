/* heights_machined.c - height fields of surfaces as four ways of machining leave them.
 *
 * TURNED.  A tool with a round nose of radius R leaves a groove at every feed f.  Near its bottom the circle is the
 * parabola z = y^2 / 2R, whose slope y / R is spread evenly over +-f / 2R.  Height: f^2 / 8R.
 * MILLED.  Straight flanks of slope s, f / 2 wide each: slopes are s or -s.  Height: s f / 2.
 * BLASTED, BRUSHED, and the roughness over the grooves: white noise blurred with a Gaussian of standard deviation
 * l / 2.  Its autocorrelation is exp(-(r / l)^2), so with a root mean square height of w the mean square of the slope
 * is 2 w^2 / l^2 along each axis: Beckmann's distribution with alpha = sqrt 2 rms slope = 2 w / l [Beckmann].
 * The field repeats itself: the feed is rounded so that a whole number of grooves fits. */
#include "sequence.h"
#include "status.h"

#include <math.h>
#include <stdlib.h>

#define SIDE_MAX 8192
#define LENGTH_TEXELS_MIN 4 /* a shorter correlation is not resolved */
#define LENGTHS_ACROSS_MIN 4
#define FEED_TEXELS_MIN 8 /* slopes are measured over seven texels, which must not see past a groove */
#define REACH 5           /* of the blur, in standard deviations */

/* ---- options ---- */

static const pe_machining_options presets[] = {
    [PE_TURNED] = { .feed = 100, .radius = 400, .slope = 0, .roughness = 0.04, .length = { 16, 8 } },
    [PE_MILLED] = { .feed = 128, .radius = 0, .slope = 0.12, .roughness = 0.06, .length = { 16, 8 } },
    [PE_BLASTED] = { .feed = 0, .radius = 0, .slope = 0, .roughness = 0.4, .length = { 8, 8 } },
    [PE_BRUSHED] = { .feed = 0, .radius = 0, .slope = 0, .roughness = 0.6, .length = { 40, 8 } },
};

static void fill(double *value, double preset)
{
    if (*value == 0)
        *value = preset;
}

static pe_status check_length(const pe_machining_options *o, int axis, pe_error *error)
{
    double side = o->pitch * (axis == 0 ? o->width : o->height);

    if (o->length[axis] >= LENGTH_TEXELS_MIN * o->pitch && LENGTHS_ACROSS_MIN * o->length[axis] <= side)
        return PE_OK;
    return pe_fail(error, PE_ERROR_ARGUMENT,
                   "a correlation length of %g along %c must lie between %g, %d texels, and %g, a quarter of the field",
                   o->length[axis], "xy"[axis], LENGTH_TEXELS_MIN * o -> pitch, LENGTH_TEXELS_MIN,
                   side / LENGTHS_ACROSS_MIN);
}

static pe_status check_positive(const char *what, double value, double most, pe_error *error)
{
    if (value > 0 && value <= most)
        return PE_OK;
    return pe_fail(error, PE_ERROR_ARGUMENT, "%s of %g is out of range: above 0, at most %g", what, value, most);
}

static pe_status check_grooves(const pe_machining_options *o, pe_error *error)
{
    pe_status status = check_positive("a feed", o->feed, o->pitch * o->height, error);

    if (status == PE_OK && o->feed < FEED_TEXELS_MIN * o->pitch)
        status = pe_fail(error, PE_ERROR_ARGUMENT,
                         "a feed of %g is narrower than %d texels of a pitch of %g, which do not resolve it; the feed "
                         "is at least %g, or the pitch at most %g",
                         o->feed, FEED_TEXELS_MIN, o->pitch, FEED_TEXELS_MIN * o->pitch, o->feed / FEED_TEXELS_MIN);
    if (status == PE_OK && o->kind == PE_TURNED) {
        status = check_positive("a radius", o->radius, 1e9 * o->pitch, error);
        if (status == PE_OK && o->feed > o->radius)
            status = pe_fail(error, PE_ERROR_ARGUMENT,
                             "a feed of %g with a radius of %g is not turning; a feed is at most the radius", o->feed,
                             o->radius);
    }
    if (status == PE_OK && o->kind == PE_MILLED)
        status = check_positive("a slope", o->slope, 10, error);
    return status;
}

pe_status pe_machining_complete(pe_machining_options *options, pe_error *error)
{
    pe_machining_options o = *options;
    pe_status status;

    if ((int)o.kind < PE_TURNED || o.kind > PE_BRUSHED)
        return pe_fail(error, PE_ERROR_ARGUMENT, "machining of kind %d is not known", (int)o.kind);
    o.width = o.width ? o.width : 1024;
    o.height = o.height ? o.height : 1024;
    if (o.width < PE_HEIGHTS_SIDE_MIN || o.height < PE_HEIGHTS_SIDE_MIN || o.width > SIDE_MAX || o.height > SIDE_MAX)
        return pe_fail(error, PE_ERROR_ARGUMENT, "a field of %d x %d is out of range: each side from %d to %d", o.width,
                       o.height, PE_HEIGHTS_SIDE_MIN, SIDE_MAX);
    fill(&o.pitch, 1);
    fill(&o.feed, presets[o.kind].feed);
    fill(&o.radius, presets[o.kind].radius);
    fill(&o.slope, presets[o.kind].slope);
    fill(&o.roughness, presets[o.kind].roughness);
    fill(&o.length[0], presets[o.kind].length[0]);
    fill(&o.length[1], presets[o.kind].length[1]);
    status = check_positive("a pitch", o.pitch, 1e9, error);
    if (status == PE_OK)
        status = check_positive("a roughness", o.roughness, 1e9, error);
    for (int axis = 0; axis < 2 && status == PE_OK; axis++)
        status = check_length(&o, axis, error);
    if (status == PE_OK && (o.kind == PE_TURNED || o.kind == PE_MILLED)) {
        status = check_grooves(&o, error);
        o.feed = o.height * o.pitch / nearbyint(o.height * o.pitch / o.feed);
    }
    if (status == PE_OK)
        *options = o;
    return status;
}

/* ---- the Gaussian surface ---- */

static double next_uniform(uint64_t *state)
{
    return ((double)(pe_random_bits(state) >> 11) + 0.5) / 9007199254740992.0; /* 2^53: in (0, 1) */
}

static void fill_with_noise(unsigned seed, float *values, size_t count)
{
    uint64_t state = seed;

    for (size_t k = 0; k < count; k++) {
        double radius = sqrt(-2 * log(next_uniform(&state)));

        values[k] = (float)(radius * cos(2 * M_PI * next_uniform(&state)));
    }
}

/* One line blurred around; `line` and `out` are `stride` apart.  `window` has room for a line and the reach beyond both
 * of its ends. */
static void blur_line(const float *weights, int reach, int count, size_t stride, float *line, float *window)
{
    for (int k = -reach; k < count + reach; k++)
        window[k + reach] = line[(size_t)(((k % count) + count) % count) * stride];
    for (int k = 0; k < count; k++) {
        float sum = 0;

        for (int i = 0; i <= 2 * reach; i++)
            sum += weights[i] * window[k + i];
        line[(size_t)k * stride] = sum;
    }
}

/* `lines` lines of `count` values `step` apart, the next line `stride` further on. */
typedef struct lattice {
    int lines, count;
    size_t step, stride;
} lattice;

static pe_status blur(const lattice *l, double sigma, float *values, pe_error *error)
{
    int reach = (int)ceil(REACH * sigma), taps = 2 * reach + 1, room = l->count + 2 * reach;
    float *weights = calloc((size_t)taps, sizeof *weights), *window = calloc((size_t)room, sizeof *window);
    pe_status status = weights && window ? PE_OK : pe_fail_memory(error, "a line of heights");

    if (status == PE_OK) {
        for (int i = -reach; i <= reach; i++)
            weights[i + reach] = (float)exp(-0.5 * (i / sigma) * (i / sigma));
        for (int k = 0; k < l->lines; k++)
            blur_line(weights, reach, l->count, l->step, values + (size_t)k * l->stride, window);
    }
    free(weights);
    free(window);
    return status;
}

/* Shifts and scales to mean 0 and the root mean square asked for. */
static void standardize(double rms, float *values, size_t count)
{
    double sum = 0, squares = 0, mean;

    for (size_t k = 0; k < count; k++)
        sum += (double)values[k];
    mean = sum / (double)count;
    for (size_t k = 0; k < count; k++)
        squares += ((double)values[k] - mean) * ((double)values[k] - mean);
    for (size_t k = 0; k < count; k++)
        values[k] = (float)(((double)values[k] - mean) * rms / sqrt(squares / (double)count));
}

static pe_status make_rough(const pe_machining_options *o, float *values, pe_error *error)
{
    size_t width = (size_t)o->width, count = width * (size_t)o->height;
    lattice rows = { o->height, o->width, 1, width }, columns = { o->width, o->height, width, 1 };
    pe_status status;

    fill_with_noise(o->seed, values, count);
    status = blur(&rows, o->length[0] / o->pitch / 2, values, error);
    if (status == PE_OK)
        status = blur(&columns, o->length[1] / o->pitch / 2, values, error);
    if (status == PE_OK)
        standardize(o->roughness, values, count);
    return status;
}

/* ---- grooves ---- */

/* The height of the tool's track at y. */
static double groove(const pe_machining_options *o, double y)
{
    double across = y - o->feed * floor(y / o->feed) - o->feed / 2;

    return o->kind == PE_TURNED ? across * across / (2 * o->radius) : o->slope * fabs(across);
}

static void add_grooves(const pe_machining_options *o, float *values)
{
    for (int y = 0; y < o->height; y++) {
        double z = groove(o, (y + 0.5) * o->pitch);

        for (int x = 0; x < o->width; x++)
            values[(size_t)y * (size_t)o->width + (size_t)x] += (float)z;
    }
}

pe_status pe_heights_machine(const pe_machining_options *options, pe_heights *heights, pe_error *error)
{
    pe_machining_options o = *options;
    pe_heights made;
    pe_status status = pe_machining_complete(&o, error);

    if (status != PE_OK)
        return status;
    made = (pe_heights){ .width = o.width, .height = o.height, .pitch = o.pitch };
    made.values = malloc((size_t)o.width * (size_t)o.height * sizeof(float));
    if (!made.values)
        return pe_fail_memory(error, "heights");
    status = make_rough(&o, made.values, error);
    if (status != PE_OK) {
        pe_heights_free(&made);
        return status;
    }
    if (o.kind == PE_TURNED || o.kind == PE_MILLED)
        add_grooves(&o, made.values);
    *heights = made;
    return PE_OK;
}
