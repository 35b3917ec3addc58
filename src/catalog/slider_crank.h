/* SPDX-License-Identifier: BSD-3-Clause */
/* Adds a slider-crank in two steps, bodies and joints, between which other elements may be
 * added. */
#ifndef BAUM_I_CATALOG_SLIDER_CRANK_H
#define BAUM_I_CATALOG_SLIDER_CRANK_H

#include "catalog/parts.h"

enum {
  BAUM_I_SLIDER_CRANK_CRANK, /* lengths */
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

/* Crank, rod, slider. */
typedef struct baum_i_slider_crank_bodies {
  baum_body_id id[3];
} baum_i_slider_crank_bodies;

/* Parameters of the source (see slider_crank.c), with an eccentricity of our choice. */
extern const double baum_i_slider_crank_data[BAUM_I_SLIDER_CRANK_COUNT];

/* Computes the state of body 0 to 2 from the angle q[0] and the angular velocity v[0] of the
 * crank. */
baum_i_body_state baum_i_slider_crank_state(const double *p, const double *q, const double *v,
                                            int body);

/* Adds the bodies in the initial configuration. Only the crank is given a velocity. */
baum_i_slider_crank_bodies baum_i_slider_crank_add_bodies(baum_i_parts *parts, const double *p);

/* Adds the pins A (on `frame`), B and C, the guide, and the motor if `driven`. */
void baum_i_slider_crank_add_joints(baum_i_parts *parts, const double *p,
                                    const baum_i_slider_crank_bodies *bodies, baum_body_id frame,
                                    bool driven);

#endif
