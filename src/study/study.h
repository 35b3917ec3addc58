/* SPDX-License-Identifier: BSD-3-Clause */
/* A study from the inside: settings and their entries, the reference they are compared with, and
 * how entries are run.
 *
 * A run is compared by its samples: a matrix of one line per sample with the columns of a layout
 *
 *   q (nq)   v (nv)   lambda (nc)   kinetic, potential energy (2)   the user's channels
 */
#ifndef BAUM_I_STUDY_STUDY_H
#define BAUM_I_STUDY_STUDY_H

#include <stdatomic.h>

#include <baum/study.h>

#include "base/message.h"
#include "study/threads.h"

enum {
  BAUM_I_NAME_SIZE = 160,
  BAUM_I_NOTE_SIZE = 320,
  BAUM_I_TEXT_SIZE = 640,
  BAUM_I_CHANNELS = 4
};

/* First columns of the parts of a sample. */
typedef struct baum_i_layout {
  int nq, nv, nc;
  int v, lambda, energy, user;
  int width;
} baum_i_layout;

/* Largest differences from the reference, as in baum_study_entry. */
typedef struct baum_i_differences {
  double error[3]; /* whole span, last sample, first half */
  double q[2];     /* whole span, last sample */
  double v[2];
  double lambda[2];
  double energy[2];
} baum_i_differences;

/* What is known of an entry: errors and all that belongs to the motion; of a done one its counts of
 * work and its time, too; and error_validated, as well as it can be. */
typedef enum baum_i_stage {
  BAUM_I_ADDED,
  BAUM_I_MEASURED,
  BAUM_I_TIMED,
  BAUM_I_VALIDATED
} baum_i_stage;

typedef struct baum_i_entry {
  baum_study_entry out; /* name and message are those below */
  baum_simulation_options options;
  double *row_gains; /* own copy of the option */
  char name[BAUM_I_NAME_SIZE];
  char message[BAUM_I_NOTE_SIZE];
  uint64_t key; /* of the options */
  double limit; /* [s] the entry limit when it was measured */
  baum_i_stage stage;
  baum_i_stage filed; /* that the study file had when it was opened */
} baum_i_entry;

/* A motion, and where it is looked at. */
typedef struct baum_i_samples {
  int n;
  double *times;  /* (n) */
  double *values; /* (n x width) NULL: not known */
  double *q;      /* (nq) the start, or NULL: as designed */
  double *v;      /* (nv) likewise */
} baum_i_samples;

/* Entries that differ in step or rtol alone. */
typedef struct baum_i_study_method {
  uint64_t key;
  int first;                   /* entry, for all they have in common */
  char name[BAUM_I_NAME_SIZE]; /* of its entries without step or tolerance */
  double too_fine;             /* step or rtol that has reached the entry limit, else 0 */
} baum_i_study_method;

typedef struct baum_i_study_reference {
  baum_study_reference out;
  char text[BAUM_I_TEXT_SIZE];
  baum_i_samples samples;          /* values NULL: not made */
  baum_simulation_options options; /* of its best run; integrator NULL where there is none */
  bool known;                      /* uncertainties are: it has been made, now or before */

  double *given[3]; /* q, v, lambda as given, or NULL */
  double digits;    /* as given */
  baum_study_solution_fn *solution;
  void *user;

  double *weight; /* (width) on differences */
} baum_i_study_reference;

/* Of other starts, over twice the span. */
enum { BAUM_I_VALIDATIONS = 3 };

struct baum_study {
  const baum_mechanism *mechanism;
  double t0;
  double t1;
  baum_study_options options; /* file is the study's own */

  baum_channel *channels; /* (channel_count) of the user; none: positions */
  int channel_count;
  double unit;
  char error_text[BAUM_I_TEXT_SIZE];

  baum_i_study_reference reference;
  baum_i_samples validations[BAUM_I_VALIDATIONS];
  bool validated; /* they have been made */

  baum_i_entry **entries; /* (entry_count) */
  int entry_count;
  baum_i_study_method *methods; /* (method_count) */
  int method_count;

  bool begun;   /* entries have been run: what they depend on stays */
  bool running; /* within baum_study_run(): its progress must change nothing */
  atomic_int cancelled;
};

/* ---- study.c ---- */

/* A struct of a caller, of this version or an older one, over the default that `to` holds. */
baum_status baum_i_study_take(void *to, size_t size, const void *from, const char *call);

/* BAUM_ERR_STATE within baum_study_run(). */
baum_status baum_i_study_check_idle(const baum_study *study, const char *call);

/* Add settings for each integrator of this build, or for `only` one. */
typedef baum_status baum_i_add_fn(void *user, const baum_integrator *integrator);

/* All settings or none. `missing` is the message where this build has none to add. */
baum_status baum_i_study_add_each(baum_study *study, const baum_integrator *only,
                                  baum_i_add_fn *add, void *user, const char *missing);

/* ---- grid.c ---- */

/* [1/s] of the motion: that at the start, or the mean |v| / scale of a rough run where that is
 * more. A rough run that fails tells what it has seen. What baum_simulation_create() returns, and
 * BAUM_STOP_CANCELLED. */
baum_status baum_i_study_rate(baum_study *study, double *rate);

/* ---- names.c ---- */

/* Such as "rk4 baumgarte auto". */
void baum_i_name_method(const baum_simulation_options *options, char *text, size_t size);

/* Adds ", step 0.001 s" or ", rtol 1e-06". */
void baum_i_name_setting(const baum_simulation_options *options, char *text, size_t size);

/* What tells options from others, with or without step and rtol. */
uint64_t baum_i_options_key(const baum_simulation_options *options, bool with_setting);

/* Step or rtol; 0 for neither. */
double baum_i_setting(const baum_simulation_options *options);

/* ---- samples.c ---- */

baum_i_layout baum_i_study_layout(const baum_study *study);

void baum_i_study_clear_samples(baum_i_samples *samples);

/* The channels of the layout, which are at most BAUM_I_CHANNELS and the user's; returns their
 * number, the user's being added behind. */
int baum_i_study_channels(const baum_study *study, baum_channel *channels);

/* Weights of differences from the reference, whose entries are there. BAUM_ERR_MEMORY and what an
 * evaluation may fail with. */
baum_status baum_i_study_weigh(baum_study *study);

/* Samples of a run against a motion that is known, with the weights of the reference. */
baum_i_differences baum_i_study_compare(const baum_study *study, const baum_i_samples *samples,
                                        const double *values);

/* ---- one_run.c ---- */

/* When a run has to stop. */
typedef struct baum_i_deadline {
  const baum_study *study;
  double limit;    /* [s] of CPU time of this thread */
  double begin;    /* [s] likewise */
  double wall_end; /* [s] of wall time, when the budget is spent */
  bool timed_out;
} baum_i_deadline;

typedef struct baum_i_outcome {
  baum_status status;
  bool created;
  baum_counters counters;
  baum_energy_account account; /* NaN without one */
  double cpu;                  /* [s] */
  char message[BAUM_I_NOTE_SIZE];
} baum_i_outcome;

double baum_i_wall_seconds(void);

/* What is run, and from where through which samples. */
typedef struct baum_i_task {
  const baum_study *study;
  const baum_simulation_options *options;
  const baum_i_samples *samples;
  bool with_account; /* of energy, if the study has it */
} baum_i_task;

/* Run through the samples, and from the start as designed on to the end of the span;
 * values (n x width) NULL: no samples are taken. */
void baum_i_study_run_one(const baum_i_task *task, baum_i_deadline *deadline, double *values,
                          baum_i_outcome *out);

/* A run that is asked for channels and goes nowhere. */
baum_status baum_i_study_probe(const baum_study *study, baum_simulation **out);

/* What is said of a run that takes longer than that [s]. */
void baum_i_say_too_long(double limit, char *text, size_t size);

/* Cancelled, or the budget spent? */
bool baum_i_deadline_stops(const baum_i_deadline *deadline);

/* ---- reference.c ---- */

/* Make the reference: BAUM_OK, also where it is not to be trusted or there is none;
 * BAUM_ERR_MEMORY, what the solution fails with, and what stops all runs. */
baum_status baum_i_study_make_reference(baum_study *study, baum_i_deadline *deadline);

/* Times of the samples, by the options or as given. */
baum_status baum_i_study_set_times(baum_study *study);

void baum_i_study_clear_reference(baum_study *study);

/* ---- validate.c ---- */

/* Make the motions that are validated with. BAUM_OK, also where some cannot be made;
 * BAUM_ERR_MEMORY. */
baum_status baum_i_study_make_validations(baum_study *study, baum_i_deadline *deadline);

/* Is an entry to be validated, all entries being timed? */
bool baum_i_study_wants_validation(const baum_study *study, const baum_i_entry *entry);

/* Largest error of an entry there, NaN where it is not known; samples: (n x width) to work in.
 * BAUM_OK, also for an entry that fails there; BAUM_ERR_MEMORY. */
baum_status baum_i_study_validate(const baum_study *study, const baum_i_entry *entry,
                                  baum_i_deadline *deadline, double *values, double *error);

/* ---- study_file.c ---- */

typedef struct baum_i_study_file baum_i_study_file;

/* Open the file of the options, take entries and reference from it, and go on behind its end. *out
 * is NULL without one. */
baum_status baum_i_study_file_open(baum_study *study, baum_i_study_file **out);
/* Append what is known; with no file BAUM_OK. */
baum_status baum_i_study_file_reference(baum_i_study_file *file, const baum_study *study);
baum_status baum_i_study_file_entry(baum_i_study_file *file, const baum_i_entry *entry);
baum_status baum_i_study_file_close(baum_i_study_file *file);

/* ---- methods.c ---- */

/* The method of an entry's options, which is new if need be; -1 without memory. */
int baum_i_study_find_method(baum_study *study, const baum_simulation_options *options, int entry);

/* Done, timed, with an error of the motion that is asked for, and gains that damp: what may be
 * recommended. */
bool baum_i_study_is_answer(const baum_i_entry *entry);

/* Entries of a method that are done, timed and not off, from coarse to fine; returns how many. Of
 * more the first ones count. */
enum { BAUM_I_METHOD_ENTRIES = 256 };
int baum_i_study_usable(const baum_study *study, int method,
                        const baum_i_entry *entries[BAUM_I_METHOD_ENTRIES]);

#endif
