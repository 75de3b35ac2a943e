/* describe.h - what a maps file says of itself, in words and as JSON. */
#ifndef CLI_DESCRIBE_H
#define CLI_DESCRIBE_H

#include "json.h"
#include "prefenv.h"

/* Longest text of describe_accuracy, with its end. */
#define DESCRIBE_BYTES 96

/* "exact", or "fast, an estimated 0.4 % from exact filtering; lookups 0.5 %" */
void describe_accuracy(const pe_maps_info *info, char text[DESCRIBE_BYTES]);

/* "42 maps of 400x200", "128^3 voxels". */
void describe_images(const pe_maps_info *info, char text[DESCRIBE_BYTES]);

/* A table of a label and a value a line, to standard output. */
void describe_maps(const pe_maps *maps);

/* The same as members of the object that is open. */
void describe_maps_json(json *out, const pe_maps *maps);

#endif
