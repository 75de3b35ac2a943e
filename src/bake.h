/* bake.h - inside a baker. */
#ifndef PE_BAKE_H
#define PE_BAKE_H

#include "kernel.h"
#include "lobe.h"
#include "maps.h"
#include "multiscale.h"
#include "parallel.h"

struct pe_baker {
    pe_bake_options options;
    pe_maps_info info;        /* of the maps it makes, as far as the environment is not asked */
    pe_maps_info hemispheres; /* those that are filtered: the same, or what lat-long maps are looked up in */
    pe_lobe *lobe;
    pe_kernel *kernel;         /* NULL: they are filtered light by light */
    pe_multiscale *multiscale; /* of layers and voxels, and nothing else then; NULL for others */
    pe_baker **grades;         /* of info.grades, which have them and nothing else; NULL for others */
};

/* What options say of maps and of the environment, and what they leave out that is the same for every method: the
 * brush's direction, angles, accuracy and error. */
pe_maps_info pe_describe_bake(const pe_bake_options *options, int width, int height);

/* A part of a bake, of the whole that the caller is told of. */
typedef struct pe_stage {
    const pe_bake_options *options;
    double begin, share;
} pe_stage;

/* The stage after this one, with a share of the whole, and what reports on it. */
pe_report pe_stage_begin(pe_stage *stage, double share);

/* *shrunk is env with as few texels as the baker's fast maps need, or NULL, where that is env itself. */
pe_status pe_baker_shrink(const pe_baker *baker, const pe_env *env, pe_env **shrunk, pe_error *error);

/* Fills and finishes maps of hemispheres with the lights of an environment whose suns are drawn out. */
pe_status pe_baker_fill(const pe_baker *baker, const pe_env *rest, pe_report *report, pe_maps *maps, pe_error *error);

/* ---- grades ---- */

/* Decides how many there are and makes a baker for each. */
pe_status pe_baker_prepare_grades(pe_baker *baker, double aim, int width, int height, pe_error *error);
void pe_baker_free_grades(pe_baker *baker);

/* As pe_baker_bake. */
pe_status pe_baker_bake_grades(const pe_baker *baker, const pe_env *env, const pe_bake_errors *known, pe_maps **out,
                               pe_error *error);

/* Is env of the baker's size? */
pe_status pe_baker_check_size(const pe_baker *baker, const pe_env *env, pe_error *error);

/* As pe_baker_bake_frames, of maps that are to be written and not to be looked up in: their splines may be missing. */
pe_status pe_baker_bake_pictures(const pe_baker *baker, const pe_env *const *envs, int count,
                                 const pe_bake_errors *errors, pe_maps **maps, pe_error *error);

#endif
