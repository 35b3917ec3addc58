/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef BAUM_I_CATALOG_CHAIN_H
#define BAUM_I_CATALOG_CHAIN_H

#include "catalog/parts.h"

/* Data that all links of a chain share. */
typedef struct baum_i_link {
  double mass;   /* [kg] */
  double length; /* [m] */
  double angle;  /* [rad] angle at the start */
  double rate;   /* [rad/s] angular velocity at the start */
} baum_i_link;

/* A chain of uniform rods that hangs from the origin. If an array is NULL, every link has the value
 * in `all`. */
typedef struct baum_i_chain {
  int links;
  const double *mass;   /* (links) [kg] */
  const double *length; /* (links) [m] */
  const double *angle;  /* (links) [rad] angles at the start */
  const double *rate;   /* (links) [rad/s] angular velocities at the start */
  baum_i_link all;
} baum_i_chain;

/* A chain of three links with different lengths and masses. data/chain.h contains its reference
 * motion. */
extern const baum_i_chain baum_i_chain_3;

void baum_i_chain_add(baum_i_parts *parts, const baum_i_chain *data);

#endif
