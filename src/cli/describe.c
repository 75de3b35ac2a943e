/* describe.c - see describe.h. */
#include "describe.h"

#include "maps.h"

#include <math.h>
#include <stdio.h>

static const char *method_name(pe_method method)
{
    static const char *const names[] = PE_METHOD_NAMES;

    return names[method];
}

static const char *ndf_name(const pe_ndf *ndf)
{
    static const char *const names[] = PE_NDF_NAMES;

    return names[ndf->kind];
}

void describe_accuracy(const pe_maps_info *info, char text[DESCRIBE_BYTES])
{
    int used;

    if (info->accuracy == PE_ACCURACY_FAST)
        used = snprintf(text, DESCRIBE_BYTES, "fast, an estimated %.2g %% from exact filtering",
                        100 * info->error_estimate);
    else
        used = snprintf(text, DESCRIBE_BYTES, "exact");
    if (info->method == PE_METHOD_HEMISPHERES || info->method == PE_METHOD_GRADES || info->smoothness.size)
        snprintf(text + used, DESCRIBE_BYTES - (size_t)used, "; lookups %.2g %%", 100 * info->lookup_error);
}

static void describe_index(const pe_surface *surface)
{
    const double *eta = surface->eta, *k = surface->k;

    printf("weight     microfacet\n");
    if (eta[0] == 0 && k[0] == 0)
        printf("index      none, all is reflected\n");
    else
        printf("index      %g + %g i, %g + %g i, %g + %g i\n", eta[0], k[0], eta[1], k[1], eta[2], k[2]);
}

void describe_images(const pe_maps_info *info, char text[DESCRIBE_BYTES])
{
    if (info->method == PE_METHOD_VOXELS)
        snprintf(text, DESCRIBE_BYTES, "%d^3 voxels", info->images);
    else if (info->method == PE_METHOD_LAYERS)
        snprintf(text, DESCRIBE_BYTES, "%d layers of up to %dx%d", info->images, info->width, info->height);
    else if (info->method == PE_METHOD_GRADES)
        snprintf(text, DESCRIBE_BYTES, "%d maps in %d grades of alpha %g to %g", info->images, info->grades,
                 info->surface.ndf.alpha_x, info->alpha_max);
    else
        snprintf(text, DESCRIBE_BYTES, "%d %s of %dx%d", info->images, info->images == 1 ? "map" : "maps", info->width,
                 info->height);
}

static void describe_roughness(const pe_maps_info *info)
{
    const pe_smoothness *s = &info->smoothness;

    printf("lobe       phong, about the mirror direction\n");
    printf("roughness  lambda 0 to 1, exponents up to %.4g (size %d, window %g, levels %g)\n",
           pe_smoothness_exponent(s, 1), s->size, s->window, s->levels);
    if (info->threshold > 0)
        printf("threshold  %g, what is left out %s\n", info->threshold,
               info->lost == PE_LOST_DARK ? "is missing" : "is made up for");
}

static void describe_range(const pe_maps_info *info)
{
    double aspect = info->surface.ndf.alpha_x / info->surface.ndf.alpha_y;

    printf("alpha      %g to %g", info->surface.ndf.alpha_x, info->alpha_max);
    if (fabs(aspect - 1) > 1e-9)
        printf(" along the brush, %g times that across", 1 / aspect);
    printf("\n");
}

static void describe_surface(const pe_maps_info *info)
{
    if (info->surface.ndf.kind == PE_NDF_TABLE)
        printf("ndf        table %s\n", *info->ndf_name ? info->ndf_name : "(no name)");
    else
        printf("ndf        %s\n", ndf_name(&info->surface.ndf));
    if (info->grades)
        describe_range(info);
    else if (info->surface.ndf.alpha_x == info->surface.ndf.alpha_y)
        printf("alpha      %g\n", info->surface.ndf.alpha_x);
    else
        printf("alpha      %g along, %g across the brush\n", info->surface.ndf.alpha_x, info->surface.ndf.alpha_y);
    if (info->surface.weight == PE_WEIGHT_MICROFACET)
        describe_index(&info->surface);
    printf("direction  %g %g %g\n", info->direction[0], info->direction[1], info->direction[2]);
}

static void describe_grades(const pe_maps *maps)
{
    for (int k = 0; k < pe_maps_get_info(maps)->grades; k++) {
        const pe_maps_info *info = pe_maps_get_info(pe_maps_grade(maps, k));

        printf("%s alpha %-8.4g %5d normals, %5d maps of %dx%d; lookups %.2g %%\n", k ? "          " : "grades    ",
               info->surface.ndf.alpha_x, info->normals, info->images, info->width, info->height,
               100 * info->lookup_error);
    }
}

void describe_maps(const pe_maps *maps)
{
    const pe_maps_info *info = pe_maps_get_info(maps);
    char accuracy[DESCRIBE_BYTES], images[DESCRIBE_BYTES];

    describe_accuracy(info, accuracy);
    printf("method     %s\n", method_name(info->method));
    if (info->method == PE_METHOD_REPRESENTATIVE)
        printf("normals    %d (frequency %d), opposite ones share an image\n", info->normals, info->frequency);
    if (info->method == PE_METHOD_HEMISPHERES)
        printf("normals    %d (frequency %d), each with a picture of its hemisphere\n", info->normals, info->frequency);
    if (info->angles > 1)
        printf("angles     %d brush directions\n", info->angles);
    if (info->pole_angles && !info->grades)
        printf("poles      %d brush directions for normals within %.1f degrees of the brush\n", info->pole_angles,
               acos(info->pole_cosine) * 180 / M_PI);
    if (info->suns)
        printf("suns       %d lights kept apart\n", info->suns);
    if (info->smoothness.size || info->grades)
        describe_images(info, images);
    else
        snprintf(images, sizeof images, "%d of %dx%d", info->images, info->width, info->height);
    printf("images     %s\n", images);
    describe_grades(maps);
    if (info->smoothness.size)
        describe_roughness(info);
    else
        describe_surface(info);
    printf("source     %s, %dx%d\n", *info->source_name ? info->source_name : "(no name)", info->source_width,
           info->source_height);
    printf("accuracy   %s\n", accuracy);
    printf("format     version %d\n", info->format_version);
}

static void describe_grades_json(json *out, const pe_maps *maps)
{
    json_open(out, "grades");
    for (int k = 0; k < pe_maps_get_info(maps)->grades; k++) {
        const pe_maps_info *info = pe_maps_get_info(pe_maps_grade(maps, k));
        const double alpha[2] = { info->surface.ndf.alpha_x, info->surface.ndf.alpha_y };
        char name[16];

        snprintf(name, sizeof name, "%d", k);
        json_open(out, name);
        json_numbers(out, "alpha", alpha, 2);
        json_integer(out, "normals", info->normals);
        json_integer(out, "images", info->images);
        json_integer(out, "width", info->width);
        json_integer(out, "height", info->height);
        json_number(out, "lookup_error", info->lookup_error);
        json_close(out);
    }
    json_close(out);
}

void describe_maps_json(json *out, const pe_maps *maps)
{
    const pe_maps_info *info = pe_maps_get_info(maps);
    const double alpha[2] = { info->surface.ndf.alpha_x, info->surface.ndf.alpha_y };
    const double direction[3] = { info->direction[0], info->direction[1], info->direction[2] };
    char fingerprint[17];

    json_integer(out, "format_version", info->format_version);
    json_text(out, "method", method_name(info->method));
    json_text(out, "weight", info->surface.weight == PE_WEIGHT_MICROFACET ? "microfacet" : "ndf");
    json_numbers(out, "eta", info->surface.eta, 3);
    json_numbers(out, "k", info->surface.k, 3);
    json_text(out, "ndf", ndf_name(&info->surface.ndf));
    json_text(out, "ndf_name", info->ndf_name);
    json_numbers(out, "alpha", alpha, 2);
    json_numbers(out, "direction", direction, 3);
    json_integer(out, "normals", info->normals);
    json_integer(out, "frequency", info->frequency);
    json_integer(out, "angles", info->angles);
    if (info->pole_angles) {
        json_integer(out, "pole_angles", info->pole_angles);
        json_number(out, "pole_cosine", info->pole_cosine);
    }
    json_integer(out, "suns", info->suns);
    json_integer(out, "images", info->images);
    json_integer(out, "width", info->width);
    json_integer(out, "height", info->height);
    json_text(out, "source_name", info->source_name);
    json_integer(out, "source_width", info->source_width);
    json_integer(out, "source_height", info->source_height);
    snprintf(fingerprint, sizeof fingerprint, "%016llx", info->source_fingerprint);
    json_text(out, "source_fingerprint", info->source_fingerprint ? fingerprint : "");
    json_text(out, "accuracy", info->accuracy == PE_ACCURACY_FAST ? "fast" : "exact");
    if (info->smoothness.size) {
        json_integer(out, "size", info->smoothness.size);
        json_number(out, "window", info->smoothness.window);
        json_number(out, "levels", info->smoothness.levels);
        json_number(out, "exponent", pe_smoothness_exponent(&info->smoothness, 1));
    }
    if (info->method == PE_METHOD_VOXELS) {
        json_number(out, "threshold", info->threshold);
        json_text(out, "lost", info->lost == PE_LOST_DARK ? "dark" : "spread");
    }
    if (info->grades) {
        json_number(out, "alpha_max", info->alpha_max);
        describe_grades_json(out, maps);
    }
    json_number(out, "error_estimate", info->error_estimate);
    json_number(out, "lookup_error", info->lookup_error);
}
