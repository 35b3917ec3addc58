/* SPDX-License-Identifier: BSD-3-Clause */
/* The configuration manifold. Positions are q (nq), velocities are v (nv), and q' = N(q) v.
 *
 * If q of every body is a vector, mechanism->flat is set. Then N is the identity, and moving q is
 * an addition. Otherwise baum_i_move() moves q, baum_i_difference() compares two configurations,
 * and vectors of length nv are never added to q. Some integrators add rates q' = N v, which have
 * length nq, to q. They normalize the configurations that they accept.
 */
#ifndef BAUM_I_MECHANISM_MANIFOLD_H
#define BAUM_I_MECHANISM_MANIFOLD_H

#include <string.h>

#include "mechanism/mechanism.h"

/* ---- for mechanisms that are not flat; comments are at the functions of the next section, which
 * call these functions ---- */

void baum_i_rate_bodies(const baum_mechanism *mechanism, const double *q, const double *v,
                        double *dq);
void baum_i_move_bodies(const baum_mechanism *mechanism, double h, const double *v, double *q);
void baum_i_normalize_bodies(const baum_mechanism *mechanism, double *q);
const double *baum_i_second_rates_of_bodies(const baum_mechanism *mechanism, const double *q,
                                            const double *v, const double *a, double *room);
const double *baum_i_tangent_of_bodies(const baum_mechanism *mechanism, const double *q,
                                       const double *dq, double *room);

/* ---- for all mechanisms ---- */

/* Set y = y + h x. x and y must not overlap. */
static inline void baum_i_add_scaled(int n, double h, const double *restrict x, double *restrict y)
{
  for (int i = 0; i < n; i++) {
    y[i] += h * x[i];
  }
}

/* Set dq (nq) = N(q) v. q may be slightly off the manifold, as it is in the stages of an
 * integrator. */
static inline void baum_i_rate(const baum_mechanism *mechanism, const double *q, const double *v,
                               double *dq)
{
  if (mechanism->flat) {
    memcpy(dq, v, (size_t)mechanism->nv * sizeof *v);
  } else {
    baum_i_rate_bodies(mechanism, q, v, dq);
  }
}

/* Move q by h v (nv). The result lies on the manifold. To second order in h, it is the
 * configuration after the time h at constant v. */
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

/* Find the displacement dx (nv) that leads from `from` to `to`: baum_i_move() with h = 1 and v = dx
 * moves `from` to `to`. */
void baum_i_difference(const baum_mechanism *mechanism, const double *from, const double *to,
                       double *dx);

/* Move q to the nearest point of the manifold. Does nothing if the mechanism is flat. */
static inline void baum_i_normalize(const baum_mechanism *mechanism, double *q)
{
  if (!mechanism->flat) {
    baum_i_normalize_bodies(mechanism, q);
  }
}

/* The next three functions return a pointer to their result. If the mechanism is flat, the result
 * equals the last argument before `room`, and the functions return this argument without writing
 * anything. Otherwise they write the result to `room` and return `room`. */

/* Return N(q) v (nq). `room` has nq entries. */
static inline const double *baum_i_rates(const baum_mechanism *mechanism, const double *q,
                                         const double *v, double *room)
{
  if (mechanism->flat) {
    return v;
  }
  baum_i_rate_bodies(mechanism, q, v, room);
  return room;
}

/* Return q'' = N(q) a + (N v)_q N v (nq), where the subscript q denotes a derivative. `room` has 4
 * nq entries. */
static inline const double *baum_i_second_rates(const baum_mechanism *mechanism, const double *q,
                                                const double *v, const double *a, double *room)
{
  return mechanism->flat ? a : baum_i_second_rates_of_bodies(mechanism, q, v, a, room);
}

/* Return the velocities v (nv) for which N(q) v is the tangential part of the rates dq (nq). This v
 * is written N^+ dq. q must be on the manifold. `room` has 3 nq entries and must not be dq. */
static inline const double *baum_i_tangent(const baum_mechanism *mechanism, const double *q,
                                           const double *dq, double *room)
{
  return mechanism->flat ? dq : baum_i_tangent_of_bodies(mechanism, q, dq, room);
}

/* Set `blocks` to N^+ (N v)_q N. This is the derivative of N v with respect to q at constant v,
 * where both the displacement of q and the result are expressed in velocity coordinates. The block
 * (nv x nv) of a body with a manifold begins at the index `mass` of the body. Blocks of other
 * bodies are not set. work (6 nq) is scratch memory. */
void baum_i_linearize_rate(const baum_mechanism *mechanism, const double *q, const double *v,
                           double *blocks, double *work);

/* Do what baum_i_move() does, for the local velocities (nl) and positions (ql) of a span. */
void baum_i_span_move(const baum_mechanism *mechanism, const baum_i_span *span, double h,
                      const double *v, double *q);

#endif
