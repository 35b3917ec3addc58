/* SPDX-License-Identifier: BSD-3-Clause */
#include "sweep_runs.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "problems.h"
#include "timing.h"

static const double RIGHT = 0.01;
static const double GREY = 0.1;
static const char *const NAMES[SWEEP_CLASSES] = {"right", "grey", "wrong", "stopped"};

void sweep_begin(sweep_tally *tally, const char *part, bool fixed, FILE *csv)
{
  memset(tally, 0, sizeof *tally);
  tally->part = part;
  tally->csv = csv;
  for (int k = 0; baum_integrator_at(k); k++) {
    const baum_integrator *integrator = baum_integrator_at(k);
    bool offered = fixed ? baum_integrator_has_fixed_step(integrator)
                         : baum_integrator_has_variable_step(integrator);
    for (int f = BAUM_FORMULATION_UNSTABILIZED; offered && f <= BAUM_FORMULATION_INDEX3; f++) {
      if (baum_integrator_offers(integrator, (baum_formulation)f)) {
        tally->methods[tally->method_count++] =
          (sweep_method){integrator, (baum_formulation)f, fixed};
      }
    }
  }
}

/* ---- one run ---- */

typedef struct outcome {
  sweep_class class;
  baum_status status;
  double error;     /* largest error over all samples */
  double error_end; /* error at the last sample */
  baum_counters c;
  double seconds;
  const char *doubt; /* code of the first warning that doubts the motion, or "" if there is none */
  char text[400];    /* text of this warning, or the reason why the run has stopped */
} outcome;

/* Reads the first warning that doubts the motion. */
static void read_doubts(const baum_simulation *run, outcome *out)
{
  for (int64_t k = 0; k < out->c.warnings && !out->doubt[0]; k++) {
    baum_warning warning;
    if (baum_simulation_warning(run, k, &warning, sizeof warning) == BAUM_OK &&
        warning.doubts_motion) {
      out->doubt = baum_warning_name(warning.code);
      (void)snprintf(out->text, sizeof out->text, "%.399s", warning.text);
    }
  }
}

static double error_at(const sweep_scene *s, int k, const double *q)
{
  double error = 0.0;
  for (int i = 0; i < s->nq; i++) {
    double one = fabs(q[i] - s->want[k][i]) / s->unit[i];
    error = one <= error ? error : one; /* this keeps NaN */
  }
  return error;
}

static sweep_class class_of(const outcome *out)
{
  if (out->status < BAUM_OK) {
    return SWEEP_STOPPED;
  }
  if (out->error < RIGHT) {
    return SWEEP_RIGHT;
  }
  return out->error < GREY ? SWEEP_GREY : SWEEP_WRONG;
}

static outcome run_once(const sweep_scene *s, const baum_simulation_options *o)
{
  const baum_channel positions = baum_channel_of(BAUM_Q);
  double *flat = calloc((size_t)SWEEP_SAMPLES * (size_t)s->nq, sizeof *flat);
  baum_simulation *run = NULL;
  int64_t done = 0;
  double begin = timing_now();
  outcome out = {.doubt = "", .status = baum_simulation_create(s->m.mechanism, o, &run)};
  if (run && flat) {
    out.status = baum_simulation_sample(run, s->times, SWEEP_SAMPLES, &positions, 1, flat, &done);
    (void)baum_simulation_counters(run, &out.c, sizeof out.c);
  }
  out.seconds = timing_now() - begin;
  for (int k = 0; k < done; k++) {
    out.error_end = error_at(s, k, flat + (ptrdiff_t)k * s->nq);
    out.error = out.error_end <= out.error ? out.error : out.error_end;
  }
  if (out.status < BAUM_OK) {
    (void)snprintf(out.text, sizeof out.text, "%.399s", baum_message());
  } else {
    read_doubts(run, &out);
  }
  out.class = class_of(&out);
  baum_simulation_destroy(run);
  free(flat);
  return out;
}

/* ---- output of a run ---- */

void sweep_csv_head(FILE *csv)
{
  (void)fprintf(
    csv, "part,scene,parameter,gravity,growth,integrator,formulation,setting,step_rad,status,"
         "class,doubts,warnings,error,error_end,max_phi,predicted_phi,max_phi_rate,"
         "energy_change,energy,intervals,branch_warnings,near_singular,forced,steps,rejected,"
         "evaluations,seconds,doubt,text\n");
}

static void write_csv(FILE *csv, const char *part, const sweep_scene *s, const sweep_method *with,
                      double setting, const outcome *r)
{
  (void)fprintf(csv, "%s,%s,%.9g,%g,%.4g,%s,%s,%.9g,%.4g,%s,%s,%lld,%lld,", part, s->name,
                s->parameter, s->gravity, s->growth, baum_integrator_name(with->integrator),
                baum_formulation_name(with->formulation), setting,
                with->fixed ? setting * s->rate : (double)NAN, baum_status_name(r->status),
                NAMES[r->class], (long long)r->c.doubts, (long long)r->c.warnings);
  (void)fprintf(
    csv, "%.4g,%.4g,%.4g,%.4g,%.4g,%.4g,%.4g,%lld,%lld,%lld,%lld,%lld,%lld,%lld,%.3g,%s,", r->error,
    r->error_end, r->c.max_phi, r->c.predicted_phi, r->c.max_phi_rate, r->c.energy_change,
    s->energy, (long long)r->c.near_singular_intervals, (long long)r->c.branch_warnings,
    (long long)r->c.near_singular, (long long)r->c.forced_steps, (long long)r->c.steps,
    (long long)r->c.rejected, (long long)r->c.evaluations, r->seconds, r->doubt);
  (void)fputc('"', csv);
  for (const char *c = r->text; *c; c++) {
    (void)fputc(*c == '"' ? '\'' : *c, csv);
  }
  (void)fputs("\"\n", csv);
}

static void keep_fault(sweep_tally *tally, const sweep_scene *s, int method, double setting,
                       const outcome *r)
{
  if (tally->fault_count < SWEEP_FAULTS) {
    sweep_fault *fault = &tally->faults[tally->fault_count++];
    fault->method = method;
    (void)snprintf(fault->text, sizeof fault->text,
                   "%-18s %-8.4g gravity %-4g growth %-7.2g %s %-10.4g error %-8.2g max |Phi| "
                   "%-8.1e energy %+.2g of %.2g J",
                   s->name, s->parameter, s->gravity, s->growth,
                   tally->methods[method].fixed ? "step" : "rtol", setting, r->error, r->c.max_phi,
                   r->c.energy_change, s->energy);
  }
}

sweep_class sweep_run(sweep_tally *tally, const sweep_scene *scene, int method, double setting)
{
  const sweep_method *with = &tally->methods[method];
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = with->integrator;
  o.formulation = with->formulation;
  o.max_steps = with->fixed ? 1000000 : 10000; /* right runs take at most 8300 steps */
  *(with->fixed ? &o.step : &o.rtol) = setting;
  outcome r = run_once(scene, &o);
  tally->runs[method][r.class]++;
  tally->doubted[method][r.class] += r.c.doubts > 0;
  if (r.class == SWEEP_WRONG && r.c.doubts == 0) {
    keep_fault(tally, scene, method, setting, &r);
  }
  if (tally->csv) {
    write_csv(tally->csv, tally->part, scene, with, setting, &r);
  }
  return r.class;
}

/* Returns the index of a method in `all`. If the method is new, adds it. */
static int place_of(sweep_tally *all, const sweep_method *method)
{
  int k = 0;
  while (k < all->method_count && memcmp(&all->methods[k], method, sizeof *method) != 0) {
    k++;
  }
  if (k == all->method_count) {
    all->methods[all->method_count++] = *method;
  }
  return k;
}

void sweep_add(const sweep_tally *part, sweep_tally *all)
{
  for (int k = 0; k < part->method_count; k++) {
    int place = place_of(all, &part->methods[k]);
    for (int c = 0; c < SWEEP_CLASSES; c++) {
      all->runs[place][c] += part->runs[k][c];
      all->doubted[place][c] += part->doubted[k][c];
    }
  }
}

/* ---- printed tables ---- */

static void print_counts(const char *name, const int *runs, const int *doubted)
{
  int all = runs[SWEEP_RIGHT] + runs[SWEEP_GREY] + runs[SWEEP_WRONG] + runs[SWEEP_STOPPED];
  if (all == 0) {
    return;
  }
  double share = runs[SWEEP_RIGHT] ? 100.0 * doubted[SWEEP_RIGHT] / runs[SWEEP_RIGHT] : 0.0;
  printf("%-34s %6d %6d %6d %5.1f%% %6d %6d %6d %6d %6d\n", name, all, runs[SWEEP_RIGHT],
         doubted[SWEEP_RIGHT], share, runs[SWEEP_GREY], doubted[SWEEP_GREY], runs[SWEEP_WRONG],
         runs[SWEEP_WRONG] - doubted[SWEEP_WRONG], runs[SWEEP_STOPPED]);
}

int sweep_print(const sweep_tally *tally)
{
  int runs[SWEEP_CLASSES] = {0};
  int doubted[SWEEP_CLASSES] = {0};
  char name[PAIR_SIZE];
  printf("\n%-34s %6s %6s %13s %6s %6s %6s %6s %7s\n", tally->part, "runs", "right", "false alarms",
         "grey", "doubt", "wrong", "silent", "stopped");
  for (int k = 0; k < tally->method_count; k++) {
    problem_pair(tally->methods[k].integrator, tally->methods[k].formulation, name);
    print_counts(name, tally->runs[k], tally->doubted[k]);
    for (int c = 0; c < SWEEP_CLASSES; c++) {
      runs[c] += tally->runs[k][c];
      doubted[c] += tally->doubted[k][c];
    }
  }
  print_counts("all", runs, doubted);
  for (int k = 0; k < tally->fault_count; k++) {
    const sweep_method *with = &tally->methods[tally->faults[k].method];
    problem_pair(with->integrator, with->formulation, name);
    printf("silent: %-32s %s\n", name, tally->faults[k].text);
  }
  (void)fflush(stdout);
  return runs[SWEEP_WRONG] - doubted[SWEEP_WRONG];
}
