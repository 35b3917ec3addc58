/* SPDX-License-Identifier: BSD-3-Clause */
/* Computes the channels, which are the outputs of a run in one state. Accelerations, multipliers
 * and reactions require a solution of equation (5) of docs/notation.md. It is computed only if a
 * channel needs it, and only once for each row of output. */
#include <limits.h>
#include <math.h>
#include <string.h>

#include "base/rotation.h"
#include "base/sized.h"
#include "base/text.h"
#include "mechanism/definition.h"
#include "mechanism/general/coordinate.h"
#include "mechanism/planar/planar.h"
#include "simulate/account.h"

/* ---- quantities ---- */

/* The objects to which the columns of a quantity belong. */
typedef enum object {
  OF_NOTHING,
  OF_Q,
  OF_V,
  OF_ROWS,
  OF_ENERGY,
  OF_ACCOUNT,
  OF_BODY,
  OF_JOINT
} object;

/* What must be evaluated for a quantity. Each level includes all levels before it. */
typedef enum depth { DEPTH_FRAMES, DEPTH_VIOLATION, DEPTH_SOLUTION } depth;

typedef struct facts {
  object of;
  depth needs;
  const char *word;
} facts;

/* The table is indexed by the quantity. There is no quantity 0. */
static const facts table[] = {
  [0] = {OF_NOTHING, DEPTH_FRAMES, "nothing"},
  [BAUM_Q] = {OF_Q, DEPTH_FRAMES, "positions"},
  [BAUM_V] = {OF_V, DEPTH_FRAMES, "velocities"},
  [BAUM_A] = {OF_V, DEPTH_SOLUTION, "accelerations"},
  [BAUM_LAMBDA] = {OF_ROWS, DEPTH_SOLUTION, "multipliers"},
  [BAUM_PHI] = {OF_ROWS, DEPTH_VIOLATION, "violation"},
  [BAUM_PHI_RATE] = {OF_ROWS, DEPTH_VIOLATION, "rate of violation"},
  [BAUM_ENERGY] = {OF_ENERGY, DEPTH_FRAMES, "energy"},
  [BAUM_BODY_POSE] = {OF_BODY, DEPTH_FRAMES, "pose"},
  [BAUM_BODY_VELOCITY] = {OF_BODY, DEPTH_FRAMES, "velocity"},
  [BAUM_JOINT_REACTION] = {OF_JOINT, DEPTH_SOLUTION, "reaction"},
  [BAUM_JOINT_COORDINATE] = {OF_JOINT, DEPTH_FRAMES, "coordinate"},
  [BAUM_BODY_ACCELERATION] = {OF_BODY, DEPTH_SOLUTION, "acceleration"},
  [BAUM_DRIVE_EFFORT] = {OF_JOINT, DEPTH_SOLUTION, "effort"},
  [BAUM_ENERGY_ACCOUNT] = {OF_ACCOUNT, DEPTH_FRAMES, "energy account"},
};

static facts facts_of(baum_quantity quantity)
{
  size_t k = (size_t)quantity;
  return table[k < sizeof table / sizeof *table ? k : 0];
}

/* A part of a vector whose length is nq, nv or nc. */
typedef struct slice {
  int first;
  int count;
} slice;

/* Return the slice that a channel shows: the entries of a body, the entries of a joint, or the
 * whole vector. The ids of the channel must have been checked. */
static slice slice_of(const baum_mechanism *m, const baum_channel *c)
{
  object of = facts_of(c->quantity).of;
  if (of == OF_BODY) {
    const baum_i_body *body = m->bodies[baum_i_body_index(m, c->body)];
    return c->quantity == BAUM_BODY_POSE ? (slice){body->q, body->nq} : (slice){body->v, body->nv};
  }
  if (of == OF_ROWS && c->joint.index1 != 0) {
    const baum_i_joint *joint = m->joints[baum_i_joint_index(m, c->joint)];
    return (slice){joint->row, joint->rows};
  }
  return (slice){0, of == OF_Q ? m->nq : (of == OF_V ? m->nv : m->nc)};
}

/* ---- widths and checks ---- */

static int fail_channel(int k, const char *what)
{
  (void)baum_i_fail(BAUM_ERR_ARGUMENT, "channel %d: %s", k, what);
  return -1;
}

static int fail_point(int k, const double p[3])
{
  (void)baum_i_fail(
    BAUM_ERR_ARGUMENT,
    "channel %d: point is (%g, %g, %g) m, must be finite, with z = 0 for a planar body", k, p[0],
    p[1], p[2]);
  return -1;
}

static int body_width(const baum_mechanism *m, const baum_channel *c, int k)
{
  int body = baum_i_body_index(m, c->body);
  if (body <= 0) {
    return fail_channel(k, body == 0 ? "ground has no pose, velocity or acceleration"
                                     : "body is none or not of this mechanism");
  }
  baum_i_frame_kind kind = m->bodies[body]->type->frame;
  const double *p = c->point;
  double size = fabs(p[0]) + fabs(p[1]) + fabs(p[2]);
  if (kind != BAUM_I_FRAME_BODY && kind != BAUM_I_FRAME_SPATIAL_BODY && size != 0.0) {
    return fail_channel(k, "point is given, but the body has no axes");
  }
  if (!isfinite(size) || (kind == BAUM_I_FRAME_BODY && p[2] != 0.0)) {
    return fail_point(k, p);
  }
  return slice_of(m, c).count;
}

static int fail_effort(const baum_i_joint *joint, int k)
{
  (void)baum_i_fail(BAUM_ERR_ARGUMENT, "channel %d: %s is a %s, but only drivers have an effort", k,
                    baum_i_label(&joint->element).text, joint->type->definition.kind);
  return -1;
}

static int joint_width(const baum_mechanism *m, const baum_channel *c, int k)
{
  int joint = baum_i_joint_index(m, c->joint);
  if (joint < 0) {
    return fail_channel(k, "joint is none or not of this mechanism");
  }
  if (c->quantity == BAUM_JOINT_REACTION) {
    return baum_i_reaction_width(m, joint);
  }
  if (c->quantity == BAUM_DRIVE_EFFORT) {
    return m->joints[joint]->type->driven ? 1 : fail_effort(m->joints[joint], k);
  }
  static const baum_i_coordinate_fields fields = {
    "joint", "coordinate",
    "to record; all joints have BAUM_JOINT_REACTION, BAUM_LAMBDA, BAUM_PHI and BAUM_PHI_RATE"};
  const baum_i_text label = baum_i_text_of("channel %d", k);
  bool has = baum_i_check_coordinate(m, c->joint, c->coordinate, label.text, &fields) == BAUM_OK;
  return has ? 2 : -1;
}

static int channel_width(const baum_mechanism *m, const baum_channel *c, int k)
{
  switch (facts_of(c->quantity).of) {
  case OF_Q: return m->nq;
  case OF_V: return m->nv;
  case OF_ROWS:
    return c->joint.index1 == 0 || baum_i_joint_index(m, c->joint) >= 0
             ? slice_of(m, c).count
             : fail_channel(k, "joint is not of this mechanism");
  case OF_ENERGY: return 2;
  case OF_ACCOUNT: return BAUM_I_ACCOUNT_WIDTH;
  case OF_BODY: return body_width(m, c, k);
  case OF_JOINT: return joint_width(m, c, k);
  case OF_NOTHING:
  default: return fail_channel(k, "quantity is not a baum_quantity");
  }
}

void baum_i_append_channel(const baum_mechanism *m, const baum_channel *c, char *text, size_t size)
{
  facts f = facts_of(c->quantity);
  bool named = c->quantity == BAUM_JOINT_COORDINATE && c->coordinate != BAUM_COORDINATE_FIRST;
  baum_i_append(text, size, "%s", named ? baum_i_coordinate_name(c->coordinate) : f.word);
  if (f.of == OF_BODY) {
    const baum_i_body *body = m->bodies[baum_i_body_index(m, c->body)];
    baum_i_append(text, size, " of %s", baum_i_label(&body->element).text);
    if (c->point[0] != 0.0 || c->point[1] != 0.0) {
      baum_i_append(text, size, " at (%g, %g) m", c->point[0], c->point[1]);
    }
  } else if (c->joint.index1 != 0 && (f.of == OF_JOINT || f.of == OF_ROWS)) {
    baum_i_append(text, size, " of %s",
                  baum_i_joint_label(m, baum_i_joint_index(m, c->joint)).text);
  }
}

void baum_channel_init(baum_channel *channel, size_t caller_size)
{
  const baum_channel defaults = {.struct_size = sizeof defaults};
  baum_i_give_sized(channel, caller_size, &defaults, sizeof defaults);
}

baum_channel baum_i_channel(const baum_channel *channels, int k)
{
  const size_t size = channels->struct_size;
  baum_channel channel = {.struct_size = 0};
  memcpy(&channel, (const char *)channels + (size_t)k * size, size);
  channel.struct_size = sizeof channel;
  return channel;
}

/* Check struct_size. The struct_size of the first channel is also the distance between channels in
 * the array. */
static baum_status check_size(const baum_channel *channels, int k)
{
  const size_t size = channels->struct_size;
  size_t own = 0;
  BAUM_I_TRY(
    baum_i_check_struct_size(size, sizeof *channels, "channel 0", "", "baum_channel_of()"));
  memcpy(&own, (const char *)channels + (size_t)k * size, sizeof own);
  return own == size ? BAUM_OK
                     : baum_i_fail(BAUM_ERR_STRUCT,
                                   "channel %d: struct_size is %zu, must be %zu as in channel 0; "
                                   "start from baum_channel_of()",
                                   k, own, size);
}

baum_status baum_i_check_channels(const baum_mechanism *mechanism, const baum_channel *channels,
                                  int count, int *width)
{
  *width = 0;
  if (count < 0 || (count > 0 && !channels)) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "channels are NULL or their count is negative");
  }
  for (int k = 0; k < count; k++) {
    BAUM_I_TRY(check_size(channels, k));
    const baum_channel channel = baum_i_channel(channels, k);
    int own = channel_width(mechanism, &channel, k);
    if (own < 0) {
      return BAUM_ERR_ARGUMENT;
    }
    if (own > INT_MAX - *width) {
      (void)fail_channel(k, "the channels up to here have more columns than an int can count");
      return BAUM_ERR_ARGUMENT;
    }
    *width += own;
  }
  return BAUM_OK;
}

int32_t baum_channels_width(const baum_mechanism *mechanism, const baum_channel *channels,
                            int32_t count)
{
  int width = -1;
  bool is_valid = baum_i_check_frozen(mechanism, "baum_channels_width") == BAUM_OK &&
                  baum_i_check_channels(mechanism, channels, count, &width) == BAUM_OK;
  return is_valid ? width : -1;
}

/* ---- evaluation that channels need ---- */

static baum_status evaluate(baum_workspace *w, const baum_i_state *state,
                            const baum_channel *channels, int count)
{
  depth deepest = DEPTH_FRAMES;
  for (int k = 0; k < count; k++) {
    depth asked = facts_of(baum_i_channel(channels, k).quantity).needs;
    deepest = asked > deepest ? asked : deepest;
  }
  if (deepest == DEPTH_SOLUTION) {
    return baum_i_reported_acceleration(w, state->t, state->q, state->v);
  }
  if (deepest == DEPTH_VIOLATION) {
    return baum_i_violation(w, state->t, state->q, state->v);
  }
  baum_i_point_set(&w->point, state->t, state->q, state->v);
  return BAUM_OK;
}

/* ---- values; functions of type int return the number of values ---- */

/* Return the whole vector to which the quantity belongs. */
static const double *vector_of(const baum_workspace *w, const baum_i_state *state,
                               baum_quantity quantity)
{
  switch ((int)quantity) {
  case BAUM_Q:
  case BAUM_BODY_POSE: return state->q;
  case BAUM_V:
  case BAUM_BODY_VELOCITY: return state->v;
  case BAUM_LAMBDA: return w->lambda;
  case BAUM_PHI: return w->phi;
  case BAUM_PHI_RATE: return w->phi_rate;
  default: return w->a;
  }
}

static int fill_slice(const baum_workspace *w, const baum_i_state *state, const baum_channel *c,
                      double *out)
{
  slice s = slice_of(w->mechanism, c);
  memcpy(out, vector_of(w, state, c->quantity) + s.first, (size_t)s.count * sizeof *out);
  return s.count;
}

/* Compute the acceleration of a point, r'' = a + alpha p' - w^2 p. a and alpha are the linear and
 * angular accelerations of the body, w is its angular velocity, p is the vector from the centre of
 * the body to the point, and p' is p rotated by 90 degrees (mechanism/planar/planar.h). */
static void fill_acceleration(const baum_i_marker *marker, const double a[3], double out[3])
{
  const double *p = marker->arm;
  double w2 = marker->w * marker->w;
  out[0] = a[0] - a[2] * p[1] - w2 * p[0];
  out[1] = a[1] + a[2] * p[0] - w2 * p[1];
  out[2] = a[2];
}

/* Compute the acceleration of a point in space, r'' = a + A (w' x s + w x (w x s)). a is the
 * acceleration of the centre of the body, and A is the rotation matrix of the body. In this
 * formula, the angular velocity w and the point s are in body axes. The function computes the
 * products in ground axes. */
static void fill_spatial_acceleration(const baum_i_spatial_frame *frame, const double s[3],
                                      const double a[6], double out[6])
{
  double arm[3];
  double first[3];
  double second[3];
  double third[3];
  baum_i_turn(frame->axes, s, arm);
  baum_i_turn(frame->axes, a + 3, out + 3);
  baum_i_cross(out + 3, arm, first);
  baum_i_cross(frame->w, arm, second);
  baum_i_cross(frame->w, second, third);
  for (int i = 0; i < 3; i++) {
    out[i] = a[i] + first[i] + third[i];
  }
}

static int fill_spatial_body(const baum_workspace *w, const baum_i_body *body,
                             const baum_channel *c, double *out)
{
  const baum_i_spatial_frame *frame = &w->point.spatial[body->element.index];
  if (c->quantity == BAUM_BODY_ACCELERATION) {
    fill_spatial_acceleration(frame, c->point, w->a + body->v, out);
    return 6;
  }
  bool pose = c->quantity == BAUM_BODY_POSE;
  double arm[3];
  double turned[3];
  baum_i_turn(frame->axes, c->point, arm);
  baum_i_cross(frame->w, arm, turned);
  for (int i = 0; i < 3; i++) {
    out[i] = pose ? frame->r[i] + arm[i] : frame->v[i] + turned[i];
  }
  memcpy(out + 3, pose ? w->point.q + body->q + 3 : frame->w, (pose ? 4 : 3) * sizeof *out);
  return pose ? 7 : 6;
}

static int fill_body(const baum_workspace *w, const baum_i_state *state, const baum_channel *c,
                     double *out)
{
  int index = baum_i_body_index(w->mechanism, c->body);
  const baum_i_body *body = w->mechanism->bodies[index];
  if (body->type->frame == BAUM_I_FRAME_SPATIAL_BODY) {
    return fill_spatial_body(w, body, c, out);
  }
  if (body->type->frame != BAUM_I_FRAME_BODY) {
    return fill_slice(w, state, c, out);
  }
  baum_i_marker marker = baum_i_marker_at(&w->point, index, c->point);
  if (c->quantity == BAUM_BODY_ACCELERATION) {
    fill_acceleration(&marker, w->a + body->v, out);
    return 3;
  }
  bool pose = c->quantity == BAUM_BODY_POSE;
  out[0] = pose ? marker.r[0] : marker.dr[0];
  out[1] = pose ? marker.r[1] : marker.dr[1];
  out[2] = pose ? w->point.frames[index].angle : marker.w;
  return 3;
}

static int fill_joint(const baum_workspace *w, const baum_channel *c, double *out)
{
  int index = baum_i_joint_index(w->mechanism, c->joint);
  if (c->quantity == BAUM_JOINT_REACTION) {
    baum_i_reaction(w, index, w->lambda, out);
    return baum_i_reaction_width(w->mechanism, index);
  }
  const baum_i_joint *joint = w->mechanism->joints[index];
  if (c->quantity == BAUM_DRIVE_EFFORT) {
    /* The row of J of a driver is the gradient of the driven coordinate, so the effort is
     * -lambda. */
    out[0] = -w->lambda[joint->row];
    return 1;
  }
  const baum_i_joint_coordinate of =
    baum_i_joint_coordinate_of(w->mechanism, c->joint, c->coordinate);
  baum_i_coordinate coordinate;
  baum_i_coordinate_at(&of, &w->point, &coordinate);
  out[0] = coordinate.value;
  out[1] = coordinate.rate;
  return 2;
}

static int fill_channel(const baum_workspace *w, const baum_i_state *state, const baum_channel *c,
                        double *out)
{
  switch (facts_of(c->quantity).of) {
  case OF_Q:
  case OF_V:
  case OF_ROWS: return fill_slice(w, state, c, out);
  case OF_BODY: return fill_body(w, state, c, out);
  case OF_JOINT: return fill_joint(w, c, out);
  case OF_ACCOUNT: return BAUM_I_ACCOUNT_WIDTH; /* fill_energies() writes the values */
  case OF_ENERGY:
  case OF_NOTHING:
  default: return 2; /* energies; fill_energies() writes the values */
  }
}

/* Check that values are finite. Velocities of distant points may overflow, and so may reactions.
 * Energies and the energy account are filled later, so they are not checked here. */
static baum_status check_channel(const baum_channel *c, int k, const double *out, int width)
{
  facts f = facts_of(c->quantity);
  bool is_there = f.of != OF_ENERGY && f.of != OF_ACCOUNT && f.of != OF_NOTHING;
  for (int i = 0; i < width && is_there; i++) {
    if (!isfinite(out[i])) {
      return baum_i_fail(BAUM_ERR_NOT_FINITE, "channel %d: number %d of the %s is %g", k, i, f.word,
                         out[i]);
    }
  }
  return BAUM_OK;
}

static baum_status fill_energies(baum_simulation *run, const baum_i_state *state,
                                 const baum_channel *channels, int count, double *row)
{
  baum_workspace *w = run->workspace;
  for (int k = 0; k < count; k++) {
    const baum_channel channel = baum_i_channel(channels, k);
    if (channel.quantity == BAUM_ENERGY) {
      BAUM_I_TRY(baum_i_energy(w, state->t, state->q, state->v, &row[0], &row[1]));
    } else if (channel.quantity == BAUM_ENERGY_ACCOUNT) {
      BAUM_I_TRY(baum_i_account_put(run, state, row));
    }
    row += channel_width(w->mechanism, &channel, k);
  }
  return BAUM_OK;
}

baum_status baum_i_output(baum_simulation *run, const baum_i_state *state,
                          const baum_channel *channels, int count, double *row)
{
  baum_workspace *w = run->workspace;
  double *place = row;
  BAUM_I_TRY(evaluate(w, state, channels, count));
  for (int k = 0; k < count; k++) {
    const baum_channel channel = baum_i_channel(channels, k);
    int width = fill_channel(w, state, &channel, place);
    BAUM_I_TRY(check_channel(&channel, k, place, width));
    place += width;
  }
  return fill_energies(run, state, channels, count, row);
}

baum_status baum_simulation_get(baum_simulation *simulation, const baum_channel *channels,
                                int32_t count, double *row)
{
  int width = 0;
  BAUM_I_TRY(baum_i_run_may_be_read(simulation, "baum_simulation_get"));
  BAUM_I_TRY(baum_i_check_given("baum_simulation_get", "row", row || count == 0));
  BAUM_I_TRY(baum_i_check_channels(simulation->workspace->mechanism, channels, count, &width));
  return baum_i_output(simulation, &simulation->state, channels, count, row);
}

baum_status baum_simulation_unique_multipliers(baum_simulation *simulation, bool *unique)
{
  const char *call = "baum_simulation_unique_multipliers";
  BAUM_I_TRY(baum_i_run_may_be_read(simulation, call));
  BAUM_I_TRY(baum_i_check_given(call, "unique", unique != NULL));
  const baum_i_state *state = &simulation->state;
  baum_workspace *w = simulation->workspace;
  BAUM_I_TRY(baum_i_reported_acceleration(w, state->t, state->q, state->v));
  return baum_i_find_unique_multipliers(w, unique);
}
