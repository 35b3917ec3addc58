/* SPDX-License-Identifier: BSD-3-Clause */
/* Freezing turns definitions into the constant structure of a mechanism.
 *
 * The columns and rows get indices in the order in which elements were added. Elements of one type
 * are collected in a group. All masses, lengths and other numbers are written to the parameter
 * array. If freezing fails, everything is undone, and the mechanism can still be changed.
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
  for (int i = 0; i < BAUM_I_FAMILIES; i++) {
    const baum_i_family *family = baum_i_families[i];
    for (int k = 0; k < baum_i_family_count(family, mechanism); k++) {
      drop_columns(baum_i_family_span(family, family->at(mechanism, k)));
    }
    family->free_groups(mechanism);
  }
  baum_i_free(mechanism->parameters);
  baum_i_free(mechanism->design_q);
  baum_i_free(mechanism->design_v);
  baum_i_free(mechanism->held);
  baum_i_free(mechanism->scale);
  baum_i_free(mechanism->position_scale);
  baum_i_free(mechanism->fixed_q);
  baum_i_free(mechanism->places);
  baum_i_free(mechanism->velocity_rows);
  baum_i_free(mechanism->row_gains);
  mechanism->parameters = NULL;
  mechanism->design_q = NULL;
  mechanism->design_v = NULL;
  mechanism->held = NULL;
  mechanism->scale = NULL;
  mechanism->position_scale = NULL;
  mechanism->fixed_q = NULL;
  mechanism->places = NULL;
  mechanism->velocity_rows = NULL;
  mechanism->row_gains = NULL;
  mechanism->frozen = false;
}

/* ---- numbering ---- */

/* Enlarge scratch_size so that it suffices for an element with this number of local columns and
 * rows. Returns false if the size would not fit into an int. */
static bool widen_scratch(baum_mechanism *mechanism, int columns, int rows)
{
  int64_t size = baum_i_scratch_size(columns, rows);
  if (size > INT_MAX) {
    return false;
  }
  if (size > mechanism->scratch_size) {
    mechanism->scratch_size = (int)size;
  }
  return true;
}

/* Append the velocities (columns) and positions of a body to the span of an element. */
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

static baum_status number_span(const baum_mechanism *mechanism, baum_i_span *span)
{
  size_t ql = 0;
  size_t nl = 0;
  for (int i = 0; i < span->body_count; i++) {
    ql += (size_t)mechanism->bodies[span->bodies[i]]->nq;
    nl += (size_t)mechanism->bodies[span->bodies[i]]->nv;
  }
  span->columns = baum_i_alloc(nl + ql, sizeof *span->columns);
  BAUM_I_TRY(baum_i_check_memory(span->columns));
  span->positions = span->columns + nl;
  span->nl = 0;
  span->ql = 0;
  span->flat = true;
  for (int i = 0; i < span->body_count; i++) {
    add_columns(mechanism->bodies[span->bodies[i]], span);
  }
  return BAUM_OK;
}

/* Give an element its columns, rows and blocks. Indices of the frozen structure are ints.
 * Mechanisms whose indices would overflow are refused. */
static baum_status number_element(baum_mechanism *mechanism, const baum_i_family *family,
                                  baum_i_element *element, baum_i_totals *totals)
{
  baum_i_span *span = baum_i_family_span(family, element);
  family->place(element, totals);
  BAUM_I_TRY(number_span(mechanism, span));
  const int rows = family->rows(element);
  totals->positions += span->ql;
  totals->rows += rows;
  totals->blocks += (int64_t)rows * span->nl;
  totals->squares += (int64_t)span->nl * span->nl;
  if (totals->blocks > INT_MAX || totals->squares > INT_MAX ||
      !widen_scratch(mechanism, span->ql > span->nl ? span->ql : span->nl, rows)) {
    return baum_i_fail(BAUM_ERR_ARGUMENT,
                       "%s: with this element the mechanism has more than %d matrix entries",
                       baum_i_label(element).text, INT_MAX);
  }
  element->parameter = mechanism->parameter_count;
  mechanism->parameter_count += element->definition->parameter_count;
  return BAUM_OK;
}

static baum_status number_family(baum_mechanism *mechanism, const baum_i_family *family)
{
  baum_i_totals totals = {0};
  BAUM_I_TRY(family->open_groups(mechanism));
  for (int k = 0; k < baum_i_family_count(family, mechanism); k++) {
    baum_i_element *element = family->at(mechanism, k);
    BAUM_I_TRY(number_element(mechanism, family, element, &totals));
    BAUM_I_TRY(family->join_group(mechanism, element));
  }
  family->close(mechanism, &totals);
  return BAUM_OK;
}

/* ---- characteristic length ---- */

/* Points are considered to coincide if their distance is below this fraction of their distance from
 * the origin, because a distance that is so small compared with the coordinates may be a rounding
 * error. */
static const double COINCIDENT = 1e-12;

void baum_i_box_include(baum_i_box *box, double x, double y, double z)
{
  const double at[3] = {x, y, z};
  for (int i = 0; i < 3; i++) {
    box->low[i] = fmin(box->low[i], at[i]);
    box->high[i] = fmax(box->high[i], at[i]);
  }
}

/* Return the size of the design configuration. This is the diagonal of the box around all bodies
 * and all points of joints. If there are no such points, as in a mechanism that has only user
 * coordinates, the size is 1. */
static double design_size(const baum_mechanism *mechanism)
{
  baum_i_box b = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
  for (int i = 1; i <= mechanism->body_count; i++) {
    if (mechanism->bodies[i]->type->frame != BAUM_I_FRAME_NONE) {
      const baum_i_spatial_frame f = baum_i_spatial_design_frame(mechanism, i);
      baum_i_box_include(&b, f.r[0], f.r[1], f.r[2]);
    }
  }
  for (int i = 0; i < mechanism->joint_count; i++) {
    const baum_i_joint *joint = mechanism->joints[i];
    if (joint->type->extent) {
      joint->type->extent(mechanism, joint, &b);
    }
  }
  double diagonal = hypot(hypot(b.high[0] - b.low[0], b.high[1] - b.low[1]), b.high[2] - b.low[2]);
  double offset = hypot(hypot(b.low[0], b.low[1]), b.low[2]);
  if (isfinite(diagonal) && diagonal > COINCIDENT * offset) {
    return diagonal;
  }
  /* All points coincide up to rounding. Take their distance from the origin. */
  return isfinite(offset) && offset > 0.0 ? offset : 1.0;
}

/* ---- numbers ---- */

static baum_status make_arrays(baum_mechanism *mechanism)
{
  size_t nq = (size_t)mechanism->nq;
  size_t nv = (size_t)mechanism->nv;
  mechanism->parameters = baum_i_alloc((size_t)mechanism->parameter_count, sizeof(double));
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

/* Mark the rows of velocity level. Their stabilized equation is J a = gamma - alpha (J v - nu).
 * Position-level rows have the factor 2 alpha instead of alpha. Therefore `row_gains` is 1/2 for
 * rows of velocity level. */
static baum_status mark_velocity_rows(baum_mechanism *m)
{
  m->velocity_row_count = 0;
  for (int k = 0; k < m->joint_count; k++) {
    m->velocity_row_count += m->joints[k]->velocity_rows;
  }
  if (m->velocity_row_count == 0) {
    return BAUM_OK;
  }
  m->velocity_rows = baum_i_alloc((size_t)m->nc, 1);
  m->row_gains = baum_i_alloc((size_t)m->nc, sizeof *m->row_gains);
  if (!m->velocity_rows || !m->row_gains) {
    return baum_i_fail_memory();
  }
  for (int k = 0; k < m->joint_count; k++) {
    const baum_i_joint *joint = m->joints[k];
    for (int i = 0; i < joint->rows; i++) {
      bool marked = i >= joint->rows - joint->velocity_rows;
      m->velocity_rows[joint->row + i] = marked ? 1 : 0;
      m->row_gains[joint->row + i] = marked ? 0.5 : 1.0;
    }
  }
  return BAUM_OK;
}

/* Mark the bodies of a spatial element, because the element reads their frames in space. */
static void mark_in_space(baum_mechanism *m, const baum_i_span *span)
{
  m->spatial = true;
  for (int k = 0; k < span->body_count; k++) {
    m->places[span->bodies[k]].in_space = 1;
  }
}

static void mark_spatial_elements(baum_mechanism *m)
{
  for (int i = 0; i < m->joint_count; i++) {
    if (m->joints[i]->type->width == BAUM_I_SPACE) {
      mark_in_space(m, &m->joints[i]->span);
    }
  }
  for (int i = 0; i < m->force_count; i++) {
    if (m->forces[i]->type->spatial) {
      mark_in_space(m, &m->forces[i]->span);
    }
  }
}

static void place_bodies(baum_mechanism *mechanism)
{
  mechanism->length =
    isnan(mechanism->given_length) ? design_size(mechanism) : mechanism->given_length;
  mechanism->all_planar = true;
  mechanism->constant_mass = true;
  mechanism->flat = true;
  mechanism->spatial = false;
  for (int i = 1; i <= mechanism->body_count; i++) {
    const baum_i_body *body = mechanism->bodies[i];
    bool held = false;
    if (body->type->lower) {
      body->type->lower(body, mechanism->parameters + body->element.parameter);
    }
    mechanism->flat &= !body->manifold;
    const bool spatial = baum_i_is_spatial(body->type->frame);
    mechanism->spatial |= spatial;
    mechanism->places[i] = (baum_i_body_place){
      .q = body->q, .v = body->v, .kind = body->type->frame, .in_space = spatial ? 1 : 0};
    mechanism->all_planar = mechanism->all_planar && body->type->frame == BAUM_I_FRAME_BODY;
    mechanism->constant_mass &=
      !body->type->constant_mass || body->type->constant_mass(body->element.def);
    body->type->design(body->element.def, mechanism->design_q + body->q,
                       mechanism->design_v + body->v, &held);
    body->type->scale(body->element.def, mechanism->length, mechanism->scale + body->v);
    (body->manifold ? body->type->position_scale : body->type->scale)(
      body->element.def, mechanism->length, mechanism->position_scale + body->q);
    for (int j = 0; j < body->nv; j++) {
      mechanism->held[body->v + j] = held;
    }
  }
  mark_spatial_elements(mechanism);
}

static baum_status lower_elements(baum_mechanism *m)
{
  for (int i = 0; i < m->joint_count; i++) {
    const baum_i_joint *joint = m->joints[i];
    if (joint->type->lower) {
      BAUM_I_TRY(joint->type->lower(m, joint, m->parameters + joint->element.parameter));
    }
  }
  for (int i = 0; i < m->force_count; i++) {
    const baum_i_force *force = m->forces[i];
    if (force->type->lower) {
      BAUM_I_TRY(force->type->lower(m, force, m->parameters + force->element.parameter));
    }
  }
  return BAUM_OK;
}

/* ---- freeze ---- */

static baum_status build(baum_mechanism *mechanism)
{
  mechanism->scratch_size = 0;
  mechanism->parameter_count = 0;
  for (int i = 0; i < BAUM_I_FAMILIES; i++) {
    BAUM_I_TRY(number_family(mechanism, baum_i_families[i]));
  }
  BAUM_I_TRY(make_arrays(mechanism));
  BAUM_I_TRY(mark_velocity_rows(mechanism));
  place_bodies(mechanism);
  BAUM_I_TRY(lower_elements(mechanism));
  baum_i_find_fixed_bodies(mechanism);
  return BAUM_OK;
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
