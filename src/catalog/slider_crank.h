/* SPDX-License-Identifier: BSD-3-Clause */
/* Adds a slider-crank in two steps: first its bodies, then its joints. Other elements may be added
 * between these steps. */
#ifndef BAUM_I_CATALOG_SLIDER_CRANK_H
#define BAUM_I_CATALOG_SLIDER_CRANK_H

#include "catalog/parts.h"

enum {
  BAUM_I_SLIDER_CRANK_CRANK, /* the lengths begin here */
  BAUM_I_SLIDER_CRANK_ROD,
  BAUM_I_SLIDER_CRANK_ECCENTRICITY,
  BAUM_I_SLIDER_CRANK_CRANK_MASS,
  BAUM_I_SLIDER_CRANK_ROD_MASS,
  BAUM_I_SLIDER_CRANK_SLIDER_MASS,
  BAUM_I_SLIDER_CRANK_CRANK_INERTIA,
  BAUM_I_SLIDER_CRANK_ROD_INERTIA,
  BAUM_I_SLIDER_CRANK_SLIDER_INERTIA,
  BAUM_I_SLIDER_CRANK_GRAVITY,
  BAUM_I_SLIDER_CRANK_ANGLE,
  BAUM_I_SLIDER_CRANK_SPEED,
  BAUM_I_SLIDER_CRANK_COUNT
};

/* The ids of crank, rod and slider. */
typedef struct baum_i_slider_crank_bodies {
  baum_body_id id[3];
} baum_i_slider_crank_bodies;

/* The parameters of the example by Flores et al. (see slider_crank.c). Only the eccentricity is not
 * from this source. */
extern const double baum_i_slider_crank_data[BAUM_I_SLIDER_CRANK_COUNT];

/* Computes the state of body 0, 1 or 2 from the angle q[0] and the angular velocity v[0] of the
 * crank. */
baum_i_body_state baum_i_slider_crank_state(const double *p, const double *q, const double *v,
                                            int body);

/* Adds the bodies in the initial configuration. Only the definition of the crank gives a
 * velocity. */
baum_i_slider_crank_bodies baum_i_slider_crank_add_bodies(baum_i_parts *parts, const double *p);

/* Adds the pin A on `frame`, the pins B and C, and the guide. If `driven` is set, also adds the
 * motor. */
void baum_i_slider_crank_add_joints(baum_i_parts *parts, const double *p,
                                    const baum_i_slider_crank_bodies *bodies, baum_body_id frame,
                                    bool driven);

#endif
