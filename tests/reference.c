/* reference.c - the naive truth, see reference.h. */
#include "reference.h"

#include <complex.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void unit(double a[3])
{
    double length = sqrt(dot(a, a));

    for (int c = 0; c < 3; c++)
        a[c] /= length;
}

void reference_direction(int width, int height, int x, int y, double direction[3], double *theta)
{
    double phi = 2 * M_PI * (x + 0.5) / width;

    *theta = M_PI * (y + 0.5) / height;
    direction[0] = sin(*theta) * cos(phi);
    direction[1] = cos(*theta);
    direction[2] = sin(*theta) * sin(phi);
}

double reference_beckmann(double alpha_x, double alpha_y, const double h[3], const double t[3], const double b[3],
                          const double n[3])
{
    double cos_theta = dot(h, n), theta, phi;

    if (cos_theta <= 0)
        return 0;
    theta = acos(cos_theta < 1 ? cos_theta : 1);
    phi = atan2(dot(h, b), dot(h, t));
    return exp(-pow(tan(theta), 2) * (pow(cos(phi) / alpha_x, 2) + pow(sin(phi) / alpha_y, 2))) /
           (M_PI * alpha_x * alpha_y * pow(cos_theta, 4));
}

/* GGX as in Walter et al. 2007 (Eq. 33), stretched along the tangents; Phong as in Ashikhmin and Shirley 2000 (Eq. 7),
 * whose exponents n_u, n_v count the cosine that D is multiplied with here: n_u = 2 / alpha_x^2 - 1. */
double reference_density(int kind, double alpha_x, double alpha_y, const double h[3], const double t[3],
                         const double b[3], const double n[3])
{
    double cos_theta = dot(h, n), theta, phi, n_u = 2 / (alpha_x * alpha_x) - 1, n_v = 2 / (alpha_y * alpha_y) - 1;
    double stretched;

    if (cos_theta <= 0)
        return 0;
    if (kind == 0)
        return reference_beckmann(alpha_x, alpha_y, h, t, b, n);
    theta = acos(cos_theta < 1 ? cos_theta : 1);
    phi = atan2(dot(h, b), dot(h, t));
    if (kind == 2)
        return sqrt((n_u + 1) * (n_v + 1)) / (2 * M_PI) *
               pow(cos_theta, n_u * pow(cos(phi), 2) + n_v * pow(sin(phi), 2) - 1);
    stretched = pow(tan(theta), 2) * (pow(cos(phi) / alpha_x, 2) + pow(sin(phi) / alpha_y, 2));
    return 1 / (M_PI * alpha_x * alpha_y * pow(cos_theta, 4) * pow(1 + stretched, 2));
}

void reference_reflection(const float *rgb, int width, int height, double alpha_x, double alpha_y, const double d[3],
                          const double n[3], const double o[3], double out[3])
{
    reference_reflection_of(0, rgb, width, height, alpha_x, alpha_y, d, n, o, out);
}

void reference_reflection_of(int kind, const float *rgb, int width, int height, double alpha_x, double alpha_y,
                             const double d[3], const double n[3], const double o[3], double out[3])
{
    double along = dot(d, n), sum = 0, t[3], b[3];

    for (int c = 0; c < 3; c++) {
        t[c] = d[c] - along * n[c];
        out[c] = 0;
    }
    unit(t);
    b[0] = n[1] * t[2] - n[2] * t[1];
    b[1] = n[2] * t[0] - n[0] * t[2];
    b[2] = n[0] * t[1] - n[1] * t[0];
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            double w[3], h[3], theta, weight;

            reference_direction(width, height, x, y, w, &theta);
            if (dot(w, n) <= REFERENCE_HORIZON)
                continue;
            for (int c = 0; c < 3; c++)
                h[c] = o[c] + w[c];
            unit(h);
            weight = reference_density(kind, alpha_x, alpha_y, h, t, b, n) * sin(theta);
            sum += weight;
            for (int c = 0; c < 3; c++)
                out[c] += weight * (double)rgb[3 * (y * width + x) + c];
        }
    for (int c = 0; c < 3; c++)
        out[c] /= sum;
}

/* ---- microfacets ---- */

double reference_reflectance(double eta, double k, double cosine)
{
    double complex index = eta + k * I, inside;
    double s, p;

    if (eta == 0 && k == 0)
        return 1;
    inside = csqrt(1 - (1 - cosine * cosine) / (index * index));
    s = pow(cabs((cosine - index * inside) / (cosine + index * inside)), 2);
    p = pow(cabs((index * cosine - inside) / (index * cosine + inside)), 2);
    return (s + p) / 2;
}

/* Heitz 2014, Eq. 68 and 72, of a = 1 / (alpha_phi tan(theta)). */
static double lambda(int kind, double alpha_x, double alpha_y, const double v[3], const double t[3], const double b[3],
                     const double n[3])
{
    double theta = acos(fmin(dot(v, n), 1)), phi = atan2(dot(v, b), dot(v, t)), a;

    if (theta < 1e-9)
        return 0;
    a = 1 / (hypot(alpha_x * cos(phi), alpha_y * sin(phi)) * tan(theta));
    return kind == 0 ? (erf(a) - 1) / 2 + exp(-a * a) / (2 * a * sqrt(M_PI)) : (sqrt(1 + 1 / (a * a)) - 1) / 2;
}

double reference_microfacet(int kind, double alpha_x, double alpha_y, double eta, double k, const double o[3],
                            const double w[3], const double t[3], const double b[3], const double n[3])
{
    double h[3] = { o[0] + w[0], o[1] + w[1], o[2] + w[2] }, masking;

    unit(h);
    masking = 1 + lambda(kind, alpha_x, alpha_y, o, t, b, n) + lambda(kind, alpha_x, alpha_y, w, t, b, n);
    return reference_density(kind, alpha_x, alpha_y, h, t, b, n) * reference_reflectance(eta, k, dot(o, h)) /
           (4 * dot(o, n) * masking);
}

double reference_furnace(int kind, double alpha_x, double alpha_y, double eta, double k, const double o[3], int side)
{
    static const double t[3] = { 1, 0, 0 }, b[3] = { 0, 1, 0 }, n[3] = { 0, 0, 1 };
    double sum = 0;

    for (int i = 0; i < side; i++)
        for (int j = 0; j < side; j++) {
            double theta = M_PI / 2 * (i + 0.5) / side, phi = 2 * M_PI * (j + 0.5) / side;
            double w[3] = { sin(theta) * cos(phi), sin(theta) * sin(phi), cos(theta) };

            sum += sin(theta) * reference_microfacet(kind, alpha_x, alpha_y, eta, k, o, w, t, b, n);
        }
    return sum * M_PI / 2 / side * 2 * M_PI / side;
}

void reference_scattering(int kind, const float *rgb, int width, int height, double alpha_x, double alpha_y,
                          const double eta[3], const double k[3], const double d[3], const double n[3],
                          const double o[3], double out[3])
{
    double along = dot(d, n), t[3], b[3];

    for (int c = 0; c < 3; c++) {
        t[c] = d[c] - along * n[c];
        out[c] = 0;
    }
    unit(t);
    b[0] = n[1] * t[2] - n[2] * t[1];
    b[1] = n[2] * t[0] - n[0] * t[2];
    b[2] = n[0] * t[1] - n[1] * t[0];
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            double w[3], theta, area = 2 * M_PI * M_PI / ((double)width * height);

            reference_direction(width, height, x, y, w, &theta);
            for (int c = 0; c < 3 && dot(w, n) > REFERENCE_HORIZON; c++)
                out[c] += area * sin(theta) * (double)rgb[3 * (y * width + x) + c] *
                          reference_microfacet(kind, alpha_x, alpha_y, eta[c], k[c], o, w, t, b, n);
        }
}

/* ---- environments ---- */

float *reference_constant(int width, int height, float value)
{
    float *rgb = malloc(3 * sizeof *rgb * (size_t)width * (size_t)height);

    for (int k = 0; k < 3 * width * height; k++)
        rgb[k] = value;
    return rgb;
}

float *reference_noise(int width, int height, unsigned seed)
{
    float *rgb = reference_constant(width, height, 0);

    for (int k = 0; k < 3 * width * height; k++)
        rgb[k] = (float)reference_random(&seed);
    return rgb;
}

float *reference_lit_texel(int width, int height, int x, int y, float value)
{
    float *rgb = reference_constant(width, height, 0);

    for (int c = 0; c < 3; c++)
        rgb[3 * (y * width + x) + c] = value;
    return rgb;
}

/* A channel of each texel as a function of its direction w and of n. */
static float *from_directions(int width, int height,
                              double (*radiance)(const double w[3], const double n[3], int channel), const double n[3])
{
    float *rgb = reference_constant(width, height, 0);

    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            double w[3], theta;

            reference_direction(width, height, x, y, w, &theta);
            for (int c = 0; c < 3; c++)
                rgb[3 * (y * width + x) + c] = (float)radiance(w, n, c);
        }
    return rgb;
}

static double half_white(const double w[3], const double n[3], int channel)
{
    (void)channel;
    return dot(w, n) > 0;
}

static double gradient(const double w[3], const double n[3], int channel)
{
    (void)n;
    return pow(1 + w[channel], 2);
}

float *reference_half_white(int width, int height, const double n[3])
{
    return from_directions(width, height, half_white, n);
}

float *reference_gradient(int width, int height)
{
    return from_directions(width, height, gradient, NULL);
}

float *reference_room(int width, int height)
{
    static const double lamps[4][3] = { { 1, 1, 0.3 }, { -0.5, 0.4, 1 }, { 0.2, 0.9, -0.8 }, { -1, -0.1, -0.4 } };
    float *rgb = reference_constant(width, height, 0);

    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            float *texel = rgb + 3 * (y * width + x);
            double w[3], theta;

            reference_direction(width, height, x, y, w, &theta);
            for (int c = 0; c < 3; c++) {
                texel[c] = (float)(w[1] > 0 ? 0.3 + 0.2 * w[1] * c : 0.1 + 0.05 * sin(9 * w[c]));
                for (int lamp = 0; lamp < 4; lamp++) {
                    double toward[3];

                    memcpy(toward, lamps[lamp], sizeof toward);
                    unit(toward);
                    texel[c] += dot(toward, w) > 0.97 ? (float)(3 + lamp - c) : 0;
                }
            }
        }
    return rgb;
}

/* PCG-XSH-RR's smaller sibling (O'Neill 2014): 32 bits of state are plenty for a test. */
double reference_random(unsigned *state)
{
    unsigned word;

    *state = *state * 747796405u + 2891336453u;
    word = ((*state >> ((*state >> 28) + 4)) ^ *state) * 277803737u;
    return ((word >> 22) ^ word) / 4294967296.0;
}

void reference_random_direction(unsigned *state, double direction[3])
{
    double y = 2 * reference_random(state) - 1, phi = 2 * M_PI * reference_random(state), r = sqrt(1 - y * y);

    direction[0] = r * cos(phi);
    direction[1] = y;
    direction[2] = r * sin(phi);
}
