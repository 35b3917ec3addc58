/* SPDX-License-Identifier: BSD-3-Clause */
#include "mechanism/family.h"

#include "base/alloc.h"
#include "base/message.h"

/* ---- lists and groups: the same code is generated for bodies, joints and forces ---- */

/* FIRST is the number of elements at the start of LIST that are not counted. It is 1 for bodies,
 * because ground is the first of them, and otherwise 0. */
#define LIST_FUNCTIONS(FAMILY, LIST, FIRST)                                                    \
  static baum_i_element *FAMILY##_at(const baum_mechanism *mechanism, int k)                   \
  {                                                                                            \
    return &mechanism->LIST[k + (FIRST)]->element;                                             \
  }                                                                                            \
  static baum_status append_##FAMILY(baum_mechanism *mechanism, baum_i_element *element)       \
  {                                                                                            \
    const int at = mechanism->FAMILY##_count + (FIRST);                                        \
    void *list = baum_i_grow_by_one(mechanism->LIST, (size_t)at + 1, sizeof *mechanism->LIST); \
    if (!list) {                                                                               \
      return baum_i_fail_memory();                                                             \
    }                                                                                          \
    mechanism->LIST = list;                                                                    \
    mechanism->LIST[at] = (baum_i_##FAMILY *)(void *)element;                                  \
    mechanism->FAMILY##_count++;                                                               \
    return BAUM_OK;                                                                            \
  }                                                                                            \
  static baum_status open_##FAMILY##_groups(baum_mechanism *mechanism)                         \
  {                                                                                            \
    /* One group more than needed, because an empty group ends the list. */                    \
    size_t count = (size_t)mechanism->FAMILY##_count + 1;                                      \
    mechanism->FAMILY##_groups = baum_i_alloc(count, sizeof *mechanism->FAMILY##_groups);      \
    return mechanism->FAMILY##_groups ? BAUM_OK : baum_i_fail_memory();                        \
  }                                                                                            \
  static baum_status join_##FAMILY##_group(baum_mechanism *mechanism, baum_i_element *element) \
  {                                                                                            \
    const baum_i_##FAMILY *item = (baum_i_##FAMILY *)(void *)element;                          \
    baum_i_##FAMILY##_group *group = mechanism->FAMILY##_groups;                               \
    while (group->type && group->type != item->type) {                                         \
      group++;                                                                                 \
    }                                                                                          \
    if (!group->type) {                                                                        \
      group->LIST = baum_i_alloc((size_t)mechanism->FAMILY##_count, sizeof *group->LIST);      \
      if (!group->LIST) {                                                                      \
        return baum_i_fail_memory();                                                           \
      }                                                                                        \
      group->type = item->type;                                                                \
    }                                                                                          \
    group->LIST[group->count++] = item;                                                        \
    return BAUM_OK;                                                                            \
  }                                                                                            \
  static void free_##FAMILY##_groups(baum_mechanism *mechanism)                                \
  {                                                                                            \
    baum_i_##FAMILY##_group *group = mechanism->FAMILY##_groups;                               \
    for (; group && group->type; group++) {                                                    \
      baum_i_free(group->LIST);                                                                \
    }                                                                                          \
    baum_i_free(mechanism->FAMILY##_groups);                                                   \
    mechanism->FAMILY##_groups = NULL;                                                         \
  }

LIST_FUNCTIONS(body, bodies, 1)
LIST_FUNCTIONS(joint, joints, 0)
LIST_FUNCTIONS(force, forces, 0)

#define FAMILY_MEMBERS(FAMILY)                                                                     \
  .name = #FAMILY, .size = sizeof(baum_i_##FAMILY), .span = offsetof(baum_i_##FAMILY, span),       \
  .count = offsetof(baum_mechanism, FAMILY##_count), .at = FAMILY##_at, .append = append_##FAMILY, \
  .open_groups = open_##FAMILY##_groups, .join_group = join_##FAMILY##_group,                      \
  .free_groups = free_##FAMILY##_groups, .prepare = prepare_##FAMILY, .rows = FAMILY##_rows,       \
  .place = place_##FAMILY, .close = close_##FAMILY##_list

/* ---- bodies ---- */

static void prepare_body(baum_i_element *element)
{
  baum_i_body *body = (baum_i_body *)(void *)element;
  body->type = (const baum_i_body_type *)(const void *)element->definition;
  body->nq = body->type->positions ? body->type->positions(element->def) : body->type->nq;
  body->nv = body->type->size ? body->type->size(element->def) : body->type->nv;
  body->manifold = body->type->manifold ? body->type->manifold(element->def) : NULL;
}

static int body_rows(const baum_i_element *element)
{
  return ((const baum_i_body *)(const void *)element)->nv;
}

static void place_body(baum_i_element *element, const baum_i_totals *before)
{
  baum_i_body *body = (baum_i_body *)(void *)element;
  body->q = (int)before->positions;
  body->v = (int)before->rows;
  body->mass = (int)before->squares;
}

static void close_body_list(baum_mechanism *mechanism, const baum_i_totals *all)
{
  mechanism->nq = (int)all->positions;
  mechanism->nv = (int)all->rows;
  mechanism->mass_size = (int)all->squares;
}

const baum_i_family baum_i_body_family = {FAMILY_MEMBERS(body)};

/* ---- joints ---- */

static void prepare_joint(baum_i_element *element)
{
  baum_i_joint *joint = (baum_i_joint *)(void *)element;
  joint->type = (const baum_i_joint_type *)(const void *)element->definition;
  joint->rows = joint->type->rows ? joint->type->rows(element->def) : joint->type->row_count;
}

static int joint_rows(const baum_i_element *element)
{
  return ((const baum_i_joint *)(const void *)element)->rows;
}

static void place_joint(baum_i_element *element, const baum_i_totals *before)
{
  baum_i_joint *joint = (baum_i_joint *)(void *)element;
  joint->row = (int)before->rows;
  joint->jacobian = (int)before->blocks;
  joint->square = (int)before->squares;
  const baum_i_joint_type *type = joint->type;
  joint->velocity_rows =
    type->velocity_rows ? type->velocity_rows(joint->element.def) : type->velocity_row_count;
}

static void close_joint_list(baum_mechanism *mechanism, const baum_i_totals *all)
{
  mechanism->nc = (int)all->rows;
  mechanism->jacobian_size = (int)all->blocks;
  mechanism->joint_square_size = (int)all->squares;
}

const baum_i_family baum_i_joint_family = {FAMILY_MEMBERS(joint)};

/* ---- forces ---- */

static void prepare_force(baum_i_element *element)
{
  baum_i_force *force = (baum_i_force *)(void *)element;
  force->type = (const baum_i_force_type *)(const void *)element->definition;
}

static int force_rows(const baum_i_element *element)
{
  return ((const baum_i_force *)(const void *)element)->span.nl;
}

static void place_force(baum_i_element *element, const baum_i_totals *before)
{
  ((baum_i_force *)(void *)element)->square = (int)before->squares;
}

static void close_force_list(baum_mechanism *mechanism, const baum_i_totals *all)
{
  mechanism->force_square_size = (int)all->squares;
}

const baum_i_family baum_i_force_family = {FAMILY_MEMBERS(force)};

/* ---- all ---- */

const baum_i_family *const baum_i_families[BAUM_I_FAMILIES] = {
  &baum_i_body_family, &baum_i_joint_family, &baum_i_force_family};
