/* environment.c - the environment image that bake and exact start from. */
#include "cli.h"
#include "prefenv.h"
#include "status.h"

#include <stdlib.h>

pe_status cli_read_environment(const char *path, pe_env **env, pe_error *error)
{
    unsigned char *bytes;
    size_t size;
    pe_status status = pe_file_read(path, &bytes, &size, error);

    if (status != PE_OK)
        return status;
    /* What these hold would pass for an environment. */
    if (pe_maps_detect(bytes, size))
        status = pe_fail(error, PE_ERROR_FORMAT, "%s: is a maps file; give the image that it was baked from", path);
    else if (pe_ndf_table_detect(bytes, size))
        status =
            pe_fail(error, PE_ERROR_FORMAT, "%s: is a table of slopes; give it behind --ndf, and an environment", path);
    else if (pe_heights_detect(bytes, size))
        status = pe_fail(error, PE_ERROR_FORMAT,
                         "%s: is a height field; measure it with prefenv ndf, and give an environment", path);
    else
        status = pe_env_read_memory(bytes, size, path, env, error);
    free(bytes);
    return status;
}

void cli_warn_of_flaws(const char *command, const char *path, const pe_env *env)
{
    if (*pe_env_remark(env))
        cli_warning(command, "%s: %s", path, pe_env_remark(env));
}
