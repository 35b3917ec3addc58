/* SPDX-License-Identifier: BSD-3-Clause */
/* Freezing: from definitions to the constant structure.
 *
 * Columns and rows are numbered in the order of adding; elements of one type are gathered into
 * groups; every number goes into the parameter array. On failure everything is undone and the
 * mechanism stays open.
 */
#include <limits.h>
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/message.h"
#include "mechanism/general/user_function.h"
#include "mechanism/mechanism.h"

/* ---- undo ---- */

static void drop_columns(baum_i_span *span)
{
  baum_i_free(span->columns);
  span->columns = NULL;
  span->positions = NULL;
  span->nl = 0;
  span->ql = 0;
}

void baum_i_mechanism_thaw(baum_mechanism *mechanism)
{
  for (int i = 1; mechanism->bodies && i <= mechanism->body_count; i++) {
    drop_columns(&mechanism->bodies[i]->span);
  }
  for (int i = 0; i < mechanism->joint_count; i++) {
    drop_columns(&mechanism->joints[i]->span);
  }
  for (int i = 0; i < mechanism->force_count; i++) {
    drop_columns(&mechanism->forces[i]->span);
  }
  for (int k = 0; k < mechanism->body_group_count; k++) {
    baum_i_free(mechanism->body_groups[k].bodies);
  }
  for (int k = 0; k < mechanism->joint_group_count; k++) {
    baum_i_free(mechanism->joint_groups[k].joints);
  }
  for (int k = 0; k < mechanism->force_group_count; k++) {
    baum_i_free(mechanism->force_groups[k].forces);
  }
  baum_i_free(mechanism->body_groups);
  baum_i_free(mechanism->joint_groups);
  baum_i_free(mechanism->force_groups);
  baum_i_free(mechanism->parameters);
  baum_i_free(mechanism->design_q);
  baum_i_free(mechanism->design_v);
  baum_i_free(mechanism->held);
  baum_i_free(mechanism->scale);
  baum_i_free(mechanism->position_scale);
  baum_i_free(mechanism->fixed_q);
  baum_i_free(mechanism->places);
  mechanism->body_groups = NULL;
  mechanism->joint_groups = NULL;
  mechanism->force_groups = NULL;
  mechanism->body_group_count = 0;
  mechanism->joint_group_count = 0;
  mechanism->force_group_count = 0;
  mechanism->parameters = NULL;
  mechanism->design_q = NULL;
  mechanism->design_v = NULL;
  mechanism->held = NULL;
  mechanism->scale = NULL;
  mechanism->position_scale = NULL;
  mechanism->fixed_q = NULL;
  mechanism->places = NULL;
  mechanism->frozen = false;
}

/* ---- numbering ---- */

/* Every index of the frozen structure is an int; what would not fit is refused here. */
static bool fits(int present, int64_t more)
{
  return more <= INT_MAX - present;
}

static baum_status fail_too_large(const baum_i_element *element, const char *family)
{
  char label[BAUM_I_LABEL_SIZE];
  return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: the mechanism has more than %d matrix entries here",
                     baum_i_label(element, family, label), INT_MAX);
}

/* Scratch memory for the largest element: that many local columns and rows. False when it is too
 * large. */
static bool widen_scratch(baum_mechanism *mechanism, int columns, int rows)
{
  int64_t size = baum_i_scratch_size(columns, rows);
  if (!fits(0, size)) {
    return false;
  }
  if (size > mechanism->scratch_size) {
    mechanism->scratch_size = (int)size;
  }
  return true;
}

static int larger(int a, int b)
{
  return a > b ? a : b;
}

static baum_status number_bodies(baum_mechanism *mechanism, int *parameters)
{
  mechanism->nq = 0;
  mechanism->nv = 0;
  mechanism->mass_size = 0;
  mechanism->constant_mass = true;
  mechanism->flat = true;
  for (int i = 1; i <= mechanism->body_count; i++) {
    baum_i_body *body = mechanism->bodies[i];
    if (!fits(mechanism->mass_size, (int64_t)body->nv * body->nv) ||
        !widen_scratch(mechanism, larger(body->nq, body->nv), body->nv)) {
      return fail_too_large(&body->element, "body");
    }
    body->q = mechanism->nq;
    body->v = mechanism->nv;
    body->mass = mechanism->mass_size;
    body->element.parameter = *parameters;
    *parameters += body->type->parameter_count;
    mechanism->nq += body->nq;
    mechanism->nv += body->nv;
    mechanism->mass_size += body->nv * body->nv;
    mechanism->constant_mass &= body->type->constant_mass(body->element.def);
    mechanism->flat &= !body->manifold;
  }
  return BAUM_OK;
}

/* Columns of a body behind those that the span has. */
static void add_columns(const baum_i_body *body, baum_i_span *span)
{
  for (int j = 0; j < body->nv; j++) {
    span->columns[span->nl++] = body->v + j;
  }
  for (int j = 0; j < body->nq; j++) {
    span->positions[span->ql++] = body->q + j;
  }
  span->flat &= !body->manifold;
}

static baum_status make_columns(baum_i_span *span, int ql, int nl)
{
  span->columns = baum_i_alloc((size_t)nl + (size_t)ql, sizeof *span->columns);
  if (!span->columns) {
    return baum_i_fail_memory();
  }
  span->positions = span->columns + nl;
  span->nl = 0;
  span->ql = 0;
  span->flat = true;
  return BAUM_OK;
}

static baum_status number_span(const baum_mechanism *mechanism, baum_i_span *span)
{
  int ql = 0;
  int nl = 0;
  for (int i = 0; i < span->body_count; i++) {
    ql += mechanism->bodies[span->bodies[i]]->nq;
    nl += mechanism->bodies[span->bodies[i]]->nv;
  }
  BAUM_I_TRY(make_columns(span, ql, nl));
  for (int i = 0; i < span->body_count; i++) {
    add_columns(mechanism->bodies[span->bodies[i]], span);
  }
  return BAUM_OK;
}

static baum_status number_body_spans(baum_mechanism *mechanism)
{
  for (int i = 1; i <= mechanism->body_count; i++) {
    baum_i_body *body = mechanism->bodies[i];
    BAUM_I_TRY(make_columns(&body->span, body->nq, body->nv));
    add_columns(body, &body->span);
  }
  return BAUM_OK;
}

static baum_status number_joints(baum_mechanism *mechanism, int *parameters)
{
  mechanism->nc = 0;
  mechanism->jacobian_size = 0;
  mechanism->joint_square_size = 0;
  for (int i = 0; i < mechanism->joint_count; i++) {
    baum_i_joint *joint = mechanism->joints[i];
    baum_status status = number_span(mechanism, &joint->span);
    if (status != BAUM_OK) {
      return status;
    }
    int nl = joint->span.nl;
    if (!fits(mechanism->jacobian_size, (int64_t)joint->rows * nl) ||
        !fits(mechanism->joint_square_size, (int64_t)nl * nl) ||
        !widen_scratch(mechanism, larger(joint->span.ql, nl), joint->rows)) {
      return fail_too_large(&joint->element, "joint");
    }
    joint->row = mechanism->nc;
    joint->jacobian = mechanism->jacobian_size;
    joint->square = mechanism->joint_square_size;
    joint->element.parameter = *parameters;
    *parameters += joint->type->parameter_count;
    mechanism->nc += joint->rows;
    mechanism->jacobian_size += joint->rows * nl;
    mechanism->joint_square_size += nl * nl;
  }
  return BAUM_OK;
}

static baum_status number_forces(baum_mechanism *mechanism, int *parameters)
{
  mechanism->force_square_size = 0;
  for (int i = 0; i < mechanism->force_count; i++) {
    baum_i_force *force = mechanism->forces[i];
    baum_status status = number_span(mechanism, &force->span);
    if (status != BAUM_OK) {
      return status;
    }
    int nl = force->span.nl;
    if (!fits(mechanism->force_square_size, (int64_t)nl * nl) ||
        !widen_scratch(mechanism, larger(force->span.ql, nl), nl)) {
      return fail_too_large(&force->element, "force");
    }
    force->square = mechanism->force_square_size;
    force->element.parameter = *parameters;
    *parameters += force->type->parameter_count;
    mechanism->force_square_size += nl * nl;
  }
  return BAUM_OK;
}

/* ---- groups ---- */

static baum_i_body_group *body_group(baum_mechanism *mechanism, const baum_i_body_type *type)
{
  int k = 0;
  while (k < mechanism->body_group_count && mechanism->body_groups[k].type != type) {
    k++;
  }
  if (k == mechanism->body_group_count) {
    mechanism->body_groups[k].type = type;
    mechanism->body_groups[k].bodies =
      baum_i_alloc((size_t)mechanism->body_count, sizeof(baum_i_body *));
    mechanism->body_group_count += mechanism->body_groups[k].bodies ? 1 : 0;
  }
  return mechanism->body_groups[k].bodies ? &mechanism->body_groups[k] : NULL;
}

static baum_i_joint_group *joint_group(baum_mechanism *mechanism, const baum_i_joint_type *type)
{
  int k = 0;
  while (k < mechanism->joint_group_count && mechanism->joint_groups[k].type != type) {
    k++;
  }
  if (k == mechanism->joint_group_count) {
    mechanism->joint_groups[k].type = type;
    mechanism->joint_groups[k].joints =
      baum_i_alloc((size_t)mechanism->joint_count, sizeof(baum_i_joint *));
    mechanism->joint_group_count += mechanism->joint_groups[k].joints ? 1 : 0;
  }
  return mechanism->joint_groups[k].joints ? &mechanism->joint_groups[k] : NULL;
}

static baum_i_force_group *force_group(baum_mechanism *mechanism, const baum_i_force_type *type)
{
  int k = 0;
  while (k < mechanism->force_group_count && mechanism->force_groups[k].type != type) {
    k++;
  }
  if (k == mechanism->force_group_count) {
    mechanism->force_groups[k].type = type;
    mechanism->force_groups[k].forces =
      baum_i_alloc((size_t)mechanism->force_count, sizeof(baum_i_force *));
    mechanism->force_group_count += mechanism->force_groups[k].forces ? 1 : 0;
  }
  return mechanism->force_groups[k].forces ? &mechanism->force_groups[k] : NULL;
}

static baum_status make_groups(baum_mechanism *mechanism)
{
  mechanism->body_groups =
    baum_i_alloc((size_t)mechanism->body_count, sizeof *mechanism->body_groups);
  mechanism->joint_groups =
    baum_i_alloc((size_t)mechanism->joint_count, sizeof *mechanism->joint_groups);
  mechanism->force_groups =
    baum_i_alloc((size_t)mechanism->force_count, sizeof *mechanism->force_groups);
  if (!mechanism->body_groups || !mechanism->joint_groups || !mechanism->force_groups) {
    return baum_i_fail_memory();
  }
  for (int i = 1; i <= mechanism->body_count; i++) {
    baum_i_body_group *group = body_group(mechanism, mechanism->bodies[i]->type);
    if (!group) {
      return baum_i_fail_memory();
    }
    group->bodies[group->count++] = mechanism->bodies[i];
  }
  for (int i = 0; i < mechanism->joint_count; i++) {
    baum_i_joint_group *group = joint_group(mechanism, mechanism->joints[i]->type);
    if (!group) {
      return baum_i_fail_memory();
    }
    group->joints[group->count++] = mechanism->joints[i];
  }
  for (int i = 0; i < mechanism->force_count; i++) {
    baum_i_force_group *group = force_group(mechanism, mechanism->forces[i]->type);
    if (!group) {
      return baum_i_fail_memory();
    }
    group->forces[group->count++] = mechanism->forces[i];
  }
  return BAUM_OK;
}

/* ---- length scale ---- */

void baum_i_box_include(baum_i_box *box, double x, double y)
{
  box->low[0] = fmin(box->low[0], x);
  box->low[1] = fmin(box->low[1], y);
  box->high[0] = fmax(box->high[0], x);
  box->high[1] = fmax(box->high[1], y);
}

/* Size of the drawing: the diagonal of the box around all bodies, and points of planar joints. 1
 * when it has none, as with user coordinates only. */
static double design_size(const baum_mechanism *mechanism)
{
  baum_i_box b = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};
  for (int i = 1; i <= mechanism->body_count; i++) {
    if (mechanism->bodies[i]->type->frame != BAUM_I_FRAME_NONE) {
      baum_i_frame f = baum_i_design_frame(mechanism, i);
      baum_i_box_include(&b, f.x, f.y);
    }
  }
  for (int i = 0; i < mechanism->joint_count; i++) {
    const baum_i_joint *joint = mechanism->joints[i];
    if (joint->type->extent) {
      joint->type->extent(mechanism, joint, &b);
    }
  }
  double diagonal = hypot(b.high[0] - b.low[0], b.high[1] - b.low[1]);
  if (isfinite(diagonal) && diagonal > 0.0) {
    return diagonal;
  }
  double offset = hypot(b.low[0], b.low[1]); /* one particle: its distance from the origin */
  return isfinite(offset) && offset > 0.0 ? offset : 1.0;
}

/* ---- numbers ---- */

static baum_status make_arrays(baum_mechanism *mechanism, int parameters)
{
  size_t nq = (size_t)mechanism->nq;
  size_t nv = (size_t)mechanism->nv;
  mechanism->parameter_count = parameters;
  mechanism->parameters = baum_i_alloc((size_t)parameters, sizeof(double));
  mechanism->design_q = baum_i_alloc(nq, sizeof(double));
  mechanism->design_v = baum_i_alloc(nv, sizeof(double));
  mechanism->held = baum_i_alloc(nv, sizeof(bool));
  mechanism->scale = baum_i_alloc(nv, sizeof(double));
  mechanism->position_scale = baum_i_alloc(nq, sizeof(double));
  mechanism->fixed_q = baum_i_alloc(nq, sizeof(double));
  mechanism->places = baum_i_alloc((size_t)mechanism->body_count + 1, sizeof(baum_i_body_place));
  bool complete = mechanism->parameters && mechanism->design_q && mechanism->design_v &&
                  mechanism->held && mechanism->scale && mechanism->position_scale &&
                  mechanism->fixed_q && mechanism->places;
  return complete ? BAUM_OK : baum_i_fail_memory();
}

static void draw_bodies(baum_mechanism *mechanism)
{
  mechanism->length =
    isnan(mechanism->given_length) ? design_size(mechanism) : mechanism->given_length;
  mechanism->all_planar = true;
  for (int i = 1; i <= mechanism->body_count; i++) {
    const baum_i_body *body = mechanism->bodies[i];
    bool held = false;
    if (body->type->lower) {
      body->type->lower(body, mechanism->parameters + body->element.parameter);
    }
    mechanism->places[i] =
      (baum_i_body_place){.q = body->q, .v = body->v, .kind = body->type->frame};
    mechanism->all_planar = mechanism->all_planar && body->type->frame == BAUM_I_FRAME_BODY;
    body->type->design(body->element.def, mechanism->design_q + body->q,
                       mechanism->design_v + body->v, &held);
    body->type->scale(body->element.def, mechanism->length, mechanism->scale + body->v);
    (body->manifold ? body->type->position_scale : body->type->scale)(
      body->element.def, mechanism->length, mechanism->position_scale + body->q);
    for (int j = 0; j < body->nv; j++) {
      mechanism->held[body->v + j] = held;
    }
  }
}

static baum_status lower(baum_mechanism *mechanism)
{
  baum_status status = BAUM_OK;
  for (int i = 0; i < mechanism->joint_count && status == BAUM_OK; i++) {
    const baum_i_joint *joint = mechanism->joints[i];
    if (joint->type->lower) {
      status =
        joint->type->lower(mechanism, joint, mechanism->parameters + joint->element.parameter);
    }
  }
  for (int i = 0; i < mechanism->force_count && status == BAUM_OK; i++) {
    const baum_i_force *force = mechanism->forces[i];
    if (force->type->lower) {
      status =
        force->type->lower(mechanism, force, mechanism->parameters + force->element.parameter);
    }
  }
  return status;
}

/* ---- the whole ---- */

static baum_status build(baum_mechanism *mechanism)
{
  int parameters = 0;
  mechanism->scratch_size = 0;
  baum_status status = number_bodies(mechanism, &parameters);
  if (status == BAUM_OK) {
    status = number_body_spans(mechanism);
  }
  if (status == BAUM_OK) {
    status = number_joints(mechanism, &parameters);
  }
  if (status == BAUM_OK) {
    status = number_forces(mechanism, &parameters);
  }
  if (status == BAUM_OK) {
    status = make_groups(mechanism);
  }
  if (status == BAUM_OK) {
    status = make_arrays(mechanism, parameters);
  }
  if (status == BAUM_OK) {
    draw_bodies(mechanism);
    status = lower(mechanism);
  }
  if (status == BAUM_OK) {
    baum_i_find_fixed_bodies(mechanism);
  }
  return status;
}

baum_status baum_mechanism_freeze(baum_mechanism *mechanism)
{
  if (!mechanism) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "baum_mechanism_freeze: the mechanism is NULL");
  }
  if (mechanism->frozen) {
    return BAUM_OK;
  }
  if (mechanism->body_count == 0) {
    return baum_i_fail(BAUM_ERR_STATE, "baum_mechanism_freeze: the mechanism has no body");
  }
  baum_status status = build(mechanism);
  if (status != BAUM_OK) {
    baum_i_mechanism_thaw(mechanism);
    return status;
  }
  mechanism->frozen = true;
  return BAUM_OK;
}
