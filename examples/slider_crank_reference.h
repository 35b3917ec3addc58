/* SPDX-License-Identifier: BSD-3-Clause */
/* The reference motion of the slider-crank of slider_crank_model.h without a driver. It comes from
 * the catalogue of mechanisms with known motions and was computed without this library
 * (docs/mechanisms.md). */
#ifndef SLIDER_CRANK_REFERENCE_H
#define SLIDER_CRANK_REFERENCE_H

#include <baum/catalog.h>

#include "slider_crank_model.h"

enum { REFERENCE_SAMPLES = 21 };

static const baum_catalog_choice REFERENCE = {.name = "slider_crank_eccentric"};

/* Returns the time of sample k [s]. */
static inline double reference_time(int k)
{
  double times[REFERENCE_SAMPLES];
  CHECK(baum_catalog_times(REFERENCE.name, times));
  return times[k];
}

/* Returns the largest difference of the run's present positions from sample k, with angles in
 * radians and lengths divided by the characteristic length. */
static inline double slider_crank_error(const slider_crank *s, const baum_simulation *run, int k)
{
  const double t = reference_time(k);
  baum_catalog_error error;
  CHECK(baum_catalog_compare(&REFERENCE, s->mechanism, &t, 1, baum_simulation_q(run), NULL, &error,
                             sizeof error));
  return error.q;
}

#endif
