/* SPDX-License-Identifier: BSD-3-Clause */
/* A mechanism as an object: create, copy, share, destroy, names, what is set on the whole. */
#include "mechanism/mechanism.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

#include <baum/breaks.h>

#include "base/alloc.h"
#include "base/message.h"
#include "mechanism/definition.h"

/* ---- life ---- */

/* A tag that two mechanisms share by chance once in 2^32: address and time, well mixed (Stafford's
 * mix 13). A counter would be global state. */
static uint32_t make_tag(const void *address)
{
  struct timespec now = {0};
  (void)clock_gettime(CLOCK_MONOTONIC, &now);
  uint64_t x = (uint64_t)(uintptr_t)address;
  x ^= (uint64_t)now.tv_sec * 1000000007u + (uint64_t)now.tv_nsec * 0x9e3779b97f4a7c15u;
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

baum_status baum_mechanism_create(baum_mechanism **out)
{
  if (!out) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "baum_mechanism_create: out is NULL");
  }
  *out = NULL;
  baum_mechanism *mechanism = baum_i_alloc(1, sizeof *mechanism);
  if (!mechanism) {
    return baum_i_fail_memory();
  }
  atomic_init(&mechanism->references, 1);
  mechanism->tag = make_tag(mechanism);
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

const baum_mechanism *baum_i_mechanism_share(const baum_mechanism *mechanism)
{
  /* The count is the one member of a constant mechanism that changes. */
  baum_mechanism *counted = baum_i_mutable(mechanism);
  atomic_fetch_add(&counted->references, 1);
  return mechanism;
}

static void free_elements(baum_mechanism *mechanism)
{
  for (int i = 0; mechanism->bodies && i <= mechanism->body_count; i++) {
    baum_i_body_free(mechanism->bodies[i]);
  }
  for (int i = 0; i < mechanism->joint_count; i++) {
    baum_i_joint_free(mechanism->joints[i]);
  }
  for (int i = 0; i < mechanism->force_count; i++) {
    baum_i_force_free(mechanism->forces[i]);
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

static void *room(int count)
{
  return baum_i_grow(NULL, (size_t)count, sizeof(void *));
}

static baum_status copy_elements(baum_mechanism *to, const baum_mechanism *from)
{
  baum_i_body **bodies = baum_i_grow(to->bodies, (size_t)from->body_count + 1, sizeof(void *));
  if (!bodies) {
    return baum_i_fail_memory();
  }
  to->bodies = bodies;
  to->joints = room(from->joint_count);
  to->forces = room(from->force_count);
  if (!to->joints || !to->forces) {
    return baum_i_fail_memory();
  }
  for (int i = 1; i <= from->body_count; i++) {
    const baum_i_body *body = from->bodies[i];
    to->bodies[i] = baum_i_body_new(to, body->type, body->element.def, i);
    if (!to->bodies[i]) {
      return BAUM_ERR_MEMORY;
    }
    to->body_count = i;
  }
  for (int i = 0; i < from->joint_count; i++) {
    const baum_i_joint *joint = from->joints[i];
    to->joints[i] = baum_i_joint_new(to, joint->type, joint->element.def, i + 1);
    if (!to->joints[i]) {
      return BAUM_ERR_MEMORY;
    }
    to->joint_count = i + 1;
  }
  for (int i = 0; i < from->force_count; i++) {
    const baum_i_force *force = from->forces[i];
    to->forces[i] = baum_i_force_new(to, force->type, force->element.def, i + 1);
    if (!to->forces[i]) {
      return BAUM_ERR_MEMORY;
    }
    to->force_count = i + 1;
  }
  return BAUM_OK;
}

baum_status baum_mechanism_copy(const baum_mechanism *mechanism, baum_mechanism **out)
{
  if (!out) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "baum_mechanism_copy: out is NULL");
  }
  *out = NULL;
  if (!mechanism) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "baum_mechanism_copy: the mechanism is NULL");
  }
  baum_mechanism *copy = NULL;
  baum_status status = baum_mechanism_create(&copy);
  if (status != BAUM_OK || !copy) {
    return status;
  }
  copy->tag = mechanism->tag;
  copy->given_length = mechanism->given_length;
  memcpy(copy->gravity, mechanism->gravity, sizeof copy->gravity);
  status = baum_i_copy_inputs(copy, mechanism);
  if (status == BAUM_OK) {
    status = baum_mechanism_add_break_times(copy, mechanism->breaks, mechanism->break_count);
  }
  if (status == BAUM_OK) {
    status = copy_elements(copy, mechanism);
  }
  if (status != BAUM_OK) {
    baum_mechanism_destroy(copy);
    return status;
  }
  *out = copy;
  return BAUM_OK;
}

/* ---- names ---- */

const char *baum_mechanism_body_name(const baum_mechanism *mechanism, baum_body_id body)
{
  int index = baum_i_body_index(mechanism, body);
  return index < 0 ? NULL : mechanism->bodies[index]->element.name;
}

const char *baum_mechanism_joint_name(const baum_mechanism *mechanism, baum_joint_id joint)
{
  int index = baum_i_joint_index(mechanism, joint);
  return index < 0 ? NULL : mechanism->joints[index]->element.name;
}

/* ---- the whole ---- */

baum_status baum_mechanism_set_gravity(baum_mechanism *mechanism, double x, double y, double z)
{
  baum_status status = baum_i_check_open(mechanism, "baum_mechanism_set_gravity");
  if (status != BAUM_OK) {
    return status;
  }
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
  baum_status status = baum_i_check_open(mechanism, "baum_mechanism_set_characteristic_length");
  if (status == BAUM_OK) {
    status = baum_i_check_positive("mechanism", "length scale", "m", length);
  }
  if (status == BAUM_OK) {
    mechanism->given_length = length;
  }
  return status;
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

static void put(int32_t *out, int value)
{
  if (out) {
    *out = value;
  }
}

baum_status baum_mechanism_sizes(const baum_mechanism *mechanism, int32_t *nq, int32_t *nv,
                                 int32_t *nc)
{
  baum_status status = baum_i_check_frozen(mechanism, "baum_mechanism_sizes");
  if (status == BAUM_OK) {
    put(nq, mechanism->nq);
    put(nv, mechanism->nv);
    put(nc, mechanism->nc);
  }
  return status;
}

baum_status baum_mechanism_rows(const baum_mechanism *mechanism, baum_joint_id joint,
                                int32_t *first, int32_t *count)
{
  baum_status status = baum_i_check_frozen(mechanism, "baum_mechanism_rows");
  if (status == BAUM_OK) {
    status = baum_i_check_joint(mechanism, joint, "baum_mechanism_rows", "joint");
  }
  if (status == BAUM_OK) {
    const baum_i_joint *found = mechanism->joints[baum_i_joint_index(mechanism, joint)];
    put(first, found->row);
    put(count, found->rows);
  }
  return status;
}

baum_status baum_mechanism_columns(const baum_mechanism *mechanism, baum_body_id body,
                                   int32_t *first_q, int32_t *first_v)
{
  baum_status status = baum_i_check_frozen(mechanism, "baum_mechanism_columns");
  if (status == BAUM_OK) {
    status = baum_i_check_body(mechanism, body, "baum_mechanism_columns", "body");
  }
  if (status != BAUM_OK) {
    return status;
  }
  int index = baum_i_body_index(mechanism, body);
  if (index == 0) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "baum_mechanism_columns: ground has no coordinates");
  }
  put(first_q, mechanism->bodies[index]->q);
  put(first_v, mechanism->bodies[index]->v);
  return BAUM_OK;
}
