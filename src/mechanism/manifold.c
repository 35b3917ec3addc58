/* SPDX-License-Identifier: BSD-3-Clause */
/* Functions on the configuration manifold of a mechanism. They process one body after the other. */
#include "mechanism/manifold.h"

#include <math.h>
#include <string.h>

/* ---- one body; q, v and dx point to the first entry of this body ---- */

static void rate_body(const baum_i_body *body, const double *q, const double *v, double *dq)
{
  if (body->manifold) {
    body->manifold->rate(body, q, v, dq);
  } else {
    memcpy(dq, v, (size_t)body->nv * sizeof *v);
  }
}

static void move_body(const baum_i_body *body, double h, const double *v, double *q)
{
  if (body->manifold) {
    body->manifold->move(body, h, v, q);
    /* otherwise the rounding errors of many moves would add up */
    body->manifold->normalize(body, q);
  } else {
    baum_i_add_scaled(body->nv, h, v, q);
  }
}

static void subtract(int count, const double *from, const double *to, double *dx)
{
  for (int i = 0; i < count; i++) {
    dx[i] = to[i] - from[i];
  }
}

/* Set out = q + h dq, then normalize `out`. */
static void shift_body(const baum_i_body *body, double h, const double *dq, const double *q,
                       double *out)
{
  for (int i = 0; i < body->nq; i++) {
    out[i] = q[i] + h * dq[i];
  }
  body->manifold->normalize(body, out);
}

/* The step of central differences, relative to the scales of the coordinates. The truncation error
 * is about STEP^2, and rounding errors are divided by STEP. */
static const double STEP = 1e-5;

static void tangent_body(const baum_i_body *body, const double *scale, const double *q,
                         const double *dq, double *dx, double *work)
{
  if (body->manifold->tangent) {
    body->manifold->tangent(body, q, dq, dx);
    return;
  }
  double size = 0.0;
  for (int i = 0; i < body->nq; i++) {
    size = fmax(size, fabs(dq[i]) / scale[i]);
  }
  double h = size > 0.0 ? STEP / size : 0.0;
  shift_body(body, -h, dq, q, work);
  shift_body(body, h, dq, q, work + body->nq);
  body->manifold->difference(body, work, work + body->nq, dx);
  for (int i = 0; i < body->nv; i++) {
    dx[i] = h > 0.0 ? dx[i] / (2.0 * h) : 0.0;
  }
}

/* Set dq = N v at a neighbouring configuration, which is q moved by h along velocity coordinate j.
 * direction (nv) and moved (nq) are scratch memory. */
static void rate_beside(const baum_i_body *body, double h, int j, const double *q, const double *v,
                        double *dq, double *direction, double *moved)
{
  for (int i = 0; i < body->nv; i++) {
    direction[i] = i == j ? 1.0 : 0.0;
  }
  memcpy(moved, q, (size_t)body->nq * sizeof *q);
  body->manifold->move(body, h, direction, moved);
  body->manifold->rate(body, moved, v, dq);
}

/* Follow a motion with constant acceleration a from q and v for the duration h, and set dq = N v at
 * its end. work (2 nq) is scratch memory. */
static void rate_later(const baum_i_body *body, double h, const double *q, const double *v,
                       const double *a, double *dq, double *work)
{
  double *mean = work + body->nq;
  for (int i = 0; i < body->nv; i++) {
    mean[i] = v[i] + 0.5 * h * a[i];
  }
  memcpy(work, q, (size_t)body->nq * sizeof *q);
  body->manifold->move(body, h, mean, work);
  for (int i = 0; i < body->nv; i++) {
    mean[i] = v[i] + h * a[i];
  }
  body->manifold->rate(body, work, mean, dq);
}

static void second_rate_body(const baum_mechanism *m, const baum_i_body *body, const double *q,
                             const double *v, const double *a, double *ddq, double *work)
{
  if (body->manifold->second_rate) {
    body->manifold->second_rate(body, q, v, a, ddq);
    return;
  }
  double speed = 0.0;
  for (int i = 0; i < body->nv; i++) {
    double scale = m->scale[body->v + i];
    speed = fmax(speed, fmax(fabs(v[i]) / scale, sqrt(fabs(a[i]) / scale)));
  }
  double h = speed > 0.0 ? STEP / speed : 1.0;
  rate_later(body, -h, q, v, a, work, work + body->nq);
  rate_later(body, h, q, v, a, ddq, work + body->nq);
  for (int i = 0; i < body->nq; i++) {
    ddq[i] = (ddq[i] - work[i]) / (2.0 * h);
  }
}

static void linearize_body(const baum_mechanism *m, const baum_i_body *body, const double *q,
                           const double *v, double *block, double *work)
{
  double *ahead = work;
  double *behind = ahead + body->nq;
  double *moved = behind + body->nq;
  double *column = moved + 2 * (size_t)body->nq;
  double *direction = column + body->nq;
  for (int j = 0; j < body->nv; j++) {
    double h = STEP * m->scale[body->v + j];
    rate_beside(body, h, j, q, v, ahead, direction, moved);
    rate_beside(body, -h, j, q, v, behind, direction, moved);
    for (int i = 0; i < body->nq; i++) {
      ahead[i] = (ahead[i] - behind[i]) / (2.0 * h);
    }
    tangent_body(body, m->position_scale + body->q, q, ahead, column, moved);
    for (int i = 0; i < body->nv; i++) {
      block[i * body->nv + j] = column[i];
    }
  }
}

/* ---- all bodies ---- */

void baum_i_point_set_normalized(baum_i_point *point, double t, const double *q, const double *v)
{
  memcpy(point->normalized, q, (size_t)point->mechanism->nq * sizeof *q);
  baum_i_normalize_bodies(point->mechanism, point->normalized);
  baum_i_point_set_vector(point, t, point->normalized, v);
}

void baum_i_rate_bodies(const baum_mechanism *m, const double *q, const double *v, double *dq)
{
  for (int k = 1; k <= m->body_count; k++) {
    const baum_i_body *body = m->bodies[k];
    rate_body(body, q + body->q, v + body->v, dq + body->q);
  }
}

void baum_i_move_bodies(const baum_mechanism *m, double h, const double *v, double *q)
{
  for (int k = 1; k <= m->body_count; k++) {
    const baum_i_body *body = m->bodies[k];
    move_body(body, h, v + body->v, q + body->q);
  }
}

void baum_i_difference(const baum_mechanism *m, const double *from, const double *to, double *dx)
{
  if (m->flat) {
    subtract(m->nv, from, to, dx);
    return;
  }
  for (int k = 1; k <= m->body_count; k++) {
    const baum_i_body *body = m->bodies[k];
    if (body->manifold) {
      body->manifold->difference(body, from + body->q, to + body->q, dx + body->v);
    } else {
      subtract(body->nv, from + body->q, to + body->q, dx + body->v);
    }
  }
}

void baum_i_normalize_bodies(const baum_mechanism *m, double *q)
{
  for (int k = 1; k <= m->body_count; k++) {
    const baum_i_body *body = m->bodies[k];
    if (body->manifold) {
      body->manifold->normalize(body, q + body->q);
    }
  }
}

const double *baum_i_second_rates_of_bodies(const baum_mechanism *m, const double *q,
                                            const double *v, const double *a, double *room)
{
  for (int k = 1; k <= m->body_count; k++) {
    const baum_i_body *body = m->bodies[k];
    if (body->manifold) {
      second_rate_body(m, body, q + body->q, v + body->v, a + body->v, room + body->q,
                       room + m->nq);
    } else {
      memcpy(room + body->q, a + body->v, (size_t)body->nv * sizeof *a);
    }
  }
  return room;
}

const double *baum_i_tangent_of_bodies(const baum_mechanism *m, const double *q, const double *dq,
                                       double *room)
{
  for (int k = 1; k <= m->body_count; k++) {
    const baum_i_body *body = m->bodies[k];
    if (body->manifold) {
      tangent_body(body, m->position_scale + body->q, q + body->q, dq + body->q, room + body->v,
                   room + m->nq);
    } else {
      memcpy(room + body->v, dq + body->q, (size_t)body->nv * sizeof *dq);
    }
  }
  return room;
}

void baum_i_linearize_rate(const baum_mechanism *m, const double *q, const double *v,
                           double *blocks, double *work)
{
  for (int k = 1; k <= m->body_count; k++) {
    const baum_i_body *body = m->bodies[k];
    if (body->manifold) {
      linearize_body(m, body, q + body->q, v + body->v, blocks + body->mass, work);
    }
  }
}

void baum_i_span_move(const baum_mechanism *m, const baum_i_span *span, double h, const double *v,
                      double *q)
{
  for (int i = 0; i < span->nl;) {
    const baum_i_body *body = baum_i_velocity_body(m, span->columns[i]);
    move_body(body, h, v + i, q);
    q += body->nq;
    i += body->nv;
  }
}
