/* SPDX-License-Identifier: BSD-3-Clause */
/* Adding parts one after the other; after the first failure nothing more happens, and
 * build_finish() tells. Bodies, pins and gravity are given in SI units and added in those of the
 * model; for other parts there is build_unit(). */
#ifndef BAUM_TEST_MODELS_BUILDER_H
#define BAUM_TEST_MODELS_BUILDER_H

#include "models.h"

typedef struct builder {
  model *out;
  model_units units;
  baum_status status;
  int body_room;
  int joint_room;
} builder;

/* A point on a body, in its axes. */
typedef struct place {
  baum_body_id body;
  double point[2];
} place;

builder build_begin(model *out);
builder build_begin_in(const model_units *units, model *out); /* NULL: SI */
/* One SI unit of dimension length^l mass^m time^t in the units of the model. */
double build_unit(const builder *build, int l, int m, int t);
void build_gravity(builder *build, double gravity);
baum_body_id build_particle(builder *build, const baum_planar_particle_def *def);
baum_body_id build_body(builder *build, const baum_planar_body_def *def);
baum_body_id build_coordinates(builder *build, const baum_coordinates_def *def);
baum_joint_id build_pin(builder *build, const char *name, place a, place b);
void build_constraint(builder *build, const baum_user_constraint_def *def);
/* A slider on the line y = height of the ground through its centre of mass; `along` moves both points
 * of the guide along it. */
void build_guide(builder *build, const char *name, baum_body_id slider, double height,
                 double along);
/* Any other joint or force: the status of its add call, and the joint that came of it. */
void build_joint(builder *build, baum_status status, baum_joint_id joint);
void build_force(builder *build, baum_status status);
bool build_fine(const builder *build);
baum_status build_finish(builder *build);

#endif
