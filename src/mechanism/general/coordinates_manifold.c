/* SPDX-License-Identifier: BSD-3-Clause */
/* Calls the user functions of a manifold, and checks them. Let m(s) = move(q, s v). Correct
 * functions satisfy three conditions: m'(0) = rate(q, v), m''(0) is the derivative of rate(m(s), v)
 * with respect to s at s = 0, and difference(q, m(1)) = v.
 */
#include "mechanism/general/coordinates_manifold.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/message.h"
#include "mechanism/definition.h"
#include "mechanism/general/check.h"
#include "mechanism/manifold.h"

/* ---- calls ---- */

static const baum_coordinates_def *def_of(const baum_i_body *body)
{
  return body->element.def;
}

static void rate(const baum_i_body *body, const double *q, const double *v, double *dq)
{
  def_of(body)->rate(q, v, dq, def_of(body)->user);
}

static void move(const baum_i_body *body, double h, const double *v, double *q)
{
  def_of(body)->move(h, v, q, def_of(body)->user);
}

static void difference(const baum_i_body *body, const double *from, const double *to, double *dx)
{
  def_of(body)->difference(from, to, dx, def_of(body)->user);
}

static void normalize(const baum_i_body *body, double *q)
{
  if (def_of(body)->normalize) {
    def_of(body)->normalize(q, def_of(body)->user);
  }
}

static const baum_i_manifold manifold = {
  .rate = rate, .move = move, .difference = difference, .normalize = normalize};

const baum_i_manifold *baum_i_coordinates_manifold(const void *given)
{
  const baum_coordinates_def *def = given;
  return def->rate ? &manifold : NULL;
}

/* ---- definition ---- */

int baum_i_coordinates_positions(const baum_coordinates_def *def)
{
  return def->position_count > 0 ? def->position_count : def->size;
}

/* Tell whether q is off the manifold by more than the rounding of numbers that were typed by
 * hand. */
static bool is_off(const baum_coordinates_def *def, const double *normal)
{
  static const double NEAR = 1e-6;
  bool off = false;
  for (int i = 0; i < baum_i_coordinates_positions(def); i++) {
    double scale = def->position_scale ? def->position_scale[i] : 1.0;
    off = off || !(fabs(normal[i] - def->q[i]) <= NEAR * scale);
  }
  return off;
}

static baum_status check_design(const baum_coordinates_def *def, const char *label)
{
  double *normal = baum_i_copy(def->q, (size_t)baum_i_coordinates_positions(def), sizeof *def->q);
  BAUM_I_TRY(baum_i_check_memory(normal));
  def->normalize(normal, def->user);
  bool off = is_off(def, normal);
  baum_i_free(normal);
  return off ? baum_i_fail(BAUM_ERR_ARGUMENT,
                           "%s: normalize() changes q by more than 1e-6 of position_scale: give a "
                           "q on the manifold",
                           label)
             : BAUM_OK;
}

baum_status baum_i_coordinates_check_manifold(const baum_coordinates_def *def, const char *label)
{
  if (!def->rate) {
    const char *extra = def->move                                        ? "move()"
                        : def->difference                                ? "difference()"
                        : def->normalize                                 ? "normalize()"
                        : baum_i_coordinates_positions(def) != def->size ? "position_count"
                                                                         : NULL;
    return !extra
             ? BAUM_OK
             : baum_i_fail(BAUM_ERR_ARGUMENT, "%s: %s is given, but rate() is NULL", label, extra);
  }
  BAUM_I_TRY(baum_i_check_given(label, "move()", def->move != NULL));
  BAUM_I_TRY(baum_i_check_given(label, "difference()", def->difference != NULL));
  BAUM_I_TRY(baum_i_check_given(label, "q", def->q != NULL));
  return def->normalize ? check_design(def, label) : BAUM_OK;
}

/* ---- comparing the functions with each other ---- */

static baum_i_user_function function(const baum_i_body *body, const char *name, int rows)
{
  return (baum_i_user_function){.element = &body->element, .name = name, .rows = rows};
}

static baum_status position_field(const void *body, const baum_i_local *at, double *out)
{
  (void)body;
  memcpy(out, at->q, (size_t)at->ql * sizeof *out);
  return BAUM_OK;
}

static baum_status rate_field(const void *context, const baum_i_local *at, double *out)
{
  const baum_i_body *body = context;
  baum_i_user_function f = function(body, "rate", body->nq);
  baum_i_begin_call(&f, at, out);
  rate(body, at->q, at->v, out);
  return baum_i_judge(&f, at, 0, out);
}

static baum_status compare_first(const baum_i_body *body, const baum_i_ray *ray,
                                 const baum_i_local *at)
{
  baum_i_local here = *at;
  double *given = baum_i_take(&here, body->nq);
  BAUM_I_TRY(rate_field(body, &here, given));
  baum_i_user_function f = function(body, "rate", body->nq);
  baum_i_field field = {.evaluate = position_field, .context = body, .size = body->nq};
  baum_i_claim claim = {&f, "move", given};
  return baum_i_compare_ray(&claim, &baum_i_stencil_first, &field, ray, &here);
}

static baum_status compare_second(const baum_i_body *body, const baum_i_ray *ray,
                                  const baum_i_local *at)
{
  baum_i_local here = *at;
  double *given = baum_i_take(&here, body->nq);
  baum_i_field rates = {.evaluate = rate_field, .context = body, .size = body->nq};
  BAUM_I_TRY(baum_i_difference_first(&rates, ray, &here, given));
  baum_i_user_function f = function(body, "rate along move", body->nq);
  baum_i_field field = {.evaluate = position_field, .context = body, .size = body->nq};
  baum_i_claim claim = {&f, "move, twice,", given};
  return baum_i_compare_ray(&claim, &baum_i_stencil_second, &field, ray, &here);
}

/* Move q by a displacement, and check that `difference` returns this displacement for the two
 * configurations. */
static baum_status compare_difference(const baum_i_body *body, const baum_i_local *at)
{
  static const double AGREEMENT = 1e-6;
  baum_i_local here = *at;
  double *q = baum_i_take(&here, body->nq);
  double *dx = baum_i_take(&here, body->nv);
  memcpy(q, at->q, (size_t)body->nq * sizeof *q);
  move(body, 0.3, at->v, q);
  difference(body, at->q, q, dx);
  for (int i = 0; i < body->nv; i++) {
    if (!(fabs(dx[i] - 0.3 * at->v[i]) <= AGREEMENT * at->scale[i] * baum_i_local_rate(at))) {
      baum_i_user_function f = function(body, "difference", body->nv);
      return baum_i_fail(BAUM_ERR_ARGUMENT, "%s is %.9g, but move() moved q by %.9g",
                         baum_i_user_entry(&f, i).text, dx[i], 0.3 * at->v[i]);
    }
  }
  return BAUM_OK;
}

/* Displacements below this, relative to the scales, are considered rounding errors. */
static const double ROUNDING = 1e-9;

/* Fail if `normalize` changes q by more than `path_length`, which is the largest change of q in the
 * preceding step. All changes are relative to the scales. */
static baum_status compare_normalized(const baum_i_body *body, const double *scale,
                                      double path_length, const double *moved, const double *normal)
{
  for (int i = 0; i < body->nq; i++) {
    if (fabs(normal[i] - moved[i]) > (path_length + ROUNDING) * scale[i]) {
      baum_i_user_function f = function(body, "normalize", body->nq);
      return baum_i_fail(
        BAUM_ERR_ARGUMENT,
        "%s is %.9g after move() gave %.9g; normalize() must return the nearest q on the manifold",
        baum_i_user_entry(&f, i).text, normal[i], moved[i]);
    }
  }
  return BAUM_OK;
}

/* Move along v in short steps through more than a revolution. In each step, `normalize` must change
 * q by less than the step does. For example, it must not change the sign of a quaternion. */
static baum_status compare_walk(const baum_i_body *body, const baum_i_local *at)
{
  enum { MOVES = 100 };
  static const double SHORT = 0.1; /* length of one step, relative to the scales */
  baum_i_local here = *at;
  double *moved = baum_i_take(&here, body->nq);
  double *normal = baum_i_take(&here, body->nq);
  const double *scale = at->point->mechanism->position_scale + body->q;
  memcpy(normal, at->q, (size_t)body->nq * sizeof *normal);
  double path_length = 0.0;
  /* `path_length` is not finite if a user function returns numbers that are not finite. The loop
   * then ends. */
  for (int k = 0; k < MOVES && isfinite(path_length); k++) {
    path_length = 0.0;
    memcpy(moved, normal, (size_t)body->nq * sizeof *moved);
    move(body, SHORT / baum_i_local_rate(at), at->v, moved);
    for (int i = 0; i < body->nq; i++) {
      double part = fabs(moved[i] - normal[i]) / scale[i];
      path_length = part <= path_length ? path_length : part;
    }
    memcpy(normal, moved, (size_t)body->nq * sizeof *normal);
    normalize(body, normal);
    BAUM_I_TRY(compare_normalized(body, scale, path_length, moved, normal));
  }
  return BAUM_OK;
}

baum_status baum_i_coordinates_compare_manifold(const baum_i_body *body, const baum_i_local *at)
{
  double speed = baum_i_local_rate(at);
  if (!body->manifold || speed == 0.0) {
    return BAUM_OK;
  }
  baum_i_ray ray = {.dq = at->v, .rate = speed};
  BAUM_I_TRY(compare_first(body, &ray, at));
  BAUM_I_TRY(compare_second(body, &ray, at));
  BAUM_I_TRY(compare_difference(body, at));
  return compare_walk(body, at);
}
