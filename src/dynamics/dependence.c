/* SPDX-License-Identifier: BSD-3-Clause */
/* Forces are compared at rest and with velocities, masses at one pose and at another, number by number: what does not
 * depend on something is the same to the last bit. A damper is found in this way wherever it stands, because poses and
 * velocities are irregular; a function of the user that sees velocities only in some places may be missed.
 */
#include "dynamics/dependence.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/message.h"

enum { POSES = 5, SPEEDS = 6 };

/* Size of the displacements from pose to pose, of the scale. */
static const double DISPLACEMENT = 0.3;

/* Memory of a search. */
typedef struct search {
  baum_workspace *w;
  const baum_i_dependence_probe *probe;
  uint64_t seed;
  double *memory; /* all below */
  double *q;      /* (nv) */
  double *v;      /* (nv) */
  double *sum;    /* (nv) zeros between two elements */
  double *now;    /* (nv) of one element */
  double *rest;   /* forces at rest, element by element; NaN where unknown */
  double *mass;   /* (mass_size) at the first pose */
  double *other;  /* (mass_size) at another */
} search;

/* In [-1, 1); a linear congruential generator (Knuth, MMIX). */
static double irregular(search *s)
{
  s->seed = s->seed * 6364136223846793005u + 1442695040888963407u;
  return (double)(s->seed >> 11) / 4503599627370496.0 - 1.0;
}

static void choose_pose(search *s, int pose)
{
  const baum_mechanism *m = s->w->mechanism;
  for (int i = 0; i < m->nq; i++) {
    s->q[i] = s->probe->q[i] + (pose > 0 ? DISPLACEMENT * m->scale[i] * irregular(s) : 0.0);
  }
}

static void choose_velocities(search *s, int speed)
{
  const baum_mechanism *m = s->w->mechanism;
  int power = speed - SPEEDS / 2;
  double size = s->probe->rate * pow(10.0, power);
  for (int i = 0; i < m->nv; i++) {
    s->v[i] = size * m->scale[i] * irregular(s);
  }
}

static void set_point(search *s, int pose, bool rest)
{
  static const double TURN = 0.7;
  if (rest) {
    memset(s->v, 0, (size_t)s->w->mechanism->nv * sizeof *s->v);
  }
  baum_i_point_set(&s->w->point, s->probe->t + TURN * pose / s->probe->rate, s->q, s->v);
}

/* ---- forces ---- */

/* What has been added to these columns, which are zeros again afterwards; NaN where it failed. */
static void collect(search *s, baum_status status, const int *columns, int count)
{
  for (int i = 0; i < count; i++) {
    s->now[i] = status == BAUM_OK ? s->sum[columns[i]] : (double)NAN;
  }
  for (int i = 0; i < count; i++) {
    s->sum[columns[i]] = 0.0;
  }
}

/* Puts an element's force at rest aside, or compares with that; returns whether it differs. */
static bool judge(const search *s, bool rest, double *kept, int count)
{
  bool differs = false;
  for (int i = 0; i < count; i++) {
    if (rest) {
      kept[i] = s->now[i];
    } else if (!isnan(kept[i]) && !isnan(s->now[i]) && kept[i] != s->now[i]) {
      differs = true;
    }
  }
  return differs;
}

static bool ask_force(search *s, const baum_i_force *force, bool rest, double *kept)
{
  const baum_i_force_group one = {.type = force->type, .count = 1, .forces = &force};
  baum_status status = force->type->force(&one, &s->w->point, s->sum);
  collect(s, status, force->span.columns, force->span.nl);
  return judge(s, rest, kept, force->span.nl);
}

static bool ask_body(search *s, const baum_i_body *body, bool rest, double *kept)
{
  const baum_i_body_group one = {.type = body->type, .count = 1, .bodies = &body};
  baum_status status = body->type->force(&one, &s->w->point, s->sum);
  collect(s, status, body->span.columns, body->nv);
  return judge(s, rest, kept, body->nv);
}

/* The first element whose force differs from that at rest, into label. */
static bool ask_all(search *s, bool rest, char label[BAUM_I_LABEL_SIZE])
{
  const baum_mechanism *m = s->w->mechanism;
  double *kept = s->rest;
  for (int k = 0; k < m->force_count; k++) {
    if (ask_force(s, m->forces[k], rest, kept)) {
      (void)baum_i_label(&m->forces[k]->element, "force", label);
      return true;
    }
    kept += m->forces[k]->span.nl;
  }
  for (int k = 1; k <= m->body_count; k++) {
    const baum_i_body *body = m->bodies[k];
    if (!body->type->constant_force && ask_body(s, body, rest, kept)) {
      (void)baum_i_label(&body->element, "body", label);
      return true;
    }
    kept += body->nv;
  }
  return false;
}

static bool find_force(search *s, int pose, char label[BAUM_I_LABEL_SIZE])
{
  set_point(s, pose, true);
  (void)ask_all(s, true, label);
  for (int speed = 0; speed < SPEEDS; speed++) {
    choose_velocities(s, speed);
    set_point(s, pose, false);
    if (ask_all(s, false, label)) {
      return true;
    }
  }
  return false;
}

/* ---- masses ---- */

static bool find_mass(search *s, int pose, char label[BAUM_I_LABEL_SIZE])
{
  const baum_mechanism *m = s->w->mechanism;
  set_point(s, pose, true);
  double *mass = pose == 0 ? s->mass : s->other;
  baum_status status = baum_i_mechanism_mass(&s->w->point, mass);
  if (pose == 0 || status != BAUM_OK) {
    return false;
  }
  for (int k = 1; k <= m->body_count; k++) {
    const baum_i_body *body = m->bodies[k];
    size_t bytes = (size_t)body->nv * (size_t)body->nv * sizeof *mass;
    if (memcmp(s->mass + body->mass, s->other + body->mass, bytes) != 0) {
      (void)baum_i_label(&body->element, "body", label);
      return true;
    }
  }
  return false;
}

/* ---- the search ---- */

static baum_i_dependence search_all(search *s, char label[BAUM_I_LABEL_SIZE])
{
  for (int pose = 0; pose < POSES; pose++) {
    choose_pose(s, pose);
    if (find_force(s, pose, label)) {
      return BAUM_I_DEPENDS_FORCE;
    }
    if (!s->w->mechanism->constant_mass && find_mass(s, pose, label)) {
      return BAUM_I_DEPENDS_MASS;
    }
  }
  return BAUM_I_DEPENDS_NOT;
}

static bool make(search *s)
{
  const baum_mechanism *m = s->w->mechanism;
  size_t nv = (size_t)m->nv;
  size_t kept = nv;
  for (int k = 0; k < m->force_count; k++) {
    kept += (size_t)m->forces[k]->span.nl;
  }
  s->memory = baum_i_alloc(4 * nv + kept + 2 * (size_t)m->mass_size, sizeof *s->memory);
  if (!s->memory) {
    return false;
  }
  s->q = s->memory;
  s->v = s->q + nv;
  s->sum = s->v + nv;
  s->now = s->sum + nv;
  s->rest = s->now + nv;
  s->mass = s->rest + kept;
  s->other = s->mass + m->mass_size;
  return true;
}

baum_status baum_i_find_dependence(baum_workspace *w, const baum_i_dependence_probe *probe,
                                   baum_i_dependence *found, char label[BAUM_I_LABEL_SIZE])
{
  search s = {.w = w, .probe = probe, .seed = 1};
  *found = BAUM_I_DEPENDS_NOT;
  label[0] = '\0';
  if (!make(&s)) {
    return baum_i_fail_memory();
  }
  baum_i_sentence kept;
  baum_i_message_keep(&kept);
  *found = search_all(&s, label);
  baum_i_point_set(&w->point, probe->t, probe->q, NULL);
  baum_i_free(s.memory);
  return baum_i_message_settle(BAUM_OK, &kept);
}
