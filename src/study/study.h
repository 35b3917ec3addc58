/* SPDX-License-Identifier: BSD-3-Clause */
/* A study: settings and their entries, the reference that they are compared with, and how entries
 * are run.
 *
 * A run is compared by its samples: a matrix with one line per sample and the columns of a layout
 *
 *   q (nq)   v (nv)   lambda (nc)   kinetic, potential energy (2)   the user's channels */
#ifndef BAUM_I_STUDY_STUDY_H
#define BAUM_I_STUDY_STUDY_H

#include <stdatomic.h>

#include <baum/study.h>

#include "base/message.h"
#include "study/threads.h"

enum {
  BAUM_I_NAME_SIZE = 160,
  BAUM_I_NOTE_SIZE = BAUM_I_MESSAGE_SIZE, /* no message is cut */
  BAUM_I_TEXT_SIZE = 2 * BAUM_I_MESSAGE_SIZE,
  BAUM_I_CHANNELS = 4
};

/* First columns of the parts of a sample, and its width. */
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

/* Stage of an entry. MEASURED: the errors and all other results of the motion are known. TIMED:
 * work and time of an entry that is done are also known. VALIDATED: error_validated is also known,
 * if it could be found. */
typedef enum baum_i_stage {
  BAUM_I_ADDED,
  BAUM_I_MEASURED,
  BAUM_I_TIMED,
  BAUM_I_VALIDATED
} baum_i_stage;

typedef struct baum_i_entry {
  baum_study_entry out; /* name and message point to the members below */
  baum_simulation_options options;
  double *row_gains; /* own copy of the option */
  char name[BAUM_I_NAME_SIZE];
  char message[BAUM_I_NOTE_SIZE];
  uint64_t key; /* of the options */
  double limit; /* [s] entry limit at which it was measured */
  baum_i_stage stage;
  baum_i_stage filed; /* of the study file when it was opened */
} baum_i_entry;

/* A motion at its sample times. */
typedef struct baum_i_samples {
  int n;
  double *times;  /* (n) */
  double *values; /* (n x width) NULL: not known */
  double *q;      /* (nq) the start; NULL: as designed */
  double *v;      /* (nv) likewise */
} baum_i_samples;

/* A method: entries that differ only in step or rtol. */
typedef struct baum_i_study_method {
  uint64_t key;
  int first;                   /* index of the first entry, which has the common options */
  char name[BAUM_I_NAME_SIZE]; /* name of its entries without step or tolerance */
  double too_fine;             /* step or rtol that reached the entry limit, else 0 */
} baum_i_study_method;

typedef struct baum_i_study_reference {
  baum_study_reference out;
  char text[BAUM_I_TEXT_SIZE];
  baum_i_samples samples;          /* values NULL: not made */
  baum_simulation_options options; /* of its best run; integrator NULL without one */
  bool known; /* uncertainties are known, because it was computed now or earlier */

  double *given[3]; /* q, v, lambda as given, or NULL */
  double digits;    /* as given */
  baum_study_solution_fn *solution;
  void *user;

  double *weight; /* (width) of differences */
} baum_i_study_reference;

/* Motions from other starts, over twice the span. */
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
  bool validated; /* they were made */

  baum_i_entry **entries; /* (entry_count) */
  int entry_count;
  baum_i_study_method *methods; /* (method_count) */
  int method_count;

  bool begun;   /* entries have been run, so their common settings cannot change */
  bool running; /* inside baum_study_run(), whose progress callback must not change the study */
  atomic_int cancelled;
};

/* ---- study.c ---- */

/* Copies a caller's struct, of this version or an older one, over the default in `to`. */
baum_status baum_i_study_take(void *to, size_t size, const void *from, const char *call);

/* Returns BAUM_ERR_STATE within baum_study_run(). */
baum_status baum_i_study_check_idle(const baum_study *study, const char *call);

/* Adds the settings of one integrator. */
typedef baum_status baum_i_add_fn(void *user, const baum_integrator *integrator);

/* Calls `add` for each integrator of this build, or for `only`. On failure no setting is added.
 * `missing` is the message where nothing was added. */
baum_status baum_i_study_add_each(baum_study *study, const baum_integrator *only,
                                  baum_i_add_fn *add, void *user, const char *missing);

/* ---- grid.c ---- */

/* Finds the rate of the motion [1/s]: the rate at the start, or the mean |v| / characteristic
 * length of a rough run if that is larger. A rough run that fails counts up to its failure. Returns
 * what baum_simulation_create() returns, and BAUM_STOP_CANCELLED. */
baum_status baum_i_study_rate(baum_study *study, double *rate);

/* ---- names.c ---- */

/* Writes a name such as "rk4 baumgarte auto". */
void baum_i_name_method(const baum_simulation_options *options, char *text, size_t size);

/* Appends ", step 0.001 s" or ", rtol 1e-06". */
void baum_i_name_setting(const baum_simulation_options *options, char *text, size_t size);

/* Returns a key that distinguishes options, with or without step and rtol. */
uint64_t baum_i_options_key(const baum_simulation_options *options, bool with_setting);

/* Returns step or rtol; 0 for neither. */
double baum_i_setting(const baum_simulation_options *options);

/* ---- samples.c ---- */

baum_i_layout baum_i_study_layout(const baum_study *study);

void baum_i_study_clear_samples(baum_i_samples *samples);

/* Lists the channels of the layout: at most BAUM_I_CHANNELS, then the user's. Returns their number.
 */
int baum_i_study_channels(const baum_study *study, baum_channel *channels);

/* Computes the weights of differences from the reference, whose samples must be known. Returns
 * BAUM_ERR_MEMORY, or the status of a failed evaluation. */
baum_status baum_i_study_weigh(baum_study *study);

/* Compares samples of a run with a known motion, by the weights of the reference. */
baum_i_differences baum_i_study_compare(const baum_study *study, const baum_i_samples *samples,
                                        const double *values);

/* ---- one_run.c ---- */

/* When a run must stop. */
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

/* A run: its options, start and samples. */
typedef struct baum_i_task {
  const baum_study *study;
  const baum_simulation_options *options;
  const baum_i_samples *samples;
  bool with_account; /* with an energy account, if the study has one */
} baum_i_task;

/* Runs through the samples and, from the design configuration, on to the end of the span. values (n
 * x width) NULL: takes no samples. */
void baum_i_study_run_one(const baum_i_task *task, baum_i_deadline *deadline, double *values,
                          baum_i_outcome *out);

/* Creates a run that only serves channels. */
baum_status baum_i_study_probe(const baum_study *study, baum_simulation **out);

/* Writes the message of a run that takes longer than `limit` [s]. */
void baum_i_say_too_long(double limit, char *text, size_t size);

/* Tells whether the study is cancelled or its time budget spent. */
bool baum_i_deadline_stops(const baum_i_deadline *deadline);

/* ---- reference.c ---- */

/* Makes the reference. BAUM_OK, even where it is not trusted or none can be made; BAUM_ERR_MEMORY,
 * the status of a failed solution, or a status that stops all runs. */
baum_status baum_i_study_make_reference(baum_study *study, baum_i_deadline *deadline);

/* Sets the times of the samples, by the options or as given. */
baum_status baum_i_study_set_times(baum_study *study);

void baum_i_study_clear_reference(baum_study *study);

/* ---- validate.c ---- */

/* Makes the motions for validation. BAUM_OK, even where some cannot be made; BAUM_ERR_MEMORY. */
baum_status baum_i_study_make_validations(baum_study *study, baum_i_deadline *deadline);

/* Tells whether an entry needs validation, once all entries are timed. */
bool baum_i_study_wants_validation(const baum_study *study, const baum_i_entry *entry);

/* Finds the largest error of an entry over these motions, NaN where it is not known. values (n x
 * width) is scratch. BAUM_OK, even for an entry that fails there; BAUM_ERR_MEMORY. */
baum_status baum_i_study_validate(const baum_study *study, const baum_i_entry *entry,
                                  baum_i_deadline *deadline, double *values, double *error);

/* ---- study_file.c ---- */

typedef struct baum_i_study_file baum_i_study_file;

/* Opens the file of the options, reads entries and reference from it, and continues behind its end.
 * *out is NULL without a file. */
baum_status baum_i_study_file_open(baum_study *study, baum_i_study_file **out);
/* Append what is known; BAUM_OK without a file. */
baum_status baum_i_study_file_reference(baum_i_study_file *file, const baum_study *study);
baum_status baum_i_study_file_entry(baum_i_study_file *file, const baum_i_entry *entry);
baum_status baum_i_study_file_close(baum_i_study_file *file);

/* ---- methods.c ---- */

/* Finds or adds the method of an entry's options; -1 without memory. */
int baum_i_study_find_method(baum_study *study, const baum_simulation_options *options, int entry);

/* Tells whether an entry may be recommended: it is done and timed, followed the right motion, and
 * its gains damp violations. */
bool baum_i_study_is_answer(const baum_i_entry *entry);

/* Lists the entries of a method that are done, timed and not off, from coarse to fine, and returns
 * their number. At most BAUM_I_METHOD_ENTRIES count, the first ones. */
enum { BAUM_I_METHOD_ENTRIES = 256 };
int baum_i_study_usable(const baum_study *study, int method,
                        const baum_i_entry *entries[BAUM_I_METHOD_ENTRIES]);

#endif
