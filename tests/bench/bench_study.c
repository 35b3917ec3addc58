/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests the settings that a study recommends. The errors of these settings should be as small as
 * requested in runs from other starts, too. The program also shows how much these settings cost
 * compared with the cheapest one.
 *
 * usage: bench_study [PROBLEM]
 *
 * A study with the standard grid recommends a setting for each error. A second study runs the
 * recommended settings and the whole grid from perturbed starts over twice the span. An entry is
 * good enough if its error in the second study is at most the requested one. A recommendation is
 * met if the entry with the recommended setting is good enough. The price of a recommendation is
 * the cost of this entry divided by the cost of the cheapest entry of the grid that is good enough.
 */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "models.h"
#include "timing.h"

enum { STARTS = 5, TARGETS = 5, WHY = 1024 };
static const double TARGET[TARGETS] = {1e-2, 1e-4, 1e-6, 1e-8, 1e-10};
static const double NUDGE[STARTS + 1] = {0.0, 0.03, -0.03, 0.06, -0.06, 0.1};
static const double LONGEST = 0.03; /* [s] limit of a run; recommended entries take less time */

/* ---- problems with perturbed starts ---- */

static baum_status pendulum(double nudge, model *out)
{
  const model_pendulum data = {
    .gravity = MODEL_PENDULUM_A01.gravity, .x = MODEL_PENDULUM_A01.x, .v = nudge};
  return model_pendulum_rod(&data, out);
}

/* Changes the angular velocity of the first body. The other velocities then follow from the
 * constraints. */
static baum_status nudge_rates(model *m, double rate)
{
  baum_mechanism *copy = NULL;
  baum_status status = baum_mechanism_copy(m->mechanism, &copy);
  for (int k = 0; k < m->body_count && status == BAUM_OK; k++) {
    baum_planar_body_def def;
    status = baum_mechanism_get_planar_body(copy, m->bodies[k], &def, sizeof def);
    def.velocity[0] = def.velocity[1] = (double)NAN;
    def.angular_velocity = k == 0 ? rate : (double)NAN;
    status = status == BAUM_OK ? baum_mechanism_set_planar_body(copy, m->bodies[k], &def) : status;
  }
  status = status == BAUM_OK ? baum_mechanism_freeze(copy) : status;
  if (status == BAUM_OK) {
    baum_mechanism *old = m->mechanism;
    m->mechanism = copy;
    copy = old;
  }
  baum_mechanism_destroy(copy);
  return status;
}

static baum_status slider_crank(double nudge, model *out)
{
  baum_status status = model_slider_crank_build((model_slider_crank){.driven = false}, out);
  return status == BAUM_OK ? nudge_rates(out, 150.0 * (1.0 + nudge)) : status;
}

static baum_status four_bar(double nudge, model *out)
{
  baum_status status = model_four_bar(out);
  return status == BAUM_OK ? nudge_rates(out, 2.0 * (1.0 + nudge)) : status;
}

static baum_status andrews(double nudge, model *out)
{
  baum_status status = model_andrews_bodies(out);
  return status == BAUM_OK ? nudge_rates(out, 500.0 * nudge) : status;
}

static baum_status chain(double nudge, model *out)
{
  const double rate[3] = {nudge, -nudge, 2.0 * nudge};
  model_chain data = model_chain_3_data();
  data.rate = rate;
  return model_chain_build(&data, out);
}

static baum_status parallelogram(double nudge, model *out)
{
  return model_parallelogram_build(MODEL_TWO_CRANKS, -1.0 + nudge, out);
}

typedef struct problem {
  const char *name;
  double span; /* [s] */
  baum_status (*build)(double nudge, model *out);
} problem;

static const problem PROBLEMS[] = {
  {"pendulum", 5.0, pendulum}, {"slider_crank", 0.1, slider_crank},   {"four_bar", 2.5, four_bar},
  {"andrews", 0.02, andrews},  {"parallelogram", 5.0, parallelogram}, {"chain", 1.0, chain},
};
enum { PROBLEM_COUNT = sizeof PROBLEMS / sizeof PROBLEMS[0] };

/* ---- recommendations ---- */

typedef struct advice {
  bool given[TARGETS];
  baum_simulation_options options[TARGETS];
} advice;

static baum_study *make_study(const model *m, double span, bool validate)
{
  baum_study *study = NULL;
  baum_study_options o = baum_study_options_default();
  o.repeats = 1;
  o.entry_limit = LONGEST;
  o.energy_account = false;
  o.validate = validate;
  if (baum_study_create(m->mechanism, 0.0, span, &study) != BAUM_OK ||
      baum_study_set_options(study, &o) != BAUM_OK) {
    (void)fprintf(stderr, "%s\n", baum_message());
  }
  return study;
}

static void print_reference(const baum_study *study)
{
  baum_study_reference r;
  if (baum_study_reference_read(study, &r, sizeof r) == BAUM_OK) {
    printf("  reference: %s\n", r.text);
  }
}

static void ask(const baum_study *study, advice *out)
{
  char why[WHY] = "";
  for (int k = 0; k < TARGETS; k++) {
    baum_status status = baum_study_recommend(study, TARGET[k], BAUM_STUDY_WORK, &out->options[k],
                                              sizeof out->options[k], why, sizeof why);
    out->given[k] = status >= BAUM_OK;
    printf("  %.0e: %s\n", TARGET[k], out->given[k] ? why : baum_message());
  }
}

/* ---- recommendations from perturbed starts ---- */

typedef struct tally {
  int asked;
  int met;
  int expensive; /* number of recommendations with a price above 1.5 */
  double worst;
  double sum;
  int priced;
} tally;

static double cost_of(const baum_study_entry *entry)
{
  return (double)(entry->evaluations + entry->factorizations);
}

/* Finds the cheapest of the first `count` entries whose error is at most `target`, and returns its
 * cost. */
static double cheapest(const baum_study *study, int count, double target, char *name, size_t size)
{
  double least = (double)INFINITY;
  for (int k = 0; k < count; k++) {
    baum_study_entry entry;
    if (baum_study_entry_at(study, k, &entry, sizeof entry) == BAUM_OK && entry.repeats > 0 &&
        !entry.off && entry.error <= target && cost_of(&entry) < least) {
      least = cost_of(&entry);
      (void)snprintf(name, size, "%s", entry.name);
    }
  }
  return least;
}

static void judge(const baum_study *study, const advice *given, int grid, tally tallies[TARGETS])
{
  int next = grid;
  for (int k = 0; k < TARGETS; k++) {
    char name[160] = "";
    double least = cheapest(study, grid, TARGET[k], name, sizeof name);
    baum_study_entry entry;
    tally *t = &tallies[k];
    if (!given->given[k] || baum_study_entry_at(study, next++, &entry, sizeof entry) != BAUM_OK) {
      continue;
    }
    bool met = entry.error <= TARGET[k];
    double price = cost_of(&entry) / least;
    t->asked++;
    t->met += met;
    if (isfinite(least)) {
      t->expensive += price > 1.5;
      t->worst = fmax(t->worst, price);
      t->sum += log(price);
      t->priced++;
    }
    if (!met || price > 1.5) {
      printf(
        "    %.0e: %s has the error %.2e at the cost %.0f; the cheapest has the cost %.0f: %s\n",
        TARGET[k], entry.name, entry.error, cost_of(&entry), least, name);
    }
  }
}

static void try_start(const problem *p, const baum_study *grid, const advice *given, double nudge,
                      tally tallies[TARGETS])
{
  model m;
  if (p->build(nudge, &m) != BAUM_OK) {
    (void)fprintf(stderr, "%s: %s\n", p->name, baum_message());
    return;
  }
  baum_study *study = make_study(&m, 2.0 * p->span, false);
  int count = baum_study_entry_count(grid);
  for (int k = 0; k < count; k++) {
    baum_simulation_options o;
    if (baum_study_entry_options(grid, k, &o, sizeof o) == BAUM_OK) {
      (void)baum_study_add(study, &o);
    }
  }
  for (int k = 0; k < TARGETS; k++) {
    if (given->given[k]) {
      (void)baum_study_add(study, &given->options[k]);
    }
  }
  if (baum_study_run(study) < BAUM_OK) {
    (void)fprintf(stderr, "%s: %s\n", p->name, baum_message());
  }
  judge(study, given, count, tallies);
  baum_study_destroy(study);
  model_destroy(&m);
}

static void print_tallies(const tally tallies[TARGETS])
{
  for (int k = 0; k < TARGETS; k++) {
    const tally *t = &tallies[k];
    printf("  %.0e: met %d of %d, price %.2f on average, %.2f at most, above 1.5 %d times\n",
           TARGET[k], t->met, t->asked, exp(t->sum / (t->priced > 0 ? t->priced : 1)), t->worst,
           t->expensive);
  }
}

static bool try_problem(const problem *p)
{
  model m;
  if (p->build(0.0, &m) != BAUM_OK) {
    (void)fprintf(stderr, "%s: %s\n", p->name, baum_message());
    return false;
  }
  double begin = timing_now();
  baum_study *study = make_study(&m, p->span, true);
  baum_status status = baum_study_add_standard(study, NULL);
  status = status == BAUM_OK ? baum_study_run(study) : status;
  printf("%s, %g s: %d entries\n", p->name, p->span, (int)baum_study_entry_count(study));
  print_reference(study);
  advice given;
  tally tallies[TARGETS] = {{0}};
  ask(study, &given);
  for (int k = 1; k <= STARTS; k++) {
    try_start(p, study, &given, NUDGE[k], tallies);
  }
  print_tallies(tallies);
  printf("  %.1f s of CPU time\n", timing_now() - begin);
  (void)fflush(stdout);
  baum_study_destroy(study);
  model_destroy(&m);
  return status >= BAUM_OK;
}

int main(int count, char **words)
{
  bool fine = true;
  for (int k = 0; k < PROBLEM_COUNT; k++) {
    if (count == 1 || strcmp(words[1], PROBLEMS[k].name) == 0) {
      fine = try_problem(&PROBLEMS[k]) && fine;
    }
  }
  return fine ? 0 : 1;
}
