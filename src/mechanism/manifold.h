/* SPDX-License-Identifier: BSD-3-Clause */
/* The configuration manifold: positions q (nq), velocities v (nv) and q' = N(q) v.
 *
 * If q of every body is a vector (mechanism->flat), N is the identity and moving q is an addition.
 * Otherwise `move` moves q and `difference` compares configurations; vectors of length nv are never
 * added to q. Integrators that combine rates q' = N v, which have length nq, add these to q and
 * normalize the configurations that they accept.
 */
#ifndef BAUM_I_MECHANISM_MANIFOLD_H
#define BAUM_I_MECHANISM_MANIFOLD_H

#include <string.h>

#include "mechanism/mechanism.h"

/* ---- for mechanisms that are not flat; documented below under names without `bodies` ---- */

void baum_i_rate_bodies(const baum_mechanism *mechanism, const double *q, const double *v,
                        double *dq);
void baum_i_move_bodies(const baum_mechanism *mechanism, double h, const double *v, double *q);
void baum_i_normalize_bodies(const baum_mechanism *mechanism, double *q);
const double *baum_i_second_rates_of_bodies(const baum_mechanism *mechanism, const double *q,
                                            const double *v, const double *a, double *room);
const double *baum_i_tangent_of_bodies(const baum_mechanism *mechanism, const double *q,
                                       const double *dq, double *room);

/* ---- for all mechanisms ---- */

/* y += h x; x and y do not overlap. */
static inline void baum_i_add_scaled(int n, double h, const double *restrict x, double *restrict y)
{
  for (int i = 0; i < n; i++) {
    y[i] += h * x[i];
  }
}

/* Set dq (nq) = N(q) v. q may be slightly off the manifold, as in the stages of an integrator. */
static inline void baum_i_rate(const baum_mechanism *mechanism, const double *q, const double *v,
                               double *dq)
{
  if (mechanism->flat) {
    memcpy(dq, v, (size_t)mechanism->nv * sizeof *v);
  } else {
    baum_i_rate_bodies(mechanism, q, v, dq);
  }
}

/* Move q by h v (nv). The result is the configuration after the time h at constant v, to second
 * order in h, and is on the manifold. */
static inline void baum_i_move(const baum_mechanism *mechanism, double h, const double *v,
                               double *q)
{
  if (!mechanism->flat) {
    baum_i_move_bodies(mechanism, h, v, q);
    return;
  }
  baum_i_add_scaled(mechanism->nv, h, v, q);
}

/* Set q to `from` moved by h v. `from` and q do not overlap. */
static inline void baum_i_move_from(const baum_mechanism *mechanism, const double *restrict from,
                                    double h, const double *restrict v, double *restrict q)
{
  if (!mechanism->flat) {
    memcpy(q, from, (size_t)mechanism->nq * sizeof *q);
    baum_i_move_bodies(mechanism, h, v, q);
    return;
  }
  for (int i = 0; i < mechanism->nv; i++) {
    q[i] = from[i] + h * v[i];
  }
}

/* Find dx (nv) such that baum_i_move() by dx with h = 1 leads from `from` to `to`. */
void baum_i_difference(const baum_mechanism *mechanism, const double *from, const double *to,
                       double *dx);

/* Move q to the nearest point of the manifold. Does nothing if the mechanism is flat. */
static inline void baum_i_normalize(const baum_mechanism *mechanism, double *q)
{
  if (!mechanism->flat) {
    baum_i_normalize_bodies(mechanism, q);
  }
}

/* The next three functions write their result to `room` and return `room`. If the mechanism is
 * flat, they return the argument before `room` instead, which equals the result. */

/* Return N(q) v (nq). room (nq). */
static inline const double *baum_i_rates(const baum_mechanism *mechanism, const double *q,
                                         const double *v, double *room)
{
  if (mechanism->flat) {
    return v;
  }
  baum_i_rate_bodies(mechanism, q, v, room);
  return room;
}

/* Return q'' = N(q) a + (N v)_q N v (nq). room (4 nq). */
static inline const double *baum_i_second_rates(const baum_mechanism *mechanism, const double *q,
                                                const double *v, const double *a, double *room)
{
  return mechanism->flat ? a : baum_i_second_rates_of_bodies(mechanism, q, v, a, room);
}

/* Return v (nv) such that N(q) v is the tangential part of the rates dq (nq), written N^+ dq. q
 * must be on the manifold. room (3 nq) must not be dq. */
static inline const double *baum_i_tangent(const baum_mechanism *mechanism, const double *q,
                                           const double *dq, double *room)
{
  return mechanism->flat ? dq : baum_i_tangent_of_bodies(mechanism, q, dq, room);
}

/* Set blocks to N^+ (N v)_q N: the derivative of N v with respect to q at constant v, where both
 * the displacement of q and the result are expressed in velocity coordinates. The block (nv x nv)
 * of a body with a manifold begins at its `mass`; other blocks are not set. work (6 nq) is scratch
 * memory. */
void baum_i_linearize_rate(const baum_mechanism *mechanism, const double *q, const double *v,
                           double *blocks, double *work);

/* Like baum_i_move(), for the local velocities (nl) and positions (ql) of a span. */
void baum_i_span_move(const baum_mechanism *mechanism, const baum_i_span *span, double h,
                      const double *v, double *q);

#endif
