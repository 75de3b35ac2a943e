/* hdri.h - the HDRIs that ./bootstrap fetches, for the tests that look at real ones. */
#ifndef HDRI_H
#define HDRI_H

#include "prefenv.h"
#include "tap.h"

#include <stdio.h>
#include <stdlib.h>

/* One of them, such as "city"; NULL, and a claim that is skipped, where the data is not at hand. */
static inline pe_env *hdri_read(const char *name)
{
    const char *data = getenv("PREFENV_DATA");
    char path[4096];
    pe_env *env;
    pe_error error;

    snprintf(path, sizeof path, "%s/hdri/%s.exr", data ? data : ".", name);
    if (pe_env_read(path, &env, &error) == PE_OK)
        return env;
    ok(1, "%s # SKIP %s", name, error.message);
    return NULL;
}

#endif
