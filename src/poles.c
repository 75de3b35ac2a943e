/* poles.c - see poles.h. */
#include "poles.h"

#include "status.h"
#include "vector.h"

#include <stdlib.h>

pe_status pe_poles_make(const pe_geodesic *g, const double direction[3], double cosine, pe_poles *poles,
                        pe_error *error)
{
    int count = pe_geodesic_count(g);
    double axis[3];

    *poles =
        (pe_poles){ 0, malloc((size_t)count * sizeof *poles->vertices), malloc((size_t)count * sizeof *poles->ranks) };
    if (!poles->vertices || !poles->ranks) {
        pe_poles_free(poles);
        return pe_fail_memory(error, "the normals about the brush direction");
    }
    pe_normalize_any(direction, axis);
    for (int vertex = 0; vertex < count; vertex++) {
        poles->ranks[vertex] = -1;
        if (!(fabs(pe_dot(pe_geodesic_vertex(g, vertex), axis)) > cosine))
            continue;
        poles->ranks[vertex] = poles->count;
        poles->vertices[poles->count++] = vertex;
    }
    return PE_OK;
}

void pe_poles_free(pe_poles *poles)
{
    free(poles->vertices);
    free(poles->ranks);
    *poles = (pe_poles){ 0, NULL, NULL };
}

pe_status pe_poles_count(int frequency, const double direction[3], double cosine, int *count, pe_error *error)
{
    pe_geodesic *g;
    pe_poles poles;
    pe_status status = pe_geodesic_make(frequency, &g, error);

    if (status != PE_OK)
        return status;
    status = pe_poles_make(g, direction, cosine, &poles, error);
    if (status == PE_OK) {
        *count = poles.count;
        pe_poles_free(&poles);
    }
    pe_geodesic_free(g);
    return status;
}
