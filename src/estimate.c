/* estimate.c - how far baked maps are from the exact ones: some of what they show done again with every light. */
#include "estimate.h"

#include "baseline.h"
#include "filter.h"
#include "parallel.h"
#include "sequence.h"
#include "status.h"
#include "vector.h"

#include <stdlib.h>

#define FRAMES 12            /* normals looked at; of a baseline map, where each texel has its own, texels */
#define POINTS_PER_FRAME 128 /* texels for each */
#define LOOKUP_FRAMES 48     /* normals looked at for lookups: few would miss the lamps that make most of the error */
#define TRIALS_MAX PE_ESTIMATE_FRAMES
#define VIEWERS_PER_FRAME 128
#define COSINE_MIN 0.15
#define LIMIT 20.0 /* exp(-20) is 2e-9: what is beyond changes nothing that is shown */

/* One normal, the views chosen for it, and what came out. */
typedef struct trial {
    const pe_cloud *cloud;
    const pe_lobe *lobe;
    const pe_maps *maps;
    const pe_head_on *head_on; /* NULL for maps of representative normals */
    int index, count;          /* of so many normals */
    double roughness;          /* of maps of grades */
    double share;              /* of the whole, that each of its views stands for */
    double error2, norm2;
    int failed;
} trial;

static const double middle[2] = { 0.5, 0.5 };

/* Adds the squared difference of what is shown towards `world` from what `sums` give. */
static void compare(trial *t, const double world[3], const float o[3], const double shown[3], const double sums[4])
{
    double exact[3];

    pe_filter_radiance(t->lobe, t->cloud->env, sums, world, o, exact);
    for (int c = 0; c < 3; c++) {
        double difference = shown[c] - exact[c];

        t->error2 += t->share * difference * difference;
        t->norm2 += t->share * exact[c] * exact[c];
    }
}

/* The same for what the viewer o, in the frame's coordinates, sees. */
static void compare_view(trial *t, const pe_frame *frame, const pe_lights *lights, const float o[1][3],
                         const double shown[3])
{
    const double r[3] = { -(double)o[0][0], -(double)o[0][1], (double)o[0][2] };
    double world[3], sums[1][4];

    pe_frame_direction(frame, r, world);
    pe_filter_points(t->lobe, lights, o, 1, sums);
    compare(t, world, o[0], shown, sums[0]);
}

/* The texel of a trial's point k: evenly spread for any number of points. */
static void place_texel(const trial *t, int k, int *x, int *y)
{
    double point[2];

    pe_lattice_point(t->index * POINTS_PER_FRAME + k, middle, point);
    *x = (int)(point[0] * t->maps->info.width);
    *y = (int)(point[1] * t->maps->info.height);
}

/* ---- texels of lat-long maps ---- */

static void try_texels(trial *t, int image, const pe_frame *frame, const pe_lights *lights)
{
    for (int k = 0; k < POINTS_PER_FRAME; k++) {
        double world[3], shown[3];
        const float *texel;
        float o[1][3];
        int x, y;

        place_texel(t, k, &x, &y);
        pe_grid_direction(&t->maps->grid, x, y, world);
        if (!(pe_dot(frame->n, world) > COSINE_MIN))
            continue;
        pe_mirror_viewer(frame, world, o[0]);
        texel = pe_maps_image(t->maps, image) + 3 * (y * t->maps->info.width + x);
        for (int c = 0; c < 3; c++)
            shown[c] = (double)texel[c];
        compare_view(t, frame, lights, (const float(*)[3])o, shown);
    }
}

/* ---- lookups in hemispheres ---- */

static void try_lookup(trial *t, const pe_frame *frame, const pe_lights *lights, const double local[3])
{
    const float o[1][3] = { { (float)local[0], (float)local[1], (float)local[2] } };
    pe_point point = { .n = { frame->n[0], frame->n[1], frame->n[2] },
                       .direction = frame->t,
                       .roughness = t->roughness };
    double shown[3];

    if (!(local[2] > COSINE_MIN))
        return;
    pe_frame_direction(frame, local, point.o);
    pe_sample(t->maps, NULL, &point, shown);
    compare_view(t, frame, lights, o, shown);
}

/* Texels of a hemisphere, its suns with them: where splines and interpolation change nothing. */
static void try_own_texels(trial *t, const pe_frame *frame, const pe_lights *lights)
{
    for (int k = 0; k < POINTS_PER_FRAME; k++) {
        double local[3] = { 0, 0, 0 };
        int x, y;

        place_texel(t, k, &x, &y);
        if (pe_disc_direction(&t->maps->disc, x, y, local))
            try_lookup(t, frame, lights, local);
    }
}

/* As many viewers from everywhere see a surface: their solid angle times its cosine. */
static void try_viewers(trial *t, const pe_frame *frame, const pe_lights *lights)
{
    for (int k = 0; k < VIEWERS_PER_FRAME; k++) {
        double point[2], local[3];

        pe_lattice_point(t->index * VIEWERS_PER_FRAME + k, middle, point);
        local[0] = sqrt(point[0]) * cos(2 * M_PI * point[1]);
        local[1] = sqrt(point[0]) * sin(2 * M_PI * point[1]);
        local[2] = sqrt(1 - point[0]);
        try_lookup(t, frame, lights, local);
    }
}

/* ---- trials ---- */

static void try_frame(trial *t, const double n[3], const double brush[3], pe_frame *frame, pe_lights *lights)
{
    pe_frame_make(n, brush, frame);
    pe_lights_fill(t->cloud, t->lobe, frame, pe_lobe_reach(t->lobe, LIMIT), lights);
}

/* A representative normal. */
static void try_normal(trial *t, pe_lights *lights)
{
    int vertex = (int)((long long)t->index * pe_geodesic_count(t->maps->geodesic) / FRAMES);
    pe_frame frame;

    try_frame(t, pe_geodesic_vertex(t->maps->geodesic, vertex), t->maps->info.direction, &frame, lights);
    if (t->maps->info.method == PE_METHOD_HEMISPHERES)
        try_own_texels(t, &frame, lights);
    else
        try_texels(t, vertex / 2, &frame, lights);
}

/* About the two normals along the brush, tangents turn fast, and the maps of an anisotropic lobe differ most: a quarter
 * of the frames lie there, and count by their area. */
#define CAP_COSINE 0.95

static int is_in_cap(const trial *t)
{
    return t->index < t->count / 4;
}

static void any_normal(const trial *t, double point[2], double n[3])
{
    static const double origin[3] = { 0, 0, 1 };
    double along = 2 * point[0] - 1, across, axis[3];
    pe_frame frame;

    along = is_in_cap(t) ? copysign(1 - fabs(along) * (1 - CAP_COSINE), along) : along * CAP_COSINE;
    across = sqrt(1 - along * along);
    pe_normalize_any(t->maps->info.direction, axis);
    pe_frame_make(axis, origin, &frame);
    pe_frame_direction(
        &frame, (const double[3]){ across * cos(2 * M_PI * point[1]), across * sin(2 * M_PI * point[1]), along }, n);
}

/* Any normal: evenly over the sphere. */
static void try_any_normal(trial *t, pe_lights *lights)
{
    int cap = t->count / 4;
    double point[2], n[3];
    pe_frame frame;

    t->share = is_in_cap(t) ? (1 - CAP_COSINE) / cap : CAP_COSINE / (t->count - cap);
    pe_lattice_point(is_in_cap(t) ? t->index : t->index - cap, middle, point);
    any_normal(t, point, n);
    if (t->maps->info.angles > 1)
        try_frame(t, n, (const double[3]){ n[1], n[2], n[0] }, &frame, lights); /* any brush will do, none is special */
    else
        try_frame(t, n, t->maps->info.direction, &frame, lights);
    try_viewers(t, &frame, lights);
}

/* Of a baseline map, each texel has its own frame. */
static void try_baseline(trial *t)
{
    static const float head_on[3] = { 0, 0, 1 };

    for (int k = 0; k < POINTS_PER_FRAME / FRAMES && !t->failed; k++) {
        double world[1][3], sums[1][4], shown[3];
        const float *texel;
        int x, y;

        place_texel(t, k, &x, &y);
        texel = pe_maps_image(t->maps, 0) + 3 * (y * t->maps->info.width + x);
        for (int c = 0; c < 3; c++)
            shown[c] = (double)texel[c];
        pe_grid_direction(&t->maps->grid, x, y, world[0]);
        t->failed = pe_head_on_filter(t->head_on, (const double(*)[3])world, 1, sums, NULL) != PE_OK;
        if (!t->failed)
            compare(t, world[0], head_on, shown, sums[0]);
    }
}

typedef void trial_task(trial *t, pe_lights *lights);

static void with_lights(trial *t, trial_task *try_it)
{
    pe_lights lights;

    t->failed = pe_lights_allocate(t->cloud, &lights, NULL) != PE_OK;
    if (t->failed)
        return;
    try_it(t, &lights);
    pe_lights_free(&lights);
}

static void run_texels(size_t index, void *data)
{
    trial *t = (trial *)data + index;

    if (t->maps->geodesic)
        with_lights(t, try_normal);
    else
        try_baseline(t);
}

static void run_lookups(size_t index, void *data)
{
    with_lights((trial *)data + index, try_any_normal);
}

/* What runs them, and who is told. */
typedef struct how {
    int threads;
    pe_report *report;
} how;

/* Runs `count` trials that are told apart and adds up what comes of them. */
static pe_status run_all(trial *trials, int count, pe_task *run, const how *h, pe_estimate *sum, pe_error *error)
{
    pe_status status = pe_parallel_for((size_t)count, h->threads, run, trials, h->report);

    if (status != PE_OK)
        return status;
    h->report->done += count;
    for (int k = 0; k < count; k++) {
        if (trials[k].failed)
            return pe_fail_memory(error, "the estimate of the error");
        sum->error2 += trials[k].error2;
        sum->norm2 += trials[k].norm2;
    }
    return PE_OK;
}

static pe_status run_trials(const trial *model, pe_task *run, int count, const how *h, double *estimate,
                            pe_error *error)
{
    trial trials[TRIALS_MAX];
    pe_estimate sum = { 0, 0 };
    pe_status status;

    for (int k = 0; k < count; k++) {
        trials[k] = *model;
        trials[k].index = k;
        trials[k].count = count;
        trials[k].share = 1;
    }
    status = run_all(trials, count, run, h, &sum, error);
    if (status == PE_OK)
        *estimate = sum.norm2 > 0 ? sqrt(sum.error2 / sum.norm2) : 0;
    return status;
}

static pe_status estimate_texels(const pe_cloud *cloud, pe_maps *maps, const pe_lobe *lobe, const how *h,
                                 pe_error *error)
{
    trial model = { .cloud = cloud, .lobe = lobe, .maps = maps };
    pe_head_on *head_on = NULL;
    pe_status status = PE_OK;

    if (!maps->geodesic)
        status =
            pe_head_on_make(cloud, lobe, maps->info.direction, pe_lobe_reach(lobe, PE_LOBE_CUTOFF), &head_on, error);
    model.head_on = head_on;
    if (status == PE_OK)
        status = run_trials(&model, run_texels, FRAMES, h, &maps->info.error_estimate, error);
    pe_head_on_free(head_on);
    return status;
}

/* An environment that was shrunk has its suns in the middle of their texels; in truth they are where the maps say. */
static void place_suns(const pe_suns *suns, pe_cloud *cloud)
{
    for (int k = 0; k < suns->count; k++) {
        const double *d = suns->direction[k];
        double nearest = -2;
        size_t sun = 0;

        for (size_t light = 0; light < cloud->count; light++) {
            double cosine = d[0] * cloud->x[light] + d[1] * cloud->y[light] + d[2] * cloud->z[light];

            sun = cosine > nearest ? light : sun;
            nearest = fmax(nearest, cosine);
        }
        cloud->x[sun] = d[0];
        cloud->y[sun] = d[1];
        cloud->z[sun] = d[2];
    }
}

pe_status pe_estimate_errors(const pe_env *env, pe_maps *maps, const pe_lobe *lobe, int threads, pe_report *report,
                             pe_error *error)
{
    int is_exact = maps->info.accuracy == PE_ACCURACY_EXACT, has_lookups = maps->info.method == PE_METHOD_HEMISPHERES;
    const how h = { threads, report };
    pe_cloud cloud;
    pe_status status = PE_OK;

    if (is_exact && !has_lookups)
        return PE_OK;
    status = pe_cloud_from_env(env, &cloud, error);
    if (status != PE_OK)
        return status;
    place_suns(&maps->suns, &cloud);
    report->done = 0;
    report->total = (is_exact ? 0 : FRAMES) + (has_lookups ? LOOKUP_FRAMES : 0);
    if (!is_exact)
        status = estimate_texels(&cloud, maps, lobe, &h, error);
    if (status == PE_OK && has_lookups) {
        const trial model = { .cloud = &cloud, .lobe = lobe, .maps = maps };

        status = run_trials(&model, run_lookups, LOOKUP_FRAMES, &h, &maps->info.lookup_error, error);
    }
    pe_cloud_free(&cloud);
    return status;
}

pe_status pe_estimate_texels(const pe_env *env, pe_maps *maps, const pe_lobe *lobe, int threads, pe_error *error)
{
    pe_report silent = { .total = FRAMES };
    const how h = { threads, &silent };
    pe_cloud cloud;
    pe_status status = PE_OK;

    if (maps->info.accuracy == PE_ACCURACY_EXACT)
        return PE_OK;
    status = pe_cloud_from_env(env, &cloud, error);
    if (status != PE_OK)
        return status;
    status = estimate_texels(&cloud, maps, lobe, &h, error);
    pe_cloud_free(&cloud);
    return status;
}

/* ---- grades ---- */

/* Roughnesses go through their range in another order than normals over the sphere: within the caps, and elsewhere. */
#define STRIDE 7 /* has no divisor in common with the frames of either */

static double place_of(const trial *t)
{
    int cap = t->count / 4, count = is_in_cap(t) ? cap : t->count - cap;
    int k = is_in_cap(t) ? t->index : t->index - cap;

    return (STRIDE * k % count + 0.5) / count * (t->maps->info.grades - 1);
}

/* Each has a lobe of its own. */
static void run_rough_lookups(size_t index, void *data)
{
    trial *t = (trial *)data + index;
    pe_surface surface;
    pe_lobe *lobe;

    pe_maps_surface(t->maps, t->roughness, &surface);
    t->failed = pe_lobe_make(&surface, 1, &lobe, NULL) != PE_OK;
    if (t->failed)
        return;
    t->lobe = lobe;
    with_lights(t, try_any_normal);
    pe_lobe_free(lobe);
}

static int choose_trials(const trial *model, int grade, trial *trials)
{
    int count = 0;

    for (int k = 0; k < PE_ESTIMATE_FRAMES; k++) {
        trial *t = &trials[count];

        *t = *model;
        t->index = k;
        t->count = PE_ESTIMATE_FRAMES;
        t->roughness = pe_grades_alpha(&t->maps->info, place_of(t));
        count += lround(place_of(t)) == grade;
    }
    return count;
}

pe_status pe_estimate_grade(const pe_env *env, const pe_maps *maps, int grade, int threads, pe_report *report,
                            pe_estimate *sum, pe_error *error)
{
    const how h = { threads, report };
    trial trials[TRIALS_MAX + 1];
    pe_cloud cloud;
    pe_status status = pe_cloud_from_env(env, &cloud, error);
    const trial model = { .cloud = &cloud, .maps = maps };

    if (status != PE_OK)
        return status;
    place_suns(&maps->suns, &cloud);
    status = run_all(trials, choose_trials(&model, grade, trials), run_rough_lookups, &h, sum, error);
    pe_cloud_free(&cloud);
    return status;
}
