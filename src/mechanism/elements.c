/* SPDX-License-Identifier: BSD-3-Clause */
/* Elements in order and by name. */
#include <baum/elements.h>

#include <string.h>

#include "mechanism/identify.h"

static bool is_one(int32_t k, int32_t count)
{
  return k >= 0 && k < count;
}

static bool same(const char *name, const char *wanted)
{
  return name && wanted && strcmp(name, wanted) == 0;
}

/* ---- bodies ---- */

int32_t baum_mechanism_body_count(const baum_mechanism *mechanism)
{
  return mechanism ? mechanism->body_count : 0;
}

baum_body_id baum_mechanism_body_at(const baum_mechanism *mechanism, int32_t k)
{
  bool there = is_one(k, baum_mechanism_body_count(mechanism));
  return there ? (baum_body_id){k + 1, mechanism->tag} : (baum_body_id){0};
}

baum_body_id baum_mechanism_find_body(const baum_mechanism *mechanism, const char *name)
{
  for (int32_t k = 0; k < baum_mechanism_body_count(mechanism); k++) {
    if (same(mechanism->bodies[k + 1]->element.name, name)) {
      return baum_mechanism_body_at(mechanism, k);
    }
  }
  return mechanism && same("ground", name) ? BAUM_GROUND : (baum_body_id){0};
}

/* ---- joints ---- */

int32_t baum_mechanism_joint_count(const baum_mechanism *mechanism)
{
  return mechanism ? mechanism->joint_count : 0;
}

baum_joint_id baum_mechanism_joint_at(const baum_mechanism *mechanism, int32_t k)
{
  bool there = is_one(k, baum_mechanism_joint_count(mechanism));
  return there ? baum_i_joint_id(mechanism, k) : (baum_joint_id){0};
}

baum_joint_id baum_mechanism_find_joint(const baum_mechanism *mechanism, const char *name)
{
  for (int32_t k = 0; k < baum_mechanism_joint_count(mechanism); k++) {
    if (same(mechanism->joints[k]->element.name, name)) {
      return baum_mechanism_joint_at(mechanism, k);
    }
  }
  return (baum_joint_id){0};
}

/* ---- forces ---- */

int32_t baum_mechanism_force_count(const baum_mechanism *mechanism)
{
  return mechanism ? mechanism->force_count : 0;
}

baum_force_id baum_mechanism_force_at(const baum_mechanism *mechanism, int32_t k)
{
  bool there = is_one(k, baum_mechanism_force_count(mechanism));
  return there ? (baum_force_id){k + 1, mechanism->tag} : (baum_force_id){0};
}

baum_force_id baum_mechanism_find_force(const baum_mechanism *mechanism, const char *name)
{
  for (int32_t k = 0; k < baum_mechanism_force_count(mechanism); k++) {
    if (same(mechanism->forces[k]->element.name, name)) {
      return baum_mechanism_force_at(mechanism, k);
    }
  }
  return (baum_force_id){0};
}

const char *baum_mechanism_force_name(const baum_mechanism *mechanism, baum_force_id force)
{
  int index = baum_i_force_index(mechanism, force);
  return index < 0 ? NULL : mechanism->forces[index]->element.name;
}

/* ---- inputs ---- */

baum_input_id baum_mechanism_input_at(const baum_mechanism *mechanism, int32_t k)
{
  bool there = is_one(k, baum_mechanism_input_count(mechanism));
  return there ? (baum_input_id){k + 1, mechanism->tag} : (baum_input_id){0};
}

baum_input_id baum_mechanism_find_input(const baum_mechanism *mechanism, const char *name)
{
  for (int32_t k = 0; k < baum_mechanism_input_count(mechanism); k++) {
    baum_input_id id = baum_mechanism_input_at(mechanism, k);
    if (same(baum_mechanism_input_name(mechanism, id), name)) {
      return id;
    }
  }
  return (baum_input_id){0};
}
