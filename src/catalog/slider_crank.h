/* SPDX-License-Identifier: BSD-3-Clause */
/* A slider-crank in two halves, between which other elements may be added. */
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

/* Data of the source, with an eccentricity. */
extern const double baum_i_slider_crank_data[BAUM_I_SLIDER_CRANK_COUNT];

/* Computes position and velocity of body 0 to 2 from the angle q[0] and the angular velocity v[0]
 * of the crank. */
void baum_i_slider_crank_state(const double *p, const double *q, const double *v, int body,
                               double *body_q, double *body_v);

/* Adds the bodies at the start; the only velocity given is the crank's. */
baum_i_slider_crank_bodies baum_i_slider_crank_add_bodies(baum_i_parts *parts, const double *p);

/* Pins A on the frame, B, C, the guide, and the motor if driven. */
void baum_i_slider_crank_add_joints(baum_i_parts *parts, const double *p,
                                    const baum_i_slider_crank_bodies *bodies, baum_body_id frame,
                                    bool driven);

#endif
