/* horizon.h - how much of a lobe a surface lets through. */
#ifndef PE_HORIZON_H
#define PE_HORIZON_H

/* The share of Phong's lobe about r, cos^Lambda, that lies above a surface whose normal has this cosine to r, in
 * [0, 1]: what is left of even light once that from below the horizon is hidden. */
double pe_visible_share(double exponent, double cosine);

#endif
