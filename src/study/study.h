/* SPDX-License-Identifier: BSD-3-Clause */
/* The internals of a study. A study has an entry for each setting, and a reference. It runs the
 * entries and compares their motions with the reference.
 *
 * Runs are compared at samples. The samples of a run form a matrix with one row for each sample and
 * these columns:
 *
 *   q (nq)   v (nv)   lambda (nc)   kinetic, potential energy (2)   the user's channels */
#ifndef BAUM_I_STUDY_STUDY_H
#define BAUM_I_STUDY_STUDY_H

#include <stdatomic.h>

#include <baum/study.h>

#include "base/text.h"

enum {
  BAUM_I_NOTE_SIZE = BAUM_I_MESSAGE_SIZE, /* large enough for every message */
  BAUM_I_TEXT_SIZE = 2 * BAUM_I_MESSAGE_SIZE,
  BAUM_I_CHANNELS = 4
};

/* The columns of a sample: the numbers of columns, the first column of each part, and the total
 * width. */
typedef struct baum_i_layout {
  int nq, nv, nc;
  int v, lambda, energy, user;
  int width;
} baum_i_layout;

/* The largest differences between a run and the reference, as in baum_study_entry. */
typedef struct baum_i_differences {
  double error[3]; /* over the whole span, at the last sample, and over the first half */
  double q[2];     /* over the whole span, and at the last sample */
  double v[2];
  double lambda[2];
  double energy[2];
} baum_i_differences;

/* The stage that an entry has reached. MEASURED: the errors and all other results of the motion are
 * known. TIMED: the work and the time of the run are also known. VALIDATED: error_validated is also
 * known, if it could be computed. */
typedef enum baum_i_stage {
  BAUM_I_ADDED,
  BAUM_I_MEASURED,
  BAUM_I_TIMED,
  BAUM_I_VALIDATED
} baum_i_stage;

typedef struct baum_i_entry {
  baum_study_entry out; /* the results; `name` and `message` in it point to the members below */
  baum_simulation_options options;
  double *row_gains; /* a copy of the array that the options contain */
  baum_i_text name;
  char message[BAUM_I_NOTE_SIZE];
  uint64_t key; /* key that identifies the options */
  double limit; /* [s] the time limit per entry when this entry was measured */
  int rank;     /* number of coarser entries of the method, when the runs were ordered */
  baum_i_stage stage;
  baum_i_stage filed; /* the stage of the entry in the study file when the file was opened */
} baum_i_entry;

/* Samples of a motion, and its start. */
typedef struct baum_i_samples {
  int n;
  double *times;  /* (n) */
  double *values; /* (n x width) or NULL if not known */
  double *q;      /* (nq) positions at the start, or NULL for the design configuration */
  double *v;      /* (nv) velocities at the start, or NULL for the design velocities */
} baum_i_samples;

/* A method: a set of entries that differ only in step or rtol. */
typedef struct baum_i_study_method {
  uint64_t key;
  /* Index of the first entry. Its options, except step and rtol, are the options of the method. */
  int first;
  baum_i_text name; /* name without the step or the tolerance */
  double too_fine;  /* largest step or rtol at which an entry reached its time limit, or 0 */
} baum_i_study_method;

typedef struct baum_i_study_reference {
  baum_study_reference out;
  char text[BAUM_I_TEXT_SIZE];
  baum_i_samples samples; /* `values` is NULL if there is no reference */
  /* Options of the run that became the reference; `integrator` is NULL if there is no such run. */
  baum_simulation_options options;
  bool known; /* whether the uncertainties are known */

  double *given[3]; /* the given samples of q, v and lambda; each may be NULL */
  double digits;    /* the number of correct digits that the user has stated */
  baum_study_solution_fn *solution;
  void *user;

  double *weight; /* (width) the weights with which differences are multiplied */
} baum_i_study_reference;

/* Number of motions for validation. Each of them covers twice the span. */
enum { BAUM_I_VALIDATIONS = 3 };

struct baum_study {
  const baum_mechanism *mechanism;
  double t0;
  double t1;
  baum_study_options options; /* `file` is a copy */

  /* (channel_count) the user's channels; if there are none, positions are compared. */
  baum_channel *channels;
  int channel_count;
  double unit;
  char error_text[BAUM_I_TEXT_SIZE];

  baum_i_study_reference reference;
  baum_i_samples validations[BAUM_I_VALIDATIONS];
  bool validated; /* whether the motions for validation have been computed */

  baum_i_entry **entries; /* (entry_count) */
  int entry_count;
  baum_i_study_method *methods; /* (method_count) */
  int method_count;

  /* Whether baum_study_run() has begun. Settings that all entries share cannot change
   * afterwards. */
  bool begun;
  /* Set inside baum_study_run(), where the progress callback must not change the study. */
  bool running;
  atomic_int cancelled;
};

/* ---- study.c ---- */

/* Returns BAUM_ERR_STATE if baum_study_run() is running, and BAUM_OK otherwise. */
baum_status baum_i_study_check_idle(const baum_study *study, const char *call);

/* A function that adds the settings for one integrator to a study. */
typedef baum_status baum_i_add_fn(void *user, const baum_integrator *integrator);

/* Calls `add` for the integrator `only`, or for each integrator of this build if `only` is NULL. If
 * a call fails, the study keeps none of the new settings. If no call has added a setting,
 * baum_i_study_add_each() fails with the message `missing`. */
baum_status baum_i_study_add_each(baum_study *study, const baum_integrator *only,
                                  baum_i_add_fn *add, void *user, const char *missing);

/* ---- grid.c ---- */

/* Finds the rate of the motion [1/s]. This is the rate at the start or the mean scaled velocity of
 * a rough run, whichever is larger. If the rough run fails, the motion up to the failure counts.
 * Returns the status of baum_simulation_create(), or BAUM_STOP_CANCELLED. */
baum_status baum_i_study_rate(baum_study *study, double *rate);

/* ---- names.c ---- */

/* Returns the name of a method, such as "rk4 baumgarte auto". */
baum_i_text baum_i_method_name(const baum_simulation_options *options);

/* Returns the name of a setting. This is the name of its method and, for example, ", step 0.001 s"
 * or ", rtol 1e-06". */
baum_i_text baum_i_options_name(const baum_simulation_options *options);

/* Checks that a study is not NULL. Returns BAUM_OK or BAUM_ERR_ARGUMENT. */
baum_status baum_i_study_check(const baum_study *study, const char *call);

/* Returns a key that identifies options. Equal options have equal keys. If `with_setting` is false,
 * options that differ only in step or rtol also have equal keys. */
uint64_t baum_i_options_key(const baum_simulation_options *options, bool with_setting);

/* Returns the step or rtol of the options. Returns 0 if they have neither. */
double baum_i_setting(const baum_simulation_options *options);

/* ---- samples.c ---- */

baum_i_layout baum_i_study_layout(const baum_study *study);

void baum_i_study_clear_samples(baum_i_samples *samples);

/* Lists the channels of a sample, and returns their number. At most BAUM_I_CHANNELS channels, which
 * are the same in every study, precede the channels of the user.
 */
int baum_i_study_channels(const baum_study *study, baum_channel *channels);

/* Computes the weights by which differences are multiplied. The weights depend on the samples of
 * the reference, which must be known. Returns BAUM_OK, BAUM_ERR_MEMORY, or the status of a failed
 * evaluation. */
baum_status baum_i_study_weigh(baum_study *study);

/* Compares `values`, the samples of a run, with the samples of a known motion. The differences have
 * the same weights as differences from the reference. */
baum_i_differences baum_i_study_compare(const baum_study *study, const baum_i_samples *samples,
                                        const double *values);

/* ---- one_run.c ---- */

/* The time limits of a run. */
typedef struct baum_i_deadline {
  const baum_study *study;
  double limit;    /* [s] largest CPU time of this thread that the run may use */
  double begin;    /* [s] CPU time of this thread when the run began */
  double wall_end; /* [s] wall time at which the time budget of the study is used up */
  bool timed_out;
} baum_i_deadline;

typedef struct baum_i_outcome {
  baum_status status;
  bool created;
  baum_counters counters;
  baum_energy_account account; /* its numbers are NaN if not known */
  double cpu;                  /* [s] */
  char message[BAUM_I_NOTE_SIZE];
} baum_i_outcome;

/* A run to be made: its options, its start and its samples. */
typedef struct baum_i_task {
  const baum_study *study;
  const baum_simulation_options *options;
  const baum_i_samples *samples;
  bool with_account; /* if false, no energy account is kept, even if the study requests one */
} baum_i_task;

/* Makes one run and writes its samples to values (n x width). A run from the design configuration
 * continues to the end of the span after the last sample. If `values` is NULL, the run computes no
 * samples and only advances to the end of the span. */
void baum_i_study_run_one(const baum_i_task *task, baum_i_deadline *deadline, double *values,
                          baum_i_outcome *out);

/* Creates a run that serves only to evaluate the initial state and channels. */
baum_status baum_i_study_probe(const baum_study *study, baum_simulation **out);

/* Writes the message for a run that has taken longer than `limit` [s]. */
void baum_i_say_too_long(double limit, char *text, size_t size);

/* Tells whether the study has been cancelled or its time budget is used up. */
bool baum_i_deadline_stops(const baum_i_deadline *deadline);

/* ---- reference.c ---- */

/* Computes the reference of a study. Returns BAUM_OK even if the reference is not trusted or if all
 * its runs failed. Otherwise returns BAUM_ERR_MEMORY, BAUM_STOP_CANCELLED, BAUM_ERR_CALLBACK if the
 * user's solution failed, or the status of a failed evaluation. */
baum_status baum_i_study_make_reference(baum_study *study, baum_i_deadline *deadline);

/* Sets the times of the samples from the options, unless the samples of the reference are given. */
baum_status baum_i_study_set_times(baum_study *study);

void baum_i_study_clear_reference(baum_study *study);

/* ---- validate.c ---- */

/* Computes the motions for validation. Returns BAUM_ERR_MEMORY, or BAUM_OK even if some of the
 * motions could not be computed. */
baum_status baum_i_study_make_validations(baum_study *study, baum_i_deadline *deadline);

/* Tells whether an entry needs validation. The answer is final only after all entries are timed. */
bool baum_i_study_wants_validation(const baum_study *study, const baum_i_entry *entry);

/* Finds the largest error of an entry over the motions for validation. The error is NaN if none of
 * these motions is known, and infinite if a run of the entry failed. values (n x width) is scratch
 * memory. Returns BAUM_OK or BAUM_ERR_MEMORY. */
baum_status baum_i_study_validate(const baum_study *study, const baum_i_entry *entry,
                                  baum_i_deadline *deadline, double *values, double *error);

/* ---- study_file.c ---- */

typedef struct baum_i_study_file baum_i_study_file;

/* Opens the study file that the options name. Reads entries and the reference from this file, and
 * appends known results of entries that are not in it. *out is NULL if the options name no file. */
baum_status baum_i_study_file_open(baum_study *study, baum_i_study_file **out);
/* The first function appends the reference to the study file, the second one appends an entry, and
 * the third one closes the file. They return BAUM_OK if `file` is NULL. */
baum_status baum_i_study_file_reference(baum_i_study_file *file, const baum_study *study);
baum_status baum_i_study_file_entry(baum_i_study_file *file, const baum_i_entry *entry);
baum_status baum_i_study_file_close(baum_i_study_file *file);

/* ---- methods.c ---- */

/* Finds the method to which an entry with these options belongs, or adds a new method. Returns -1
 * when out of memory. */
int baum_i_study_find_method(baum_study *study, const baum_simulation_options *options, int entry);

/* Tells whether an entry may be recommended. It must be done and timed, it must have followed the
 * right motion, and its gains must damp violations. */
bool baum_i_study_is_answer(const baum_i_entry *entry);

/* Lists entries of a method from coarse to fine. The list contains at most BAUM_I_METHOD_ENTRIES
 * entries that are done and timed and have followed the right motion. Returns their number. */
enum { BAUM_I_METHOD_ENTRIES = 256 };
int baum_i_study_usable(const baum_study *study, int method,
                        const baum_i_entry *entries[BAUM_I_METHOD_ENTRIES]);

#endif
