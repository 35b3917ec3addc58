/* SPDX-License-Identifier: BSD-3-Clause */
/* Which bodies are left out of the accelerations, and whether they rest; see immobile.h.
 *
 * With rows and columns of these bodies first, J of the rows that are kept is
 *
 *   [ A  0 ]   their own rows        A square and regular: their own rows are as many as their
 *   [ B  C ]   the rest              velocities, and independent
 *
 * so that C has independent rows as J has. Had another choice of redundant rows left fewer of their own, C
 * would be singular: then nothing is left out.
 */
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/message.h"
#include "dynamics/immobile.h"
#include "dynamics/islands.h"

/* Violation, as a displacement, of rows that are fulfilled: well above what assembly leaves. */
static const double FULFILLED = 1e-9;
/* Velocities, of the fastest, that assembly leaves where there should be none. */
static const double ROUNDING = 1e-12;

/* ---- which bodies and rows ---- */

static void clear(baum_i_left_out *out)
{
  baum_i_free(out->still);
  baum_i_free(out->joints);
  baum_i_free(out->omitted);
}

static baum_status make(const baum_mechanism *m, baum_i_left_out *out)
{
  out->still = baum_i_alloc((size_t)m->body_count, 1);
  out->joints = baum_i_alloc((size_t)m->joint_count, 1);
  out->omitted = baum_i_alloc((size_t)m->nc, 1);
  return out->still && out->joints && out->omitted ? BAUM_OK : baum_i_fail_memory();
}

static bool is_of(const baum_i_span *span, const bool *bodies)
{
  for (int i = 0; i < span->body_count; i++) {
    if (!bodies[span->bodies[i]]) {
      return false;
    }
  }
  return true;
}

/* The redundant ones and those of the joints. Returns how many of these are not redundant. */
static int drop_rows(const baum_workspace *w, baum_i_left_out *out)
{
  const baum_mechanism *m = w->mechanism;
  int kept = 0;
  for (int i = 0; i < m->nc; i++) {
    out->omitted[i] = w->redundancy.count > 0 ? w->redundancy.omitted[i] : 0;
    if (out->joints[baum_i_row_joint(m, i)]) {
      kept += out->omitted[i] ? 0 : 1;
      out->omitted[i] = 1;
    }
  }
  return kept;
}

/* The immobile bodies (ground among them) and all joints between them. Returns the rows kept of these less
 * the bodies' velocities. */
static int mark(const baum_workspace *w, const bool *immobile, baum_i_left_out *out)
{
  const baum_mechanism *m = w->mechanism;
  int surplus = 0;
  for (int i = 1; i <= m->body_count; i++) {
    out->still[i - 1] = immobile[i] ? 1 : 0;
    out->count += immobile[i] ? 1 : 0;
    surplus -= immobile[i] ? m->bodies[i]->nv : 0;
  }
  for (int k = 0; k < m->joint_count; k++) {
    out->joints[k] = is_of(&m->joints[k]->span, immobile) ? 1 : 0;
  }
  return surplus + drop_rows(w, out);
}

/* ---- do they rest? ---- */

/* A velocity that is rounding beside `rate`, the fastest of the state, becomes zero. */
static bool is_at_rest(const baum_mechanism *m, int k, double rate, double *v)
{
  if (fabs(v[k]) > ROUNDING * rate * m->scale[k]) {
    return false;
  }
  v[k] = 0.0;
  return true;
}

static bool are_at_rest(const baum_mechanism *m, const baum_i_left_out *left_out, double *v)
{
  double rate = baum_i_scaled_size(m, v);
  bool rest = true;
  for (int i = 1; i <= m->body_count; i++) {
    const baum_i_body *body = m->bodies[i];
    for (int k = body->v; left_out->still[i - 1] && k < body->v + body->nv; k++) {
      rest = rest && is_at_rest(m, k, rate, v);
    }
  }
  return rest;
}

/* After a position stage. */
static bool is_fulfilled(const baum_workspace *w, const baum_i_left_out *left_out)
{
  const baum_mechanism *m = w->mechanism;
  double *size = w->work_c;
  baum_i_row_displacements(w, size);
  for (int k = 0; k < m->joint_count; k++) {
    const baum_i_joint *joint = m->joints[k];
    for (int i = joint->row; left_out->joints[k] && i < joint->row + joint->rows; i++) {
      if (!(fabs(w->phi[i]) <= FULFILLED * size[i])) {
        return false;
      }
    }
  }
  return true;
}

void baum_i_look_at_immobile(baum_workspace *w, const double *q, double *v)
{
  baum_i_immobile *immobile = w->immobile;
  if (!immobile) {
    return;
  }
  double rate = baum_i_scaled_size(w->mechanism, v);
  immobile->rests = true;
  for (int i = 0; i < immobile->count; i++) {
    int k = immobile->velocity[i];
    double moved = fabs(q[k] - immobile->position[i]);
    bool is_there = moved <= FULFILLED * w->mechanism->scale[k];
    immobile->rests = immobile->rests && is_there && is_at_rest(w->mechanism, k, rate, v);
  }
}

/* ---- make and give up ---- */

/* Phi is of the position stage. */
static void remember_rows(const baum_workspace *w, const baum_i_left_out *left_out,
                          baum_i_immobile *out)
{
  const baum_mechanism *m = w->mechanism;
  for (int k = 0; k < m->joint_count; k++) {
    const baum_i_joint *joint = m->joints[k];
    for (int i = joint->row; left_out->joints[k] && i < joint->row + joint->rows; i++) {
      out->row[out->row_count] = i;
      out->phi[out->row_count++] = w->phi[i];
    }
  }
}

static baum_status remember(const baum_workspace *w, const baum_i_left_out *left_out,
                            const double *q, baum_i_immobile *out)
{
  const baum_mechanism *m = w->mechanism;
  out->row = baum_i_alloc((size_t)m->nc, sizeof *out->row);
  out->phi = baum_i_alloc((size_t)m->nc, sizeof *out->phi);
  out->velocity = baum_i_alloc((size_t)m->nv, sizeof *out->velocity);
  out->position = baum_i_alloc((size_t)m->nv, sizeof *out->position);
  if (!out->velocity || !out->position || !out->row || !out->phi) {
    return baum_i_fail_memory();
  }
  for (int i = 1; i <= m->body_count; i++) {
    const baum_i_body *body = m->bodies[i];
    for (int k = body->v; left_out->still[i - 1] && k < body->v + body->nv; k++) {
      out->velocity[out->count] = k;
      out->position[out->count++] = q[k];
    }
  }
  remember_rows(w, left_out, out);
  out->rests = true;
  return BAUM_OK;
}

void baum_i_immobile_destroy(baum_i_immobile *immobile)
{
  if (!immobile) {
    return;
  }
  baum_i_block_path_destroy(immobile->path);
  clear(&immobile->left_out);
  baum_i_free(immobile->velocity);
  baum_i_free(immobile->position);
  baum_i_free(immobile->row);
  baum_i_free(immobile->phi);
  baum_i_free(immobile);
}

/* Without the bodies; where blocks do not suit the rest either, all stays as it is. Takes over *left_out. */
static baum_status leave_out(baum_workspace *w, baum_i_left_out *left_out, const double *q)
{
  baum_i_immobile *immobile = baum_i_alloc(1, sizeof *immobile);
  if (!immobile) {
    return baum_i_fail_memory();
  }
  baum_i_block_verdict verdict;
  baum_status status = baum_i_block_path_create(w, left_out, &verdict, &immobile->path);
  if (status == BAUM_OK && immobile->path) {
    status = remember(w, left_out, q, immobile);
  }
  if (status != BAUM_OK || !immobile->path) {
    baum_i_immobile_destroy(immobile);
    return status;
  }
  immobile->left_out = *left_out;
  *left_out = (baum_i_left_out){0};
  w->immobile = immobile;
  return BAUM_OK;
}

baum_status baum_i_immobile_make_path(baum_workspace *w, baum_i_block_path **out)
{
  baum_i_immobile *immobile = w->immobile;
  baum_i_block_verdict verdict;
  *out = NULL;
  if (drop_rows(w, &immobile->left_out) != immobile->count) {
    return BAUM_OK;
  }
  return baum_i_block_path_create(w, &immobile->left_out, &verdict, out);
}

static baum_status try_to_leave_out(baum_workspace *w, double t, const double *q, double *v,
                                    const bool *immobile)
{
  baum_i_left_out left_out = {0};
  baum_status status = make(w->mechanism, &left_out);
  if (status == BAUM_OK && mark(w, immobile, &left_out) == 0 &&
      are_at_rest(w->mechanism, &left_out, v)) {
    status = baum_i_position_stage(w, t, q);
    if (status == BAUM_OK && is_fulfilled(w, &left_out)) {
      status = leave_out(w, &left_out, q);
    }
  }
  clear(&left_out);
  return status;
}

baum_status baum_i_leave_out_immobile(baum_workspace *w, double t, const double *q, double *v)
{
  baum_i_immobile_destroy(w->immobile);
  w->immobile = NULL;
  if (w->choice != BAUM_I_KKT_AUTO || !w->mechanism->flat) {
    return BAUM_OK;
  }
  baum_i_sentence kept;
  baum_i_message_keep(&kept);
  baum_i_islands islands;
  baum_status status = baum_i_find_islands(w, &islands);
  if (status == BAUM_OK && islands.immobile_count > 0) {
    status = try_to_leave_out(w, t, q, v, islands.immobile);
  }
  baum_i_islands_clear(&islands);
  return status == BAUM_ERR_MEMORY ? status : baum_i_message_settle(BAUM_OK, &kept);
}

/* ---- without them ---- */

baum_i_block_path *baum_i_motion_path(const baum_workspace *w)
{
  return w->immobile && w->immobile->rests ? w->immobile->path : w->path;
}

baum_i_block_path *baum_i_enter_motion(baum_workspace *w)
{
  baum_i_block_path *whole = w->path;
  w->path = baum_i_motion_path(w);
  return whole;
}

void baum_i_leave_motion(baum_workspace *w, baum_i_block_path *whole)
{
  w->jacobian_ready = w->jacobian_ready && w->path == whole;
  w->path = whole;
}

/* The rows that nothing evaluates, of which other states may have left something. */
static void set_rows_at_rest(baum_workspace *w)
{
  const baum_i_immobile *immobile = w->immobile;
  for (int i = 0; i < immobile->row_count; i++) {
    w->phi[immobile->row[i]] = immobile->phi[i];
    w->phi_rate[immobile->row[i]] = 0.0;
    w->gamma[immobile->row[i]] = 0.0;
  }
}

baum_status baum_i_motion(baum_workspace *w, double t, const double *q, const double *v,
                          double alpha, double beta)
{
  baum_i_block_path *whole = baum_i_enter_motion(w);
  baum_status status = baum_i_acceleration(w, t, q, v, alpha, beta);
  if (w->path != whole) {
    set_rows_at_rest(w);
  }
  baum_i_leave_motion(w, whole);
  return status;
}
