/* surface.h - what a surface reflects, beside its normal distribution: reflectance and albedo. */
#ifndef PE_SURFACE_H
#define PE_SURFACE_H

#include "prefenv.h"

/* The cosine above which a light is above the horizon, in production and in truth alike.  Below it there is only
 * rounding: texels that lie on the horizon itself, on neither side. */
#define PE_HORIZON 1e-9

/* Fresnel's reflectance of unpolarised light by a conductor of index eta + i k, at the cosine of the angle of
 * incidence. 1 where both are 0. */
double pe_reflectance(double eta, double k, double cosine);

/* The share of D G2 / (4 cos theta_o) that goes to lights above the horizon: what the viewer o (unit, tangent frame,
 * above the surface) sees in a white furnace if F is 1.  By quadrature over the slopes, side * side of them. */
double pe_directional_albedo(const pe_ndf *ndf, const double o[3], int side);

#endif
