/* hdri.h - the HDRIs that ./bootstrap fetches, for the tests that look at real ones. */
#ifndef HDRI_H
#define HDRI_H

#include "prefenv.h"
#include "tap.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* One of them, such as "city"; NULL, and a claim that is skipped, where the data is not at hand.  What is at hand and
 * cannot be read ends the test: else a broken reader would skip it all. */
static inline pe_env *hdri_read(const char *name)
{
    const char *data = getenv("PREFENV_DATA");
    char path[4096];
    pe_env *env;
    pe_error error = { PE_OK, "" };

    snprintf(path, sizeof path, "%s/hdri/%s.exr", data ? data : ".", name);
    if (access(path, F_OK) != 0) {
        ok(1, "%s # SKIP %s: %s", name, path, strerror(errno));
        return NULL;
    }
    need(pe_env_read(path, &env, &error) == PE_OK, "%s", error.message);
    return env;
}

#endif
