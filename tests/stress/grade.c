/* SPDX-License-Identifier: BSD-3-Clause */
/* Computes the largest error that a run may have, which is called its promise. Compares the actual
 * error with the promise.
 *
 * The error is the largest one of all positions at the end. Lengths are relative to the
 * characteristic length, and angles are in radians. With variable steps, the error of each step is
 * estimated as a mean over all coordinates, and this estimate is at most rtol. An error grows in
 * the same way as neighbouring motions diverge. The promise is therefore
 *
 *   CONSTANT x rtol x steps x growth
 *
 * The oracle computes the growth from neighbouring motions. CONSTANT allows for two ratios: the
 * ratio of the largest error to the mean error, and the ratio of an error to its estimate. With a
 * fixed step h and a span T, the promise is the error of a method of order p:
 *
 *   CONSTANT x rate T x (rate h)^p x growth
 *
 * Here `rate` is the fastest rate of the motion. This promise is large enough, because the error
 * constants of all methods are below 1, and the n-th derivative of a motion is a few times rate^n.
 * Both promises also contain the rounding error of a double for each step.
 */
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

#include "cell.h"
#include "space.h"
#include "tilt.h"

enum { LOOKS = 8 };

static const double CONSTANT = 10.0;
/* Promises have an upper bound, because a result with a larger error would be useless. With fixed
 * steps, the bound is WORTHLESS. With variable steps, it is WORTHLESS or TOLERANCES x rtol,
 * whichever is larger. */
static const double WORTHLESS = 0.1;
static const double TOLERANCES = 30.0;
static const double ROUNDING = 1e-15;
static const double PI = 3.141592653589793;

const char *outcome_name(outcome o)
{
  static const char *const NAMES[OUTCOMES] = {"met",    "refused", "stopped",
                                              "warned", "crossed", "silent_wrong"};
  return NAMES[o];
}

/* ---- the true motion ---- */

typedef struct truth {
  double rate;   /* [rad/s] fastest rate of the motion */
  double span;   /* [s] */
  double growth; /* [-] the factor by which neighbouring motions move apart */
  oracle_state end;
  bool known;
} truth;

static double rate_at(const oracle *o, oracle_state y)
{
  return (double)fmaxl(fabsl(y.v), sqrtl(fabsl(o->acceleration(o->scene, y.x, y.v))));
}

/* Returns the largest distance between the poses of a body at the angles x and y. Lengths are
 * divided by `scale`. */
static double distance(const scene *s, long double x, long double y, double scale)
{
  double most = 0.0;
  int bodies = scene_bodies(s);
  for (int k = 0; k<bodies; k += bodies> 6 ? bodies / 3 : 1) {
    long double a[SCENE_NUMBERS];
    long double b[SCENE_NUMBERS];
    scene_pose(s, k, x, a);
    scene_pose(s, k, y, b);
    most = fmax(most, scene_distance(s, a, b, scale));
  }
  return most;
}

/* Returns the rate of oscillations on a stiff spring, from the slope of the acceleration. The
 * function rate_at() cannot show this rate, because it uses only the size of the acceleration. */
static double stiff_rate(const scene *s)
{
  oracle o = {scene_acceleration, s};
  long double slope =
    o.acceleration(s, s->angle, s->rate) - o.acceleration(s, s->angle + 1e-3L, s->rate);
  return slope > 0 ? sqrt((double)slope / 1e-3) : 0.0;
}

/* Returns the fastest rate of the motion within its first LOOKS radians. The period of this rate is
 * the unit of time for a cell. */
static double find_rate(const scene *s)
{
  oracle o = {scene_acceleration, s};
  oracle_state y = {s->angle, s->rate};
  double rate = fmax(rate_at(&o, y), stiff_rate(s));
  for (int k = 0; k < LOOKS; k++) {
    if (!oracle_advance(&o, 1.0L / rate, &y)) {
      break;
    }
    rate = fmax(rate, rate_at(&o, y));
  }
  return rate;
}

static truth find_truth(const scene *s, double span, double rate, double scale)
{
  const long double nudge = 1e-6L;
  oracle o = {scene_acceleration, s};
  truth out = {.rate = rate, .span = span, .growth = 1.0, .known = true};
  oracle_state y = {s->angle, s->rate};
  oracle_state beside = {y.x + nudge, y.v};
  oracle_state faster = {y.x, y.v + nudge * rate};
  for (int k = 0; k < LOOKS && out.known; k++) {
    long double part = (long double)span / LOOKS;
    out.known = oracle_advance(&o, part, &y) && oracle_advance(&o, part, &beside) &&
                oracle_advance(&o, part, &faster);
    double apart = fmax(distance(s, y.x, beside.x, scale), distance(s, y.x, faster.x, scale));
    out.growth = fmax(out.growth, apart / (double)nudge);
    out.rate = fmax(out.rate, rate_at(&o, y));
  }
  out.end = y;
  return out;
}

/* ---- a run ---- */

typedef struct trial {
  scene scene; /* contains the actual start of the run */
  model m;
  baum_simulation *run;
  baum_status status;
  bool began;
  int64_t doubts;
  int64_t crossings;
  int64_t steps;
} trial;

static baum_simulation_options options_of(const cell *c, double period)
{
  baum_simulation_options o = baum_simulation_options_default();
  double second = c->scene.units.time;
  o.integrator = c->way->integrator();
  o.formulation = c->way->formulation;
  o.step = c->way->fixed ? c->step * period * second : (double)NAN;
  o.rtol = c->way->fixed || o.integrator == baum_kinematics() ? (double)NAN : c->rtol;
  o.start_time = c->scene.start * second;
  o.start = c->begin;
  o.max_steps = c->most;
  if (!isnan(c->gain)) {
    double gain = c->gain / second;
    o.gains = baum_gains_fixed(gain, gain);
  }
  return o;
}

static void note(grade *out, const char *message)
{
  (void)snprintf(out->message, sizeof out->message, "%s", message);
}

static void count(trial *t)
{
  baum_counters c;
  if (baum_simulation_counters(t->run, &c, sizeof c) == BAUM_OK) {
    t->doubts = c.doubts;
    t->crossings = c.near_singular_intervals;
    t->steps = c.steps;
  }
}

/* If a body is displaced in the design configuration, the true motion starts in the configuration
 * that the library has assembled. */
static void take_start(trial *t)
{
  scene *s = &t->scene;
  const double *q = baum_simulation_q(t->run);
  const double *v = baum_simulation_v(t->run);
  if (s->tilted) {
    double pose[3];
    double off[2];
    model_untilt_body(q, pose, off);
    s->angle = pose[2];
    s->rate = v[5] * s->units.time;
    return;
  }
  bool bob = s->kind == SCENE_BOB;
  s->angle = bob ? atan2(q[1], q[0]) : q[2];
  s->rate =
    (bob ? (v[1] * q[0] - v[0] * q[1]) / (q[0] * q[0] + q[1] * q[1]) : v[2]) * s->units.time;
}

static trial try_cell(const cell *c, const baum_simulation_options *o, double span, grade *out)
{
  trial t = {.scene = c->scene, .status = scene_build(&c->scene, &t.m)};
  if (t.status == BAUM_OK) {
    t.status = baum_simulation_create(t.m.mechanism, o, &t.run);
  }
  t.began = t.status == BAUM_OK;
  if (t.began) {
    t.scene.angle = scene_begin(&c->scene);
    if (c->scene.violation != 0.0) {
      take_start(&t);
    }
    t.status = baum_simulation_advance_to(t.run, o->start_time + span * c->scene.units.time);
    count(&t);
  }
  note(out, t.status == BAUM_OK ? "" : baum_message());
  return t;
}

static void end_trial(trial *t)
{
  baum_simulation_destroy(t->run);
  model_destroy(&t->m);
}

/* ---- grading ---- */

static double error_of(const scene *s, const double *q, oracle_state end, double scale)
{
  int width = scene_width(s);
  int lengths = space_is(s) ? 3 : 2;
  double most = 0.0;
  for (int k = 0; k < scene_bodies(s); k++) {
    long double want[SCENE_NUMBERS];
    long double got[SCENE_NUMBERS];
    scene_pose(s, k, end.x, want);
    for (int i = 0; i < width; i++) {
      double unit = i < lengths ? s->units.length : 1.0;
      got[i] = q[width * k + i] / unit;
    }
    double error = scene_distance(s, got, want, scale);
    most = error > most || isnan(error) ? error : most;
  }
  return most;
}

static double promise_of(const cell *c, const truth *true_, int64_t steps, double scale)
{
  double parts = fmax(scale, scene_bodies(&c->scene)); /* rounding errors add up along the bodies */
  double rounding = ROUNDING * (double)(steps + 100) * parts;
  double method = CONSTANT * c->rtol * (double)steps;
  double most = fmax(WORTHLESS, TOLERANCES * c->rtol);
  if (c->way->fixed) {
    double h = c->step * 2.0 * PI; /* the step times the rate */
    method = CONSTANT * true_->rate * true_->span * pow(h, c->way->order);
    most = WORTHLESS;
  }
  return fmin((method + rounding + c->share) * true_->growth, most);
}

static double seconds(void)
{
  return (double)clock() / CLOCKS_PER_SEC;
}

/* Returns the characteristic length in metres. */
static double scale_of(const cell *c, const trial *t)
{
  double scale = 1.0;
  (void)baum_mechanism_get_characteristic_length(t->m.mechanism, &scale);
  return scale / c->scene.units.length;
}

void cell_measure(const cell *c, const scene *s, const double *q, const cell_time *time, grade *out)
{
  double start = s->start;
  double span = start + time->span - start; /* rounded in the same way as in the run */
  truth true_ = find_truth(s, span, time->rate, time->scale);
  out->error = error_of(s, q, true_.end, time->scale);
  out->promise = true_.known ? promise_of(c, &true_, out->steps, time->scale) : (double)NAN;
}

static void measure(const cell *c, const trial *t, cell_time time, grade *out)
{
  time.scale = scale_of(c, t);
  out->steps = t->steps;
  cell_measure(c, &t->scene, baum_simulation_q(t->run), &time, out);
}

/* If a configuration is closer than this to a singular one, it is considered singular, because
 * rounding errors hide the difference. */
static const double SINGULAR = 1e-10;

static outcome judge(const trial *t, const grade *g)
{
  if (!t->began) {
    return REFUSED;
  }
  if (t->status < BAUM_OK) {
    return STOPPED;
  }
  if (t->doubts > 0) {
    return WARNED;
  }
  if (g->error <= g->promise) {
    return MET;
  }
  return t->crossings > 0 && t->scene.gap <= SINGULAR ? CROSSED : WRONG;
}

/* Returns true if the library should not have refused the run. There are two such cases. In one,
 * the start is neither singular nor inconsistent. In the other, the gains were called unstable, but
 * a run with them meets its promise. */
static bool refused_in_vain(const cell *c, baum_simulation_options *o, cell_time time,
                            baum_status status)
{
  const scene *s = &c->scene;
  if (status == BAUM_ERR_SINGULAR || status == BAUM_ERR_INCONSISTENT) {
    return s->gap > SINGULAR && s->violation == 0.0 && s->off == 0.0;
  }
  if (status != BAUM_ERR_UNSTABLE) {
    return false;
  }
  grade again = {.error = (double)NAN};
  o->allow_unstable = true;
  trial t = try_cell(c, o, time.span, &again);
  if (t.began && t.status >= BAUM_OK) {
    measure(c, &t, time, &again);
  }
  end_trial(&t);
  return again.error <= again.promise;
}

cell_time cell_time_of(const cell *c)
{
  cell_time out = {.rate = find_rate(&c->scene), .scale = 1.0};
  out.period = 2.0 * PI / out.rate;
  out.span = c->periods * out.period;
  if (c->way->fixed) {
    double steps = fmin(round(c->periods / c->step), (double)c->most);
    out.span = fmax(1.0, steps) * c->step * out.period;
  }
  return out;
}

grade cell_grade(const cell *c)
{
  grade out = {.error = (double)NAN, .promise = (double)NAN};
  double begin = seconds();
  cell_time time = cell_time_of(c);
  baum_simulation_options o = options_of(c, time.period);
  double ran = seconds();
  trial t = try_cell(c, &o, time.span, &out);
  out.seconds = seconds() - ran;
  out.steps = t.steps;
  out.status = t.status;
  if (t.began && t.status >= BAUM_OK) {
    measure(c, &t, time, &out);
  }
  out.outcome = judge(&t, &out);
  /* From a singular configuration, the motion can continue on several branches. A warning is then
   * justified, even if the run followed the expected branch accurately. */
  bool open = c->scene.gap <= SINGULAR;
  out.false_alarm = (out.outcome == WARNED && out.error <= out.promise && !open) ||
                    (out.outcome == REFUSED && refused_in_vain(c, &o, time, t.status));
  end_trial(&t);
  out.all_seconds = seconds() - begin;
  return out;
}
