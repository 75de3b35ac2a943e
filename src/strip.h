/* strip.h - several environments of one size, side by side in the lanes of a vector: a strip of film.
 *
 * Their lights stand at the same places, so that where these lie in a normal's tangent frame is worked out once for all
 * of them. */
#ifndef PE_STRIP_H
#define PE_STRIP_H

#include "disc.h"
#include "tiles.h"
#include "vector.h"

#define PE_STRIP_FRAMES 5
#define PE_STRIP_LANES 16 /* red, green and blue of each frame in turn, then the solid angle, which they share */
#define PE_STRIP_WEIGHT (PE_STRIP_LANES - 1)

typedef struct pe_strip {
    const pe_env *env[PE_STRIP_FRAMES]; /* of one size */
    int count;                          /* of frames; the lanes of those that are not there are 0 */
    pe_tiles tiles;
    float *lights; /* of every light of the tiles: radiance times solid angle, and solid angle */
    float *texels; /* and of every texel; where tiles are texels, the same */
} pe_strip;

/* Bytes of a strip of environments of this size, about. */
double pe_strip_bytes(int width, int height);

/* The environments must outlive the strip.  side_rad: as of pe_tiles_make. */
pe_status pe_strip_make(const pe_env *const *envs, int count, double side_rad, pe_strip *strip, pe_error *error);
void pe_strip_free(pe_strip *strip);

/* Adds the lights above the horizon of the frame's normal to zeroed cells of a disc, PE_STRIP_LANES floats each, 64
 * bytes aligned, as the splines of kernel.h ask.  Of a tile across the horizon the texels above are lights of their
 * own, so that nothing from behind the surface counts. */
void pe_strip_spread(const pe_strip *strip, const pe_frame *frame, const pe_disc *cells, float *to);

#endif
