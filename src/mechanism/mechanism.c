/* SPDX-License-Identifier: BSD-3-Clause */
/* A mechanism as an object. This file creates, copies, shares and destroys mechanisms, and changes
 * the settings that concern a whole mechanism. */
#include "mechanism/mechanism.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include <baum/breaks.h>

#include "base/alloc.h"
#include "base/hot.h"
#include "base/message.h"
#include "base/platform.h"
#include "mechanism/definition.h"

/* ---- create, share, destroy ---- */

/* Compute a tag from the address of the mechanism and the time, by the hash function "mix 13" of D.
 * Stafford. Two mechanisms that are not copies of each other have the same tag with a probability
 * of 2^-32. The tag does not come from a counter, because a counter would be global state. */
static uint32_t make_tag(const void *address)
{
  uint64_t x = (uint64_t)(uintptr_t)address;
  x ^= (uint64_t)baum_i_wall_nanoseconds() * 0x9e3779b97f4a7c15u;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  uint32_t tag = (uint32_t)(x ^ (x >> 31));
  return tag != 0 ? tag : 1;
}

static baum_i_body *make_ground(void)
{
  baum_i_body *ground = baum_i_alloc(1, sizeof *ground);
  if (!ground) {
    return NULL;
  }
  ground->element.name = baum_i_copy_text("ground");
  if (!ground->element.name) {
    baum_i_free(ground);
    return NULL;
  }
  return ground;
}

static baum_status create(bool wide, baum_mechanism **out)
{
  baum_mechanism *mechanism = baum_i_alloc(1, sizeof *mechanism);
  BAUM_I_TRY(baum_i_check_memory(mechanism));
  atomic_init(&mechanism->references, 1);
  mechanism->tag = make_tag(mechanism);
  mechanism->wide = wide;
  mechanism->gravity[1] = -9.81;
  mechanism->given_length = NAN;
  mechanism->bodies = baum_i_alloc(1, sizeof(void *));
  if (mechanism->bodies) {
    mechanism->bodies[0] = make_ground();
  }
  if (!mechanism->bodies || !mechanism->bodies[0]) {
    baum_mechanism_destroy(mechanism);
    return baum_i_fail_memory();
  }
  *out = mechanism;
  return BAUM_OK;
}

baum_status baum_mechanism_create(baum_mechanism **out)
{
  if (!out) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "baum_mechanism_create: out is NULL");
  }
  *out = NULL;
  return create(baum_i_hot_is_wide(), out);
}

const baum_mechanism *baum_i_mechanism_share(const baum_mechanism *mechanism)
{
  /* The reference count is the only member that changes after freeze. */
  baum_mechanism *counted = baum_i_mutable(mechanism);
  atomic_fetch_add(&counted->references, 1);
  return mechanism;
}

static void free_all_outlines(baum_mechanism *mechanism)
{
  for (int k = 0; k <= mechanism->body_count; k++) {
    baum_i_body *body = mechanism->bodies ? mechanism->bodies[k] : NULL;
    if (body) {
      baum_i_free_outlines(body->outlines, body->outline_count);
    }
  }
}

static void free_elements(baum_mechanism *mechanism)
{
  free_all_outlines(mechanism);
  for (int i = 0; i < BAUM_I_FAMILIES; i++) {
    const baum_i_family *family = baum_i_families[i];
    for (int k = 0; k < baum_i_family_count(family, mechanism); k++) {
      baum_i_free_element(family, family->at(mechanism, k));
    }
  }
  if (mechanism->bodies && mechanism->bodies[0]) {
    baum_i_free_element(&baum_i_body_family, &mechanism->bodies[0]->element);
  }
  baum_i_free(mechanism->bodies);
  baum_i_free(mechanism->joints);
  baum_i_free(mechanism->forces);
}

void baum_mechanism_destroy(baum_mechanism *mechanism)
{
  if (!mechanism || atomic_fetch_sub(&mechanism->references, 1) > 1) {
    return;
  }
  baum_i_mechanism_thaw(mechanism);
  free_elements(mechanism);
  baum_i_free_inputs(mechanism);
  baum_i_free(mechanism->breaks);
  baum_i_free(mechanism);
}

/* ---- copy ---- */

static baum_status copy_elements(baum_mechanism *to, const baum_mechanism *from)
{
  for (int i = 0; i < BAUM_I_FAMILIES; i++) {
    const baum_i_family *family = baum_i_families[i];
    for (int k = 0; k < baum_i_family_count(family, from); k++) {
      const baum_i_element *element = family->at(from, k);
      BAUM_I_TRY(baum_i_append_element(to, family, element->definition, element->def));
    }
  }
  return BAUM_OK;
}

static baum_status copy_all_outlines(baum_mechanism *to, const baum_mechanism *from)
{
  for (int k = 0; k <= from->body_count; k++) {
    const baum_i_body *body = from->bodies[k];
    BAUM_I_TRY(baum_i_copy_outlines(body->outlines, body->outline_count, &to->bodies[k]->outlines));
    to->bodies[k]->outline_count = body->outline_count;
  }
  return BAUM_OK;
}

static baum_status copy_all(baum_mechanism *to, const baum_mechanism *from)
{
  to->tag = from->tag;
  to->given_length = from->given_length;
  memcpy(to->gravity, from->gravity, sizeof to->gravity);
  BAUM_I_TRY(baum_i_copy_inputs(to, from));
  BAUM_I_TRY(baum_mechanism_add_break_times(to, from->breaks, from->break_count));
  BAUM_I_TRY(copy_elements(to, from));
  return copy_all_outlines(to, from);
}

baum_status baum_mechanism_copy(const baum_mechanism *mechanism, baum_mechanism **out)
{
  if (out) {
    *out = NULL;
  }
  if (!mechanism || !out) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "baum_mechanism_copy: %s is NULL",
                       out ? "the mechanism" : "out");
  }
  BAUM_I_TRY(create(mechanism->wide, out));
  baum_status status = copy_all(*out, mechanism);
  if (status != BAUM_OK) {
    baum_mechanism_destroy(*out);
    *out = NULL;
  }
  return status;
}

/* ---- settings and sizes ---- */

baum_status baum_mechanism_set_gravity(baum_mechanism *mechanism, double x, double y, double z)
{
  BAUM_I_TRY(baum_i_check_open(mechanism, "baum_mechanism_set_gravity"));
  if (!isfinite(x) || !isfinite(y) || !isfinite(z)) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "gravity is (%g, %g, %g) m/s^2, must be finite", x, y, z);
  }
  mechanism->gravity[0] = x;
  mechanism->gravity[1] = y;
  mechanism->gravity[2] = z;
  return BAUM_OK;
}

baum_status baum_mechanism_get_gravity(const baum_mechanism *mechanism, double gravity[3])
{
  if (!mechanism || !gravity) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "baum_mechanism_get_gravity: %s is NULL",
                       mechanism ? "gravity" : "the mechanism");
  }
  memcpy(gravity, mechanism->gravity, sizeof mechanism->gravity);
  return BAUM_OK;
}

baum_status baum_mechanism_set_characteristic_length(baum_mechanism *mechanism, double length)
{
  BAUM_I_TRY(baum_i_check_open(mechanism, "baum_mechanism_set_characteristic_length"));
  BAUM_I_TRY(baum_i_check_positive("mechanism", "characteristic length", "m", length));
  mechanism->given_length = length;
  return BAUM_OK;
}

baum_status baum_mechanism_get_characteristic_length(const baum_mechanism *mechanism,
                                                     double *length)
{
  if (!mechanism || !length) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "baum_mechanism_get_characteristic_length: %s is NULL",
                       mechanism ? "length" : "the mechanism");
  }
  *length = mechanism->frozen ? mechanism->length : mechanism->given_length;
  return BAUM_OK;
}

bool baum_mechanism_is_frozen(const baum_mechanism *mechanism)
{
  return mechanism && mechanism->frozen;
}

static void give_number(int32_t *out, int value)
{
  if (out) {
    *out = value;
  }
}

baum_status baum_mechanism_sizes(const baum_mechanism *mechanism, int32_t *nq, int32_t *nv,
                                 int32_t *nc)
{
  BAUM_I_TRY(baum_i_check_frozen(mechanism, "baum_mechanism_sizes"));
  give_number(nq, mechanism->nq);
  give_number(nv, mechanism->nv);
  give_number(nc, mechanism->nc);
  return BAUM_OK;
}

baum_status baum_mechanism_rows(const baum_mechanism *mechanism, baum_joint_id joint,
                                int32_t *first, int32_t *count)
{
  BAUM_I_TRY(baum_i_check_frozen(mechanism, "baum_mechanism_rows"));
  BAUM_I_TRY(baum_i_check_joint(mechanism, joint, "baum_mechanism_rows", "joint"));
  const baum_i_joint *found = mechanism->joints[baum_i_joint_index(mechanism, joint)];
  give_number(first, found->row);
  give_number(count, found->rows);
  return BAUM_OK;
}

baum_status baum_mechanism_columns(const baum_mechanism *mechanism, baum_body_id body,
                                   int32_t *first_q, int32_t *first_v)
{
  BAUM_I_TRY(baum_i_check_frozen(mechanism, "baum_mechanism_columns"));
  BAUM_I_TRY(baum_i_check_body(mechanism, body, "baum_mechanism_columns", "body"));
  int index = baum_i_body_index(mechanism, body);
  if (index == 0) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "baum_mechanism_columns: ground has no coordinates");
  }
  give_number(first_q, mechanism->bodies[index]->q);
  give_number(first_v, mechanism->bodies[index]->v);
  return BAUM_OK;
}
