/* SPDX-License-Identifier: BSD-3-Clause */
/* Adding parts one after the other; after the first failure nothing more happens, and
 * build_finish() tells. */
#ifndef BAUM_TEST_MODELS_BUILDER_H
#define BAUM_TEST_MODELS_BUILDER_H

#include "models.h"

typedef struct builder {
  model *out;
  baum_status status;
} builder;

/* A point on a body, in its axes. */
typedef struct place {
  baum_body_id body;
  double point[2];
} place;

builder build_begin(model *out);
void build_gravity(builder *build, double gravity);
baum_body_id build_particle(builder *build, const baum_planar_particle_def *def);
baum_body_id build_body(builder *build, const baum_planar_body_def *def);
baum_body_id build_coordinates(builder *build, const baum_coordinates_def *def);
baum_joint_id build_pin(builder *build, const char *name, place a, place b);
void build_constraint(builder *build, const baum_user_constraint_def *def);
/* Any other joint or force: the status of its add call, and the joint that came of it. */
void build_joint(builder *build, baum_status status, baum_joint_id joint);
void build_force(builder *build, baum_status status);
bool build_fine(const builder *build);
baum_status build_finish(builder *build);

#endif
