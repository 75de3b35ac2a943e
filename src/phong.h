/* phong.h - a scale of roughness, its defaults filled in. */
#ifndef PE_PHONG_H
#define PE_PHONG_H

#include "prefenv.h"

void pe_smoothness_complete(pe_smoothness *scale);

#endif
