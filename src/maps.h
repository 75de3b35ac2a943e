/* maps.h - inside a set of maps. */
#ifndef PE_MAPS_H
#define PE_MAPS_H

#include "denominator.h"
#include "disc.h"
#include "env.h"
#include "geodesic.h"
#include "poles.h"
#include "prefenv.h"
#include "suns.h"
#include "vector.h"

#define PE_MAPS_FORMAT_VERSION 4
#define PE_MAPS_FORMAT_VERSION_MIN 2 /* which has no layers and no voxels; 3 has no grades */
#define PE_MAPS_SIDE_MAX 8192
#define PE_MAPS_ANGLES_MIN 4 /* unless 1 */
#define PE_MAPS_ANGLES_MAX 64
#define PE_MAPS_TEXELS_MAX PE_IMAGE_TEXELS_MAX /* of all images together, as they are stored: 1.5 GiB of floats */

#define PE_LAYER_WIDTH_MIN 32

/* A lat-long picture of one roughness. */
typedef struct pe_layer {
    double exponent;
    int width, height;
    size_t offset; /* in rgb */
    float *coefficients;
} pe_layer;

struct pe_maps {
    pe_maps_info info;
    char *source_name, *ndf_name;
    pe_geodesic *geodesic; /* NULL for baseline */
    pe_grid grid;          /* lat-long: directions of the images' texels */
    float *rgb;            /* images, one after the other */

    /* Hemispheres. */
    pe_disc disc;
    pe_suns suns;
    pe_poles poles;                     /* none unless info.pole_angles */
    float (*frames)[3][4];              /* of every vertex: t, b, n along the world's x, y, z, and a 0 */
    float turns[PE_MAPS_ANGLES_MAX][2]; /* cosine and sine of every angle */
    float *coefficients;                /* cubic splines through the images; one float more at the end */
    pe_denominator *denominator;        /* NULL where there are no suns */

    pe_layer *layers; /* as many as there are images */

    pe_maps **grades; /* info.grades hemispheres: none of the above is used but the suns, which are theirs */
};

/* What maps say of the environment that they are made of, but for its size.  The name stays the environment's. */
void pe_maps_set_source(pe_maps_info *info, const pe_env *env);

/* As files and people call them: by pe_method, whose default has none, and by pe_ndf_kind. */
#define PE_METHOD_NAMES \
    { \
        "", "hemispheres", "representative", "baseline", "layers", "voxels", "grades" \
    }
#define PE_NDF_NAMES \
    { \
        "beckmann", "ggx", "phong", "table" \
    }

/* ---- layers ---- */

/* Does info's method hold Phong's lobe of many roughnesses? */
static inline int pe_method_has_lambda(pe_method method)
{
    return method == PE_METHOD_LAYERS || method == PE_METHOD_VOXELS;
}

/* Layer k: its exponent and its size follow from info's smoothness, number and size. */
pe_layer pe_layer_of(const pe_maps_info *info, int k);

/* Where an exponent lies among the layers, from 0 to the last. */
double pe_layer_place(const pe_maps_info *info, double exponent);

pe_status pe_layers_make(pe_maps *maps, pe_error *error);
pe_status pe_layers_finish(pe_maps *maps, int threads, pe_error *error);
void pe_layers_free(pe_maps *maps);

/* ---- grades ---- */

#define PE_GRADES_MIN 4
#define PE_GRADES_MAX 32

/* The distribution of a roughness, alpha_x, of grades from the smoothest to alpha_max; what is out of range is as the
 * nearer end. */
pe_ndf pe_grades_ndf(const pe_ndf *smoothest, double alpha_max, double alpha);

/* Where that lies among the grades, from 0 to the last; and the roughness at a place. */
double pe_grades_place(const pe_maps_info *info, double alpha);
double pe_grades_alpha(const pe_maps_info *info, double place);

pe_status pe_grades_check(const pe_maps_info *info, pe_error *error);

/* Maps of grades, all of them allocated; `each` says of every grade its normals, size and angles at the poles. */
pe_status pe_grades_create(const pe_maps_info *info, const pe_maps_info *each, pe_maps **out, pe_error *error);

/* Those that are finished already stay as they are. */
pe_status pe_grades_finish(pe_maps *maps, int threads, pe_error *error);

/* The grade that holds image *k, which becomes its number there; of maps without grades, themselves. */
const pe_maps *pe_grades_find(const pe_maps *maps, int *k);

/* Checks info's method, surface, direction, normals, angles and size; completes frequency and images; of layers and
 * grades images is given. */
pe_status pe_maps_complete_info(pe_maps_info *info, pe_error *error);

/* Does that and allocates the images. */
pe_status pe_maps_create(const pe_maps_info *info, pe_maps **out, pe_error *error);

/* To be called when the images and the suns are there and before anything is looked up. */
pe_status pe_maps_finish(pe_maps *maps, int threads, pe_error *error);

/* What the angles of brush directions divide: half a turn, after which a closed form is the same again, or, of what was
 * measured, a whole one. */
static inline double pe_maps_turn(const pe_maps_info *info)
{
    return info->surface.ndf.kind == PE_NDF_TABLE ? 2 * M_PI : M_PI;
}

/* Hemispheres: for how many brush angles there are images of a vertex. */
static inline int pe_maps_angles_at(const pe_maps *maps, int vertex)
{
    if (maps->info.angles > 1 || !maps->poles.count || maps->poles.ranks[vertex] < 0)
        return maps->info.angles;
    return maps->info.pole_angles;
}

/* Their numbers: each vertex's angles one after the other; or angle 0 of all vertices, then the rest of those at the
 * poles. */
static inline int pe_maps_image_at(const pe_maps *maps, int vertex, int angle)
{
    if (maps->info.angles > 1)
        return vertex * maps->info.angles + angle;
    if (angle == 0)
        return vertex;
    return maps->info.normals + maps->poles.ranks[vertex] * (maps->info.pole_angles - 1) + angle - 1;
}

/* The reverse. */
static inline void pe_maps_place_of(const pe_maps *maps, int image, int *vertex, int *angle)
{
    int extra = image - maps->info.normals, extras = maps->info.pole_angles - 1;

    if (maps->info.angles > 1) {
        *vertex = image / maps->info.angles;
        *angle = image % maps->info.angles;
    } else {
        *vertex = extra < 0 ? image : maps->poles.vertices[extra / extras];
        *angle = extra < 0 ? 0 : 1 + extra % extras;
    }
}

/* The tangent frame of image k of hemispheres: its vertex's, turned about the normal by its angle. */
void pe_maps_frame(const pe_maps *maps, int k, pe_frame *frame);

static inline size_t pe_maps_image_values(const pe_maps *maps)
{
    return 3 * (size_t)maps->info.width * (size_t)maps->info.height;
}

/* Of maps without grades. */
static inline float *pe_maps_image_to_fill(pe_maps *maps, int k)
{
    return maps->rgb + (maps->layers ? maps->layers[k].offset : (size_t)k * pe_maps_image_values(maps));
}

/* Texels of all images, as a file holds them. */
size_t pe_maps_stored_texels(const pe_maps_info *info);

/* Floats of all images. */
size_t pe_maps_values(const pe_maps *maps);

#endif
