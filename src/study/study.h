/* SPDX-License-Identifier: BSD-3-Clause */
/* The internals of a study: settings and their entries, the reference with which they are compared,
 * and runs of entries.
 *
 * Runs are compared by their samples. Samples are a matrix with one row per sample and the columns
 *
 *   q (nq)   v (nv)   lambda (nc)   kinetic, potential energy (2)   the user's channels */
#ifndef BAUM_I_STUDY_STUDY_H
#define BAUM_I_STUDY_STUDY_H

#include <stdatomic.h>

#include <baum/study.h>

#include "base/text.h"

enum {
  BAUM_I_NOTE_SIZE = BAUM_I_MESSAGE_SIZE, /* no message is cut */
  BAUM_I_TEXT_SIZE = 2 * BAUM_I_MESSAGE_SIZE,
  BAUM_I_CHANNELS = 4
};

/* The numbers of columns, the first columns of the parts of a sample, and the width of a sample. */
typedef struct baum_i_layout {
  int nq, nv, nc;
  int v, lambda, energy, user;
  int width;
} baum_i_layout;

/* Largest differences from the reference, as in baum_study_entry. */
typedef struct baum_i_differences {
  double error[3]; /* over the whole span, at the last sample, over the first half */
  double q[2];     /* over the whole span, at the last sample */
  double v[2];
  double lambda[2];
  double energy[2];
} baum_i_differences;

/* Stage of an entry. MEASURED: the errors and all other results of the motion are known. TIMED: if
 * the run succeeded, work and time are also known. VALIDATED: error_validated is also known, if it
 * could be computed. */
typedef enum baum_i_stage {
  BAUM_I_ADDED,
  BAUM_I_MEASURED,
  BAUM_I_TIMED,
  BAUM_I_VALIDATED
} baum_i_stage;

typedef struct baum_i_entry {
  baum_study_entry out; /* its name and message point to the members below */
  baum_simulation_options options;
  double *row_gains; /* own copy of the array in the options */
  baum_i_text name;
  char message[BAUM_I_NOTE_SIZE];
  uint64_t key; /* key of the options */
  double limit; /* [s] entry limit when it was measured */
  baum_i_stage stage;
  baum_i_stage filed; /* stage in the study file when it was opened */
} baum_i_entry;

/* Samples of a motion. */
typedef struct baum_i_samples {
  int n;
  double *times;  /* (n) */
  double *values; /* (n x width); NULL: not known */
  double *q;      /* (nq) start; NULL: design configuration */
  double *v;      /* (nv) start; NULL: design velocities */
} baum_i_samples;

/* A method: a set of entries that differ only in step or rtol. */
typedef struct baum_i_study_method {
  uint64_t key;
  int first;        /* index of its first entry, which has the common options */
  baum_i_text name; /* name without step or tolerance */
  double too_fine;  /* step or rtol that has reached the entry limit, else 0 */
} baum_i_study_method;

typedef struct baum_i_study_reference {
  baum_study_reference out;
  char text[BAUM_I_TEXT_SIZE];
  baum_i_samples samples;          /* values are NULL if there is no reference */
  baum_simulation_options options; /* options of its run; integrator is NULL if there is none */
  bool known;                      /* uncertainties are known */

  double *given[3]; /* given q, v, lambda, or NULL */
  double digits;    /* number of digits, as given */
  baum_study_solution_fn *solution;
  void *user;

  double *weight; /* (width) weights of differences */
} baum_i_study_reference;

/* Number of motions over twice the span, for validation. */
enum { BAUM_I_VALIDATIONS = 3 };

struct baum_study {
  const baum_mechanism *mechanism;
  double t0;
  double t1;
  baum_study_options options; /* `file` is an own copy */

  baum_channel *channels; /* (channel_count) channels of the user; none: positions */
  int channel_count;
  double unit;
  char error_text[BAUM_I_TEXT_SIZE];

  baum_i_study_reference reference;
  baum_i_samples validations[BAUM_I_VALIDATIONS];
  bool validated; /* the motions for validation have been computed */

  baum_i_entry **entries; /* (entry_count) */
  int entry_count;
  baum_i_study_method *methods; /* (method_count) */
  int method_count;

  bool begun;   /* entries have been run, so common settings cannot change */
  bool running; /* inside baum_study_run(); its progress callback must not change the study */
  atomic_int cancelled;
};

/* ---- study.c ---- */

/* Returns BAUM_ERR_STATE inside baum_study_run(). */
baum_status baum_i_study_check_idle(const baum_study *study, const char *call);

/* A function that adds the settings of one integrator. */
typedef baum_status baum_i_add_fn(void *user, const baum_integrator *integrator);

/* Calls `add` for `only`, or if that is NULL for each integrator of this build. On failure no
 * setting is added. `missing` is the message if nothing was added. */
baum_status baum_i_study_add_each(baum_study *study, const baum_integrator *only,
                                  baum_i_add_fn *add, void *user, const char *missing);

/* ---- grid.c ---- */

/* Finds the rate of the motion [1/s]: the rate at the start, or the mean scaled velocity of a rough
 * run if that is larger. If the rough run fails, its motion up to the failure is used. Statuses of
 * baum_simulation_create(), and BAUM_STOP_CANCELLED. */
baum_status baum_i_study_rate(baum_study *study, double *rate);

/* ---- names.c ---- */

/* Returns a name such as "rk4 baumgarte auto". */
baum_i_text baum_i_method_name(const baum_simulation_options *options);

/* The same with ", step 0.001 s" or ", rtol 1e-06". */
baum_i_text baum_i_options_name(const baum_simulation_options *options);

/* Checks that a study is not NULL: BAUM_OK or BAUM_ERR_ARGUMENT. */
baum_status baum_i_study_check(const baum_study *study, const char *call);

/* Returns a key that is the same for equal options. Step and rtol are included if with_setting. */
uint64_t baum_i_options_key(const baum_simulation_options *options, bool with_setting);

/* Returns step or rtol, or 0 if there is neither. */
double baum_i_setting(const baum_simulation_options *options);

/* ---- samples.c ---- */

baum_i_layout baum_i_study_layout(const baum_study *study);

void baum_i_study_clear_samples(baum_i_samples *samples);

/* Lists the channels of a sample: at most BAUM_I_CHANNELS of the study, then those of the user.
 * Returns their number.
 */
int baum_i_study_channels(const baum_study *study, baum_channel *channels);

/* Computes, from the samples of the reference, the weights with which differences are measured. The
 * reference must be known. Returns BAUM_ERR_MEMORY, or the status of a failed evaluation. */
baum_status baum_i_study_weigh(baum_study *study);

/* Compares the samples `values` of a run with those of a known motion, with the weights of the
 * reference. */
baum_i_differences baum_i_study_compare(const baum_study *study, const baum_i_samples *samples,
                                        const double *values);

/* ---- one_run.c ---- */

/* The time limits of a run. */
typedef struct baum_i_deadline {
  const baum_study *study;
  double limit;    /* [s] CPU time of this thread that the run may use */
  double begin;    /* [s] CPU time of this thread at the beginning */
  double wall_end; /* [s] wall time at which the time budget is spent */
  bool timed_out;
} baum_i_deadline;

typedef struct baum_i_outcome {
  baum_status status;
  bool created;
  baum_counters counters;
  baum_energy_account account; /* NaN: not known */
  double cpu;                  /* [s] */
  char message[BAUM_I_NOTE_SIZE];
} baum_i_outcome;

/* A run to be made: its options, start and samples. */
typedef struct baum_i_task {
  const baum_study *study;
  const baum_simulation_options *options;
  const baum_i_samples *samples;
  bool with_account; /* with an energy account if the study requests it */
} baum_i_task;

/* Runs through the samples and, if it starts from the design configuration, on to the end of the
 * span. values (n x width) receives the samples; NULL: none are computed. */
void baum_i_study_run_one(const baum_i_task *task, baum_i_deadline *deadline, double *values,
                          baum_i_outcome *out);

/* Creates a run that is used only to evaluate channels. */
baum_status baum_i_study_probe(const baum_study *study, baum_simulation **out);

/* Writes the message of a run that takes longer than `limit` [s]. */
void baum_i_say_too_long(double limit, char *text, size_t size);

/* Tells whether the study is cancelled or its time budget spent. */
bool baum_i_deadline_stops(const baum_i_deadline *deadline);

/* ---- reference.c ---- */

/* Computes the reference. Returns BAUM_OK, even if it is not trusted or cannot be computed,
 * BAUM_ERR_MEMORY, the status of a failed solution, or a status that stops all runs. */
baum_status baum_i_study_make_reference(baum_study *study, baum_i_deadline *deadline);

/* Sets the times of the samples: given times, or times according to the options. */
baum_status baum_i_study_set_times(baum_study *study);

void baum_i_study_clear_reference(baum_study *study);

/* ---- validate.c ---- */

/* Computes the motions for validation. Returns BAUM_OK, even if some cannot be computed, or
 * BAUM_ERR_MEMORY. */
baum_status baum_i_study_make_validations(baum_study *study, baum_i_deadline *deadline);

/* Tells whether an entry needs validation. All entries must have been timed. */
bool baum_i_study_wants_validation(const baum_study *study, const baum_i_entry *entry);

/* Finds the largest error of an entry over the motions for validation, or NaN if it is not known.
 * values (n x width) is scratch memory. Returns BAUM_OK, even if a run of the entry fails, or
 * BAUM_ERR_MEMORY. */
baum_status baum_i_study_validate(const baum_study *study, const baum_i_entry *entry,
                                  baum_i_deadline *deadline, double *values, double *error);

/* ---- study_file.c ---- */

typedef struct baum_i_study_file baum_i_study_file;

/* Opens the study file that the options name and reads entries and reference. Later results are
 * appended. *out is NULL if the options name no file. */
baum_status baum_i_study_file_open(baum_study *study, baum_i_study_file **out);
/* Append what is known. If file is NULL, these functions return BAUM_OK. */
baum_status baum_i_study_file_reference(baum_i_study_file *file, const baum_study *study);
baum_status baum_i_study_file_entry(baum_i_study_file *file, const baum_i_entry *entry);
baum_status baum_i_study_file_close(baum_i_study_file *file);

/* ---- methods.c ---- */

/* Finds or adds the method of an entry's options. Returns -1 when out of memory. */
int baum_i_study_find_method(baum_study *study, const baum_simulation_options *options, int entry);

/* Tells whether an entry may be recommended: it is done and timed, has followed the right motion,
 * and its gains damp violations. */
bool baum_i_study_is_answer(const baum_i_entry *entry);

/* Lists the entries of a method that are done, timed and have followed the right motion, from
 * coarse to fine. Returns their number. Only the first BAUM_I_METHOD_ENTRIES are used. */
enum { BAUM_I_METHOD_ENTRIES = 256 };
int baum_i_study_usable(const baum_study *study, int method,
                        const baum_i_entry *entries[BAUM_I_METHOD_ENTRIES]);

#endif
