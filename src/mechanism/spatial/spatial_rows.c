/* SPDX-License-Identifier: BSD-3-Clause */
/* Products of vectors on two bodies, and their derivatives. The equations are in spatial_rows.h. */
#include "mechanism/spatial/spatial_rows.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "mechanism/spatial/spatial_motion.h"

enum { COLUMNS = BAUM_I_PAIR_COLUMNS };

/* ---- vectors, see spatial_rows.h ---- */

typedef struct vector {
  double value[3];
  double on[2][3]; /* u_a and u_b */
  double apart;    /* t */
} vector;

static vector vector_of(const baum_i_spatial_pair *pair, baum_i_spatial_vector which)
{
  vector u = {.apart = which == BAUM_I_APART ? 1.0 : 0.0};
  if (which == BAUM_I_APART) {
    for (int i = 0; i < 3; i++) {
      u.on[0][i] = -pair->arm[0][i];
      u.on[1][i] = pair->arm[1][i];
      u.value[i] = pair->frame[1]->r[i] + u.on[1][i] - (pair->frame[0]->r[i] - u.on[0][i]);
    }
  } else if (which >= BAUM_I_X_GROUND) {
    u.value[which - BAUM_I_X_GROUND] = 1.0;
  } else {
    int body = which >= BAUM_I_X_B ? 1 : 0;
    const double *axis = pair->axes[body] + 3 * ((int)which % 3);
    memcpy(u.on[body], axis, sizeof u.value);
    memcpy(u.value, axis, sizeof u.value);
  }
  return u;
}

/* Return the derivative u' of a vector along a motion. */
static vector along(const vector *u, const baum_i_spatial_motion *m)
{
  vector out = {.apart = 0.0};
  baum_i_cross(m->w[0], u->on[0], out.on[0]);
  baum_i_cross(m->w[1], u->on[1], out.on[1]);
  for (int i = 0; i < 3; i++) {
    out.value[i] = u->apart * (m->v[1][i] - m->v[0][i]) + out.on[0][i] + out.on[1][i];
  }
  return out;
}

static baum_i_spatial_motion unit_motion(const baum_i_spatial_pair *pair, int column)
{
  baum_i_spatial_motion m = {.v = {{0.0}}};
  int k = column / BAUM_I_SPACE;
  int i = column % 3;
  if (column % BAUM_I_SPACE < 3) {
    m.v[k][i] = 1.0;
  } else {
    const double axis[3] = {i == 0, i == 1, i == 2};
    baum_i_turn(pair->frame[k]->axes, axis, m.w[k]);
  }
  return m;
}

/* Add factor * (x . y)_q to `out`. */
static void add_gradient(const baum_i_spatial_pair *pair, double factor, const vector *x,
                         const vector *y, double out[COLUMNS])
{
  for (int k = 0; k < 2; k++) {
    double *own = out + (ptrdiff_t)BAUM_I_SPACE * k;
    double moments[2][3];
    double turned[3];
    baum_i_cross(x->on[k], y->value, moments[0]);
    baum_i_cross(y->on[k], x->value, moments[1]);
    for (int i = 0; i < 3; i++) {
      moments[0][i] += moments[1][i];
    }
    baum_i_turn_back(pair->frame[k]->axes, moments[0], turned);
    double sign = k == 0 ? -factor : factor;
    for (int i = 0; i < 3; i++) {
      own[i] += sign * (x->apart * y->value[i] + y->apart * x->value[i]);
      own[3 + i] += factor * turned[i];
    }
  }
}

/* ---- rows ---- */

baum_i_spatial_pair baum_i_spatial_pair_at(const baum_i_span *span, const double *numbers,
                                           bool has_axes, const baum_i_point *point)
{
  baum_i_spatial_pair pair;
  for (int k = 0; k < 2; k++) {
    const baum_i_spatial_frame *frame = &point->spatial[span->bodies[k]];
    pair.frame[k] = frame;
    baum_i_turn(frame->axes, numbers + BAUM_I_SPATIAL_POINTS + (ptrdiff_t)3 * k, pair.arm[k]);
    for (int i = 0; has_axes && i < 9; i += 3) {
      baum_i_turn(frame->axes, numbers + BAUM_I_SPATIAL_AXES_A + (ptrdiff_t)9 * k + i,
                  pair.axes[k] + i);
    }
  }
  return pair;
}

void baum_i_spatial_relative_axes(const baum_i_force *force, const baum_i_point *point,
                                  const double *q, double r[9])
{
  const double *numbers = point->parameters + force->element.parameter;
  double axes[2][9];
  for (int k = 0; k < 2; k++) {
    const baum_i_body_place *place = &point->mechanism->places[force->span.bodies[k]];
    const baum_i_spatial_frame frame =
      baum_i_spatial_frame_at((baum_i_frame_kind)place->kind, q + place->q, NULL);
    for (int i = 0; i < 9; i += 3) {
      baum_i_turn(frame.axes, numbers + BAUM_I_SPATIAL_AXES_A + (ptrdiff_t)9 * k + i, axes[k] + i);
    }
  }
  for (int i = 0; i < 9; i++) {
    r[i] = baum_i_dot3(axes[0] + (ptrdiff_t)3 * (i / 3), axes[1] + (ptrdiff_t)3 * (i % 3));
  }
}

double baum_i_spatial_gradient_at(const baum_i_spatial_pair *pair, baum_i_spatial_row row,
                                  double *gradient)
{
  const vector x = vector_of(pair, row.x);
  const vector y = vector_of(pair, row.y);
  if (gradient) {
    memset(gradient, 0, COLUMNS * sizeof *gradient);
    add_gradient(pair, 1.0, &x, &y, gradient);
  }
  return baum_i_dot3(x.value, y.value);
}

double baum_i_spatial_product(const baum_i_spatial_pair *pair, baum_i_spatial_row row)
{
  return baum_i_spatial_gradient_at(pair, row, NULL);
}

/* The vectors x and y of a product, each with its first and second derivatives along a motion. */
typedef struct product {
  vector x[3];
  vector y[3];
} product;

static product product_along(const baum_i_spatial_pair *pair, baum_i_spatial_row row,
                             const baum_i_spatial_motion *m)
{
  product p = {.x = {vector_of(pair, row.x)}, .y = {vector_of(pair, row.y)}};
  for (int i = 0; i < 2; i++) {
    p.x[i + 1] = along(&p.x[i], m);
    p.y[i + 1] = along(&p.y[i], m);
  }
  return p;
}

void baum_i_spatial_row_at(const baum_i_spatial_pair *pair, baum_i_spatial_row row,
                           baum_i_coordinate *out)
{
  const baum_i_spatial_motion m = baum_i_spatial_motion_at(pair->frame[0], pair->frame[1]);
  const product p = product_along(pair, row, &m);
  *out = (baum_i_coordinate){.value = baum_i_dot3(p.x[0].value, p.y[0].value),
                             .rate = baum_i_dot3(p.x[1].value, p.y[0].value) +
                                     baum_i_dot3(p.x[0].value, p.y[1].value),
                             .gamma = -baum_i_dot3(p.x[2].value, p.y[0].value) -
                                      2.0 * baum_i_dot3(p.x[1].value, p.y[1].value) -
                                      baum_i_dot3(p.x[0].value, p.y[2].value)};
  add_gradient(pair, 1.0, &p.x[0], &p.y[0], out->gradient);
}

baum_i_spatial_length baum_i_spatial_length_of(const baum_i_spatial_pair *pair)
{
  baum_i_spatial_length out = {.length = 0.0};
  double e[3];
  for (int i = 0; i < 3; i++) {
    e[i] = pair->frame[1]->r[i] + pair->arm[1][i] - (pair->frame[0]->r[i] + pair->arm[0][i]);
  }
  const double length = sqrt(baum_i_dot3(e, e));
  if (!(length >= DBL_MIN)) {
    return out;
  }
  out.length = length;
  for (int k = 0; k < 2; k++) {
    const baum_i_spatial_frame *frame = pair->frame[k];
    double *own = out.h + (ptrdiff_t)BAUM_I_SPACE * k;
    double moment[3];
    for (int i = 0; i < 3; i++) {
      own[i] = k == 0 ? -e[i] / length : -out.h[i];
    }
    baum_i_cross(pair->arm[k], own, moment);
    baum_i_turn_back(frame->axes, moment, own + 3);
    out.rate += baum_i_dot3(own, frame->v) + baum_i_dot3(moment, frame->w);
  }
  return out;
}

void baum_i_spatial_add_force_on_b(const baum_i_coordinate *row, double lambda,
                                   double six[BAUM_I_SPACE])
{
  for (int k = 0; k < BAUM_I_SPACE; k++) {
    six[k] -= lambda * row->gradient[BAUM_I_SPACE + k];
  }
}

/* Add (J w)_q to `out`, for a motion w. */
static void add_first(const baum_i_spatial_pair *pair, const vector *x, const vector *y,
                      const baum_i_spatial_motion *w, double out[COLUMNS])
{
  const vector x_w = along(x, w);
  const vector y_w = along(y, w);
  add_gradient(pair, 1.0, &x_w, y, out);
  add_gradient(pair, 1.0, x, &y_w, out);
}

static bool turns(const vector *u)
{
  bool found = false;
  for (int i = 0; i < 3; i++) {
    found = found || u->on[0][i] != 0.0 || u->on[1][i] != 0.0;
  }
  return found;
}

/* Tell whether a displacement of a body without rotation may change the gradient of x . y. */
static bool shifts(const vector *x, const vector *y)
{
  bool apart[2] = {x->apart != 0.0, y->apart != 0.0};
  return (apart[0] && apart[1]) || (apart[0] && turns(y)) || (apart[1] && turns(x));
}

void baum_i_spatial_second_of(const baum_i_spatial_pair *pair, baum_i_spatial_row row,
                              baum_i_spatial_second *out)
{
  *out = (baum_i_spatial_second){.rate_q = {0.0}};
  const baum_i_spatial_motion m = baum_i_spatial_motion_at(pair->frame[0], pair->frame[1]);
  const product p = product_along(pair, row, &m);
  add_gradient(pair, -1.0, &p.x[2], &p.y[0], out->gamma_q);
  add_gradient(pair, -2.0, &p.x[1], &p.y[1], out->gamma_q);
  add_gradient(pair, -1.0, &p.x[0], &p.y[2], out->gamma_q);
  add_first(pair, &p.x[0], &p.y[0], &m, out->rate_q);
  double v[COLUMNS];
  for (int k = 0; k < 2; k++) {
    double *own = v + (ptrdiff_t)BAUM_I_SPACE * k;
    memcpy(own, m.v[k], sizeof m.v[k]);
    baum_i_turn_back(pair->frame[k]->axes, m.w[k], own + 3);
  }
  bool all = shifts(&p.x[0], &p.y[0]);
  for (int i = 0; i < COLUMNS; i++) {
    double *column = out->columns_q + (ptrdiff_t)COLUMNS * i;
    const baum_i_spatial_motion unit = unit_motion(pair, i);
    if (all || i % BAUM_I_SPACE >= 3) {
      add_first(pair, &p.x[0], &p.y[0], &unit, column);
    }
    out->gamma_v[i] = -out->rate_q[i];
    for (int j = 0; j < COLUMNS; j++) {
      out->gamma_v[i] -= column[j] * v[j];
    }
  }
}

void baum_i_spatial_add_jw_q(const baum_i_spatial_second *second, const double *w, double factor,
                             double *out)
{
  for (int i = 0; i < COLUMNS; i++) {
    for (int j = 0; j < COLUMNS; j++) {
      out[j] += factor * w[i] * second->columns_q[COLUMNS * i + j];
    }
  }
}

void baum_i_spatial_row_linearize(const baum_i_spatial_pair *pair, baum_i_spatial_row row,
                                  const double *w, double lambda, baum_i_coordinate_blocks *out)
{
  baum_i_spatial_second second;
  baum_i_spatial_second_of(pair, row, &second);
  *out = (baum_i_coordinate_blocks){.jw_q = {0.0}};
  baum_i_spatial_add_jw_q(&second, w, 1.0, out->jw_q);
  memcpy(out->rate_q, second.rate_q, sizeof out->rate_q);
  memcpy(out->gamma_q, second.gamma_q, sizeof out->gamma_q);
  memcpy(out->gamma_v, second.gamma_v, sizeof out->gamma_v);
  for (int k = 0; k < COLUMNS * COLUMNS; k++) {
    out->jtl_q[k] = lambda * second.columns_q[k];
  }
}

void baum_i_spatial_linearize_products(const baum_i_spatial_pair *pair,
                                       const baum_i_spatial_row *rows, int count, double factor,
                                       const double *w, const double *lambda,
                                       const baum_i_joint_blocks *wide)
{
  for (int i = 0; i < count; i++) {
    const ptrdiff_t at = (ptrdiff_t)COLUMNS * i;
    baum_i_spatial_second second;
    baum_i_spatial_second_of(pair, rows[i], &second);
    baum_i_spatial_add_jw_q(&second, w, factor, wide->jw_q + at);
    for (int k = 0; k < COLUMNS; k++) {
      wide->gamma_q[at + k] = factor * second.gamma_q[k];
      wide->gamma_v[at + k] = factor * second.gamma_v[k];
    }
    double multiplier = lambda ? factor * lambda[i] : 0.0;
    for (int k = 0; k < COLUMNS * COLUMNS; k++) {
      wide->jtl_q[k] += multiplier * second.columns_q[k];
    }
  }
}

void baum_i_spatial_linearize_rows(const baum_i_joint *joint, const baum_i_point *point,
                                   const baum_i_spatial_pair *pair, const baum_i_spatial_row *rows,
                                   double factor, const double *w, const double *lambda,
                                   const baum_i_joint_blocks *blocks)
{
  double w_wide[COLUMNS];
  double jw_q[BAUM_I_SPATIAL_ROWS * COLUMNS] = {0.0};
  double gamma_q[BAUM_I_SPATIAL_ROWS * COLUMNS];
  double gamma_v[BAUM_I_SPATIAL_ROWS * COLUMNS];
  double jtl_q[COLUMNS * COLUMNS] = {0.0};
  const baum_i_joint_blocks wide = {jw_q, jtl_q, gamma_q, gamma_v, NULL};
  baum_i_columns_gather(point, &joint->span, BAUM_I_SPACE, w, w_wide);
  baum_i_spatial_linearize_products(pair, rows, joint->rows, factor, w_wide,
                                    lambda ? lambda + joint->row : NULL, &wide);
  baum_i_columns_pack_blocks(point->mechanism, joint, BAUM_I_SPACE, &wide, blocks);
}

void baum_i_spatial_place_of(const baum_i_spatial_pair *pair, double at[3])
{
  for (int i = 0; i < 3; i++) {
    at[i] = pair->frame[1]->r[i] + pair->arm[1][i];
  }
}

double baum_i_spatial_design_length(const baum_mechanism *mechanism, const baum_i_span *span,
                                    const double points[6])
{
  baum_i_spatial_frame frames[2];
  baum_i_spatial_pair pair;
  for (int k = 0; k < 2; k++) {
    frames[k] = baum_i_spatial_design_frame(mechanism, span->bodies[k]);
    pair.frame[k] = &frames[k];
    baum_i_turn(frames[k].axes, points + (ptrdiff_t)3 * k, pair.arm[k]);
  }
  const vector e = vector_of(&pair, BAUM_I_APART);
  return sqrt(baum_i_dot3(e.value, e.value));
}
