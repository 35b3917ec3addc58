/* SPDX-License-Identifier: BSD-3-Clause */
#include "models.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <baum/catalog.h>

#include "catalog/chain.h"

const model_pendulum MODEL_PENDULUM_A01 = {.gravity = 9.81, .x = -1.0};
const model_pendulum MODEL_PENDULUM_SUNDIALS = {.gravity = 13.750371636040745, .x = 1.0};

#define QUARTER 1.5707963267948966 /* [rad] a quarter of a revolution */

/* ---- a mechanism and its parts ---- */

baum_status model_adopt(baum_mechanism *mechanism, model *out)
{
  int bodies = baum_mechanism_body_count(mechanism);
  int joints = baum_mechanism_joint_count(mechanism);
  *out = (model){.mechanism = mechanism, .body_count = bodies, .joint_count = joints};
  out->bodies = calloc((size_t)bodies + 1, sizeof *out->bodies);
  out->joints = calloc((size_t)joints + 1, sizeof *out->joints);
  if (!out->bodies || !out->joints) {
    model_destroy(out);
    return BAUM_ERR_MEMORY;
  }
  for (int k = 0; k < bodies; k++) {
    out->bodies[k] = baum_mechanism_body_at(mechanism, k);
  }
  for (int k = 0; k < joints; k++) {
    out->joints[k] = baum_mechanism_joint_at(mechanism, k);
  }
  return BAUM_OK;
}

baum_status model_finish(baum_i_parts *parts, const model_units *units, model *out)
{
  baum_mechanism *mechanism = NULL;
  *out = (model){.mechanism = NULL};
  baum_status status = baum_i_parts_finish(parts, &mechanism);
  if (status == BAUM_OK && units) {
    status = model_change_units(&mechanism, units);
  }
  return status == BAUM_OK ? model_adopt(mechanism, out) : status;
}

void model_destroy(model *out)
{
  baum_mechanism_destroy(out->mechanism);
  free(out->bodies);
  free(out->joints);
  memset(out, 0, sizeof *out);
}

/* ---- from the catalogue ---- */

static baum_status from_catalog(const char *name, const baum_catalog_setting *settings, int count,
                                const model_units *units, model *out)
{
  const baum_catalog_choice choice = {name, settings, count};
  baum_mechanism *mechanism = NULL;
  *out = (model){.mechanism = NULL};
  baum_status status = baum_catalog_build(&choice, &mechanism);
  if (status == BAUM_OK && units) {
    status = model_change_units(&mechanism, units);
  }
  return status == BAUM_OK ? model_adopt(mechanism, out) : status;
}

/* Replaces the mechanism by one without user derivatives. The library then computes these
 * derivatives by differences. */
static baum_status without_derivatives(baum_status status, model *m)
{
  baum_mechanism *copy = NULL;
  baum_user_constraint_def def = baum_user_constraint_def_default();
  if (status == BAUM_OK) {
    status = baum_mechanism_get_user_constraint(m->mechanism, m->joints[0], &def, sizeof def);
  }
  if (status == BAUM_OK) {
    status = baum_mechanism_copy(m->mechanism, &copy);
  }
  def.jacobian = NULL;
  def.nu = NULL;
  if (status == BAUM_OK) {
    status = baum_mechanism_set_user_constraint(copy, m->joints[0], &def);
  }
  if (status == BAUM_OK) {
    status = baum_mechanism_freeze(copy);
  }
  if (status == BAUM_OK) {
    baum_mechanism_destroy(m->mechanism);
    m->mechanism = copy;
  } else {
    baum_mechanism_destroy(copy);
    model_destroy(m);
  }
  return status;
}

baum_status model_pendulum_rod(const model_pendulum *data, model *out)
{
  const baum_catalog_setting settings[] = {
    {"gravity", data->gravity}, {"angle", QUARTER * data->x}, {"speed", data->v * data->x}};
  return from_catalog("pendulum", settings, 3, NULL, out);
}

baum_status model_andrews_angles(bool with_jacobian, model *out)
{
  baum_status status = from_catalog("andrews_angles", NULL, 0, NULL, out);
  return with_jacobian ? status : without_derivatives(status, out);
}

baum_status model_andrews_bodies(model *out)
{
  return model_andrews_bodies_in(NULL, out);
}

baum_status model_andrews_bodies_in(const model_units *units, model *out)
{
  return from_catalog("andrews_bodies", NULL, 0, units, out);
}

void model_andrews_from_bodies(const double *q, double angles[MODEL_ANDREWS_ANGLES])
{
  double k[7];
  for (int i = 0; i < 7; i++) {
    k[i] = q[3 * i + 2];
  }
  angles[0] = k[0];
  angles[1] = k[1] - k[0];
  angles[2] = k[2];
  angles[3] = k[3] - k[4];
  angles[4] = k[4];
  angles[5] = k[5] - k[6];
  angles[6] = k[6];
}

baum_status model_car_axis(bool with_derivatives, model *out)
{
  baum_status status = from_catalog("car_axis", NULL, 0, NULL, out);
  return with_derivatives ? status : without_derivatives(status, out);
}

baum_status model_sundials_slider_crank(model *out)
{
  return from_catalog("slider_crank_sundials", NULL, 0, NULL, out);
}

baum_status model_four_bar(model *out)
{
  return model_four_bar_in(NULL, out);
}

baum_status model_four_bar_in(const model_units *units, model *out)
{
  return from_catalog("four_bar", NULL, 0, units, out);
}

model_n_four_bar model_n_four_bar_a02(int loops)
{
  return (model_n_four_bar){
    .loops = loops, .angle = QUARTER, .rate = -1.0, .crank_mass = 1.0, .coupler_mass = 1.0};
}

baum_status model_n_four_bar_build(const model_n_four_bar *data, model *out)
{
  const baum_catalog_setting settings[] = {{"windows", data->loops},
                                           {"angle", data->angle},
                                           {"rate", data->rate},
                                           {"crank_mass", data->crank_mass},
                                           {"coupler_mass", data->coupler_mass}};
  return from_catalog("n_four_bar", settings, 5, data->units, out);
}

/* ---- chains ---- */

baum_status model_chain_3(model *out)
{
  return from_catalog("chain_3", NULL, 0, NULL, out);
}

model_chain model_chain_3_data(void)
{
  return (model_chain){.links = baum_i_chain_3.links,
                       .mass = baum_i_chain_3.mass,
                       .length = baum_i_chain_3.length,
                       .angle = baum_i_chain_3.angle};
}

baum_status model_chain_build(const model_chain *data, model *out)
{
  const baum_i_chain chain = {.links = data->links,
                              .mass = data->mass,
                              .length = data->length,
                              .angle = data->angle,
                              .rate = data->rate,
                              .all = {.mass = 1.0, .length = 1.0}};
  baum_i_parts parts = baum_i_parts_begin();
  baum_i_parts_gravity(&parts, 9.81);
  baum_i_chain_add(&parts, &chain);
  return model_finish(&parts, data->units, out);
}
