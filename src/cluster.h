/* cluster.h - an environment as few lights: texels gathered where it is dim and even, left alone where it is bright. */
#ifndef PE_CLUSTER_H
#define PE_CLUSTER_H

#include "filter.h"
#include "parallel.h"

/* At most `count` lights standing for the whole environment, in an order that keeps neighbours together.  Solid angle
 * and radiance times solid angle are conserved.  The report, or NULL, is called now and then, always with the same
 * fraction, and may cancel. */
pe_status pe_cloud_from_clusters(const pe_env *env, size_t count, const pe_report *report, pe_cloud *cloud,
                                 pe_error *error);

#endif
