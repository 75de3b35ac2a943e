/* test-horizon.c - the share of Phong's lobe above the horizon is what is left of white surroundings. */
#include "../src/horizon.h"
#include "prefenv.h"
#include "tap.h"

#include <math.h>
#include <stdlib.h>

enum { WIDTH = 512, HEIGHT = 256 };

static pe_env *white(void)
{
    float *rgb = malloc(3 * sizeof *rgb * WIDTH * HEIGHT);
    pe_env *env = NULL;

    for (int i = 0; rgb && i < 3 * WIDTH * HEIGHT; i++)
        rgb[i] = 1;
    need(rgb && pe_env_create(WIDTH, HEIGHT, rgb, &env, NULL) == PE_OK, "no environment could be made");
    free(rgb);
    return env;
}

/* The greatest difference from pe_phong's sum over texels, for mirror directions from the horizon up. */
static double worst_difference(const pe_env *env, double exponent)
{
    const double r[3] = { 0.48, 0.6, 0.64 };
    const double across[3] = { 0.192, 0.64, -0.744 }; /* to r, and to no row or column */
    double worst = 0;

    for (int i = 0; i <= 20; i++) {
        double beta = i / 20.0 * 1.5707963, n[3], rgb[3], difference;

        for (int k = 0; k < 3; k++)
            n[k] = sin(beta) * r[k] + cos(beta) * across[k];
        pe_phong(env, exponent, PE_HORIZON_DARK, n, r, rgb);
        difference = fabs(rgb[1] - pe_visible_share(exponent, sin(beta)));
        worst = worst_of(worst, difference);
    }
    return worst;
}

int main(void)
{
    static const double exponents[] = { 0, 0.5, 1, 5, 20, 53, 300, 1000 };
    pe_env *env = white();
    double middle = 0;

    for (size_t i = 0; i < sizeof exponents / sizeof *exponents; i++) {
        double worst = worst_difference(env, exponents[i]);

        /* Texels are counted whole, which tells where the lobe is not much wider than they. */
        ok(worst < 0.0003 + 1e-5 * exponents[i], "exponent %g: as the sum over texels", exponents[i]);
        note("worst difference %.2g", worst);
        middle = worst_of(middle, fabs(pe_visible_share(exponents[i], 0) - 0.5));
    }
    ok(middle < 1e-12, "half of it where r lies in the surface");
    ok(fabs(pe_visible_share(0, 0.5) - 2.0 / 3) < 1e-9, "exponent 0: of the half circle, what stands above");
    ok(fabs(pe_visible_share(1, 0.5) - 0.75) < 1e-9, "exponent 1: (1 + sine) / 2");
    ok(pe_visible_share(5000, 0.2) == 1, "all of it away from the horizon");
    pe_env_free(env);
    return done_testing();
}
