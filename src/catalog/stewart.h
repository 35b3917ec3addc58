/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef BAUM_I_CATALOG_STEWART_H
#define BAUM_I_CATALOG_STEWART_H

#include "catalog/catalog.h"

/* Adds all elements of the Stewart platform with the parameters p. If `driven` is false, the legs
 * have no drivers, and the platform has six degrees of freedom. */
void baum_i_stewart_parts(baum_i_parts *parts, const double *p, bool driven);

#endif
