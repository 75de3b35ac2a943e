/* test-progress.c - claims: a bake reports from its first step to its last, ever more; it never stays silent for long;
 * and it stops where it is told to, in whichever step, soon and with nothing left behind. */
#include "prefenv.h"
#include "reference.h"
#include "tap.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

typedef struct watch {
    int calls, falls;
    double first, last;         /* fractions */
    double begun, heard, quiet; /* processor seconds: at the start, at the last report, and the longest between two */
    int stop_at;                /* the call that is answered by a stop; 0: none */
} watch;

/* Of this thread, the only one. */
static double seconds(void)
{
    struct timespec now;

    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static int listen(double fraction, void *data)
{
    watch *w = data;
    double now = seconds();

    w->first = w->calls++ ? w->first : fraction;
    w->falls += fraction < w->last - 1e-12;
    w->last = fraction;
    w->quiet = fmax(w->quiet, now - w->heard);
    w->heard = now;
    return w->stop_at && w->calls >= w->stop_at;
}

static pe_status bake(const pe_env *env, const pe_bake_options *model, int stop_at, watch *w)
{
    pe_bake_options options = *model;
    pe_maps *maps = NULL;
    pe_error error = { PE_OK, "" };
    pe_status status;

    *w = (watch){ .begun = seconds(), .heard = seconds(), .stop_at = stop_at };
    options.progress = listen;
    options.progress_data = w;
    options.threads = 1;
    status = pe_bake(env, &options, &maps, &error);
    w->quiet = fmax(w->quiet, seconds() - w->heard);
    if (status == PE_ERROR_CANCELLED && (maps || strcmp(error.message, "cancelled") != 0))
        return PE_ERROR_FORMAT;
    pe_maps_free(maps);
    return status;
}

/* Two tenths of a second are not felt as waiting; where a sanitizer makes all slow, a tenth of the whole. */
static void test_bake(const char *name, const pe_env *env, pe_bake_options options)
{
    int stopped = 0, tried = 0, calls;
    double whole, slow;
    watch w;

    need(bake(env, &options, 0, &w) == PE_OK, "cannot bake");
    whole = seconds() - w.begun;
    slow = fmax(0.2, 0.1 * whole);
    calls = w.calls;
    ok(w.first <= 0.15 && fabs(w.last - 1) < 1e-9 && w.falls == 0, "%s: %d reports rise from %.3f to %.3f", name, calls,
       w.first, w.last);
    ok(w.quiet < slow, "%s: silent for %.3f s at most, of %.2f s", name, w.quiet, whole);
    for (int stop_at = 1; stop_at <= calls; stop_at += 1 + calls / 3, tried++)
        stopped += bake(env, &options, stop_at, &w) == PE_ERROR_CANCELLED && w.calls == stop_at;
    ok(stopped == tried, "%s: stopped %d times of %d, at whichever report", name, stopped, tried);
}

int main(void)
{
    float *rgb = reference_noise(256, 128, 5);
    pe_env *env;

    need(pe_env_create(256, 128, rgb, &env, NULL) == PE_OK, "no environment");
    free(rgb);
    test_bake("hemispheres by a kernel", env,
              (pe_bake_options){ .surface.ndf = { PE_NDF_BECKMANN, 0.03, 0.03, NULL }, .normals = 12 });
    test_bake("lat-long maps by way of them", env,
              (pe_bake_options){ .method = PE_METHOD_REPRESENTATIVE, .width = 200, .height = 100, .normals = 12 });
    test_bake("hemispheres light by light", env,
              (pe_bake_options){ .surface = { .ndf = { PE_NDF_GGX, 0.2, 0.2, NULL }, .weight = PE_WEIGHT_MICROFACET },
                                 .normals = 12 });
    test_bake("hemispheres for an error", env,
              (pe_bake_options){ .surface.ndf = { PE_NDF_BECKMANN, 0.3, 0.3, NULL }, .error = 0.002 });
    test_bake("a baseline map", env, (pe_bake_options){ .method = PE_METHOD_BASELINE, .width = 100, .height = 50 });
    pe_env_free(env);
    return done_testing();
}
