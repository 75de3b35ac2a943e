/* horizon.c - how much of Phong's lobe a surface lets through: the n.l test of [Okumura Eq. 2] on even light.
 *
 * Let r stand at the angle beta above the horizon, in the plane of r and n.  A light w at the angle v out of that
 * plane, its part in the plane at the angle u from r towards n, has r.w = cos u cos v and w.n = cos v sin(u + beta): it
 * is above the horizon where u > -beta, whatever v.  As dw = cos v dv du, the integral over v is the same for every u:
 *
 *     share = integral of cos^Lambda u du from -beta to pi/2, by the same from -pi/2. */
#include "horizon.h"

#include <math.h>

#define HALF_PI 1.57079632679489661923

/* Where cos^Lambda is below e^-REACH, so small a tail of the lobe is not to be seen. */
#define REACH 20.0

/* The points and weights of Gauss and Legendre's rule of 16, half of them: the others are their mirror images. */
static const double places[8] = { 0.0950125098376374, 0.2816035507792589, 0.4580167776572274, 0.6178762444026438,
                                  0.7554044083550030, 0.8656312023878318, 0.9445750230732326, 0.9894009349916499 };
static const double shares[8] = { 0.1894506104550685, 0.1826034150449236, 0.1691565193950025, 0.1495959888165767,
                                  0.1246289712555339, 0.0951585116824928, 0.0622535239386479, 0.0271524594117541 };

/* The integral of cos^exponent. */
static double lobe_between(double exponent, double from, double to)
{
    double middle = (from + to) / 2, half = (to - from) / 2, sum = 0;

    for (int i = 0; i < 8; i++) {
        sum += shares[i] * pow(cos(middle - half * places[i]), exponent);
        sum += shares[i] * pow(cos(middle + half * places[i]), exponent);
    }
    return half * sum;
}

double pe_visible_share(double exponent, double cosine)
{
    double least = exponent > 0 ? exp(-REACH / exponent) : 0; /* cosine of the angle where the lobe ends */
    double sine = cosine < 1 ? cosine : 1;                    /* of beta */
    double beta, end;

    if (sine <= 0)
        return 0.5;
    if (1 - sine * sine <= least * least)
        return 1;
    beta = asin(sine);
    end = acos(least);
    end = end < HALF_PI ? end : HALF_PI;
    return 1 - lobe_between(exponent, beta, end) / (2 * lobe_between(exponent, 0, end));
}
