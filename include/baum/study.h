/* SPDX-License-Identifier: BSD-3-Clause */
/** @file
 *  Studies measure the accuracy and the cost of integration methods. A study runs one mechanism
 *  over one time span with many settings, which are integrators with their options. It measures the
 *  error and the cost of each setting, and recommends one of them.
 *
 *    baum_study_create(mechanism, 0.0, 2.0, &study);
 *    baum_study_add_standard(study, NULL);
 *    baum_study_run(study);
 *    baum_study_recommend(study, 1e-6, BAUM_STUDY_WORK, &options, sizeof options, why, sizeof why);
 *
 *  An *entry* is one setting with its results. A *method* is the set of entries with the same
 *  integrator, formulation and gains; its entries differ only in step or rtol. Errors are
 *  differences from a *reference*, which is a very accurate motion. If the time span is from t0 to
 *  t1, errors are measured at the n times t0 + k (t1 - t0) / n with k = 1 to n; the option
 *  `samples` gives n. The study computes the reference itself, or uses a reference that you give.
 *  The study never reports an error that is smaller than the uncertainty of the reference. The page
 *  "docs/theory/work-precision.md" explains the details.
 *
 *  Threads: only one thread at a time may use a study, except that any thread may call
 *  baum_study_cancel(). The option `threads` gives the number of threads of baum_study_run(), and
 *  each of these threads calls the user functions of the mechanism. The progress function (option
 *  `progress`) may cancel the study. If the study uses one thread only, the progress function may
 *  also read the study. Inside the progress function, functions that change the study fail with
 *  BAUM_ERR_STATE, and baum_study_destroy() does nothing.
 *
 *  The study owns all texts that its functions return. These texts are valid until the next call
 *  that changes the study.
 */
#ifndef BAUM_STUDY_H
#define BAUM_STUDY_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <baum/mechanism.h>
#include <baum/simulation.h>

#ifdef __cplusplus
extern "C" {
#endif

/** A study: many runs of one mechanism with different settings. */
typedef struct baum_study baum_study;

/* ---- creation -------------------------------------------------------------------------------- */

/** Create a study without entries.
 *  @param      mechanism  frozen; it stays in memory as long as the study exists
 *  @param      t0         [s] finite, start of all runs
 *  @param      t1         [s] finite, end of all runs; must differ from t0. If t1 < t0, the runs go
 *                         backward in time
 *  @param[out] out        receives the study, NULL on failure; release it with baum_study_destroy()
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STATE (not frozen), BAUM_ERR_MEMORY */
BAUM_API baum_status baum_study_create(const baum_mechanism *mechanism, double t0, double t1,
                                       baum_study **out);

/** Release a study. @param study  may be NULL */
BAUM_API void baum_study_destroy(baum_study *study);

/** A progress function. A study calls it twice for each entry: after the run that determines the
 *  error, and after the runs that measure the CPU time. Only one thread at a time calls it, but
 *  this thread may differ from the one that called baum_study_run().
 *  @param study  the study
 *  @param done   number of entries whose error is known, plus number of entries whose CPU time is
 *                known
 *  @param total  2 x number of entries
 *  @param user   the option `user`
 *  @return  non-zero to cancel */
typedef int baum_study_progress_fn(const baum_study *study, int32_t done, int32_t total,
                                   void *user);

/** The options of a study. */
typedef struct baum_study_options {
  size_t struct_size; /**< Set by the default function. Do not write. */
  /** [-] number of samples at which the error is measured; 2 to 1e6, and at most 1e8 / (nq + nv +
   *  nc). Default: 100. */
  int32_t samples;
  /** [-] 1 to 1024, number of threads that compute errors. Times are measured afterwards, in one
   *  thread. Default: 1. */
  int32_t threads;
  /** [-] 1 to 1e6, largest number of runs that measure the time of an entry. Entries with long runs
   *  are measured by fewer runs. Default: 5. */
  int32_t repeats;
  /** [s] > 0, largest CPU time of a run; may be infinite. A run that computes the reference may
   *  take five times this limit. Default: 10. */
  double entry_limit;
  /** [s] > 0, largest wall time of one call of baum_study_run(); may be infinite.
   *  Default: infinity. */
  double time_budget;
  /** Measure the work that stabilization and projection do on the mechanism. This needs additional
   *  evaluations; baum_energy_account states how many. Default: true. */
  bool energy_account;
  /** Path of the study file, see baum_study_run(). Copied. Default: NULL, none. */
  const char *file;
  /** The study calls this function to report its progress. Default: NULL, none. */
  baum_study_progress_fn *progress;
  void *user; /**< Passed to the function `progress`. Not owned. Default: NULL. */
  /** Validate entries before one is recommended: run them again, over twice the span and from
   *  perturbed starts. The recommendation is then also valid for such runs. Default: true. */
  bool validate;
} baum_study_options;

/** Set every field to its default.
 *  @param[out] options      NULL is ignored
 *  @param      caller_size  sizeof *options; no byte beyond it is written */
BAUM_API void baum_study_options_init(baum_study_options *options, size_t caller_size);
/** @copydoc baum_coordinates_def_default() */
static inline baum_study_options baum_study_options_default(void)
{
  baum_study_options options;
  baum_study_options_init(&options, sizeof options);
  return options;
}

/** Set the options of a study. After the first baum_study_run(), the options samples,
 *  energy_account and file must not change.
 *  @param     study    unchanged on failure
 *  @param[in] options  copied
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STRUCT, BAUM_ERR_STATE, BAUM_ERR_MEMORY */
BAUM_API baum_status baum_study_set_options(baum_study *study, const baum_study_options *options);

/* ---- settings -------------------------------------------------------------------------------- */

/** Add one setting. The setting is not checked before it runs. If it cannot run, its entry is
 *  marked as refused.
 *  @param     study    unchanged on failure
 *  @param[in] options  copied; start_time, progress and user are ignored
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT (NULL, or no integrator), BAUM_ERR_STRUCT, BAUM_ERR_STATE,
 *           BAUM_ERR_MEMORY */
BAUM_API baum_status baum_study_add(baum_study *study, const baum_simulation_options *options);

/** The definition of a standard grid: which settings it contains. */
typedef struct baum_study_grid {
  size_t struct_size; /**< Set by the default function. Do not write. */
  /** Use only this integrator. Default: NULL, all integrators of this build. */
  const baum_integrator *integrator;
  /** Use only this formulation. Default: BAUM_FORMULATION_DEFAULT, all formulations. */
  baum_formulation formulation;
  /** [-] 1 to 64, number of step sizes or tolerances of each method. Default: 8. */
  int32_t settings;
  /** [-] 0 to 4, number of constant gains alpha = beta. The grid contains them in addition to the
   *  integrator's default rule and to automatic gains. The first gain is the rate of the motion
   *  [1/s]. This rate is the larger of two numbers. One is the rate r at the start, which the
   *  description of the run option tolerance_lambda defines. The other is the largest |v_j| / s_j
   *  over all coordinates j, averaged over a trial run; s_j is the scale of coordinate j
   *  (mechanism.h). Each further gain is ten times the gain before it. Default: 2. */
  int32_t constants;
  /** [s] > 0, longest step of integrators of the orders 3 to 5. The longest steps of integrators of
   *  the orders 1, 2 and 8 are 0.2, 0.6 and 1.6 times this step. Default: NaN, chosen from the time
   *  scale of the motion. */
  double coarsest;
  /** [-] > 0, < 1e-2, smallest rtol of the grid; its largest rtol is 1e-2. Default: NaN, which
   *  means 1e-13. If a user constraint has neither `jacobian` nor `gamma`, NaN means 1e-11, because
   *  finite differences are not more accurate than this. */
  double finest;
  /** A smaller grid for a first answer. Its cost is approximately 1/25 of the cost of the default
   *  grid. It contains every integrator with its default gains and its default formulation, or with
   *  `formulation` if this field is set. Each integrator has at most 5 step sizes and at most 5
   *  tolerances, and `constants` is ignored. Default: false. */
  bool quick;
} baum_study_grid;

/** Set every field to its default.
 *  @param[out] grid         NULL is ignored
 *  @param      caller_size  sizeof *grid; no byte beyond it is written */
BAUM_API void baum_study_grid_init(baum_study_grid *grid, size_t caller_size);
/** @copydoc baum_coordinates_def_default() */
static inline baum_study_grid baum_study_grid_default(void)
{
  baum_study_grid grid;
  baum_study_grid_init(&grid, sizeof grid);
  return grid;
}

/** Add the standard grid of settings. It contains every integrator of the build with each of its
 *  formulations. The formulation BAUMGARTE occurs with the default gains of the integrator, with
 *  automatic gains and with some constant gains. Each combination of integrator, formulation and
 *  gains gets several step sizes or tolerances, from coarse to fine. The step sizes follow from the
 *  time scale of the motion, which a trial run determines.
 *  @param     study  unchanged on failure
 *  @param[in] grid   NULL means the default
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT (also if no integrator of the build matches the fields
 *           `integrator` and `formulation` of the grid), BAUM_ERR_STRUCT, BAUM_ERR_STATE,
 *           BAUM_ERR_MEMORY, BAUM_STOP_CANCELLED; if the mechanism cannot be started, the status of
 *           baum_simulation_create() */
BAUM_API baum_status baum_study_add_standard(baum_study *study, const baum_study_grid *grid);

/** Add stress settings, which are extreme on purpose. Steps range from 1e-1 to 1e-9 of a period,
 *  and rtol from 1e-2 to 1e-14. Here, a period is 2 pi divided by the rate of the motion; the
 *  comment on the field `constants` of baum_study_grid defines this rate. The formulation
 *  BAUMGARTE also runs with gains alpha = beta of 0 and of 1e-6 to 1e12 [1/s]; the step is then
 *  1e-3 of a period, or rtol is 1e-7. Every entry should be as accurate as its setting
 *  suggests, or have a message or a warning that says why it is not. The option entry_limit bounds
 *  the CPU time of entries with tiny steps.
 *  @param study       unchanged on failure
 *  @param integrator  NULL means all integrators of this build that take the option step or rtol
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT (also if the build does not contain `integrator`),
 *           BAUM_ERR_STATE, BAUM_ERR_MEMORY, BAUM_STOP_CANCELLED; if the mechanism cannot be
 *           started, the status of baum_simulation_create() */
BAUM_API baum_status baum_study_add_stress(baum_study *study, const baum_integrator *integrator);

/* ---- error and reference --------------------------------------------------------------------- */

/** Define what the study reports as error. After this call, the error is the largest value of
 *  |difference from the reference| / unit over all columns of the given channels. Without this
 *  call, the error is the largest error of all positions, with lengths relative to the
 *  characteristic length and angles in radians. Call this function before the first
 *  baum_study_run().
 *  @param     study     unchanged on failure
 *  @param[in] channels  (count) copied
 *  @param     count     [-] >= 1
 *  @param     unit      [unit of the channels] > 0, finite; a difference of this size is an error
 *                       of 1
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STRUCT (of a channel), BAUM_ERR_STATE,
 *           BAUM_ERR_MEMORY */
BAUM_API baum_status baum_study_set_error(baum_study *study, const baum_channel *channels,
                                          int32_t count, double unit);

/** Give a reference as samples. Errors are then measured at the times of these samples, and the
 *  option samples is ignored. Values that are NaN are not compared. Call this function before the
 *  first baum_study_run(). The study counts the revolutions of angles between bodies in space from
 *  sample to sample. If two samples are too far apart for this count, then from the second of
 *  them on the study does not compare energies, and it compares only those channels of
 *  baum_study_set_error() that contain q, poses or Phi.
 *  @param     study   unchanged on failure
 *  @param[in] times   (n) [s] strictly monotone, from t0 (excluded) to t1
 *  @param     n       [-] >= 1
 *  @param[in] q       (n x nq) positions, copied
 *  @param[in] v       (n x nv) velocities, copied. NULL if they are unknown
 *  @param[in] lambda  (n x nc) multipliers, copied. NULL if they are unknown
 *  @param     digits  [-] > 0, number of digits of the reference that can be trusted. The study
 *                     does not distinguish errors below 10^-digits
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STATE, BAUM_ERR_MEMORY */
BAUM_API baum_status baum_study_set_reference(baum_study *study, const double *times, int32_t n,
                                              const double *q, const double *v,
                                              const double *lambda, double digits);

/** A function that computes the exact motion, for baum_study_set_solution().
 *  @param      t       [s] time
 *  @param[out] q       (nq) positions
 *  @param[out] v       (nv) velocities
 *  @param[out] lambda  (nc) multipliers; they are NaN before the call. Leave them NaN if they are
 *                      not known
 *  @param      user    as given to baum_study_set_solution()
 *  @return  0 on success */
typedef int baum_study_solution_fn(double t, double *q, double *v, double *lambda, void *user);

/** Give a reference as a function. The study calls the function at the times of the samples. Call
 *  baum_study_set_solution() before the first baum_study_run().
 *  @param study     unchanged on failure
 *  @param solution  the function; only the thread that calls baum_study_run() calls it
 *  @param user      passed to the function. Not owned. May be NULL.
 *  @param digits    [-] > 0, number of digits of the reference that can be trusted
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STATE */
BAUM_API baum_status baum_study_set_solution(baum_study *study, baum_study_solution_fn *solution,
                                             void *user, double digits);

/* ---- running --------------------------------------------------------------------------------- */

/** Run a study: compute the reference, and then run the entries that are not done. The study first
 *  determines the errors of all entries, beginning with coarse settings; the option `threads` says
 *  how many entries run at a time. Then it measures the CPU times of all entries, one by one.
 *  Finally, if the option `validate` is set, it runs the best entries again, over twice the span
 *  and from perturbed starts. Entries that fail, are refused or reach the entry limit stay in the
 *  study. If a setting reaches the entry limit, the finer settings of its method are skipped. If a
 *  study has been stopped, or if you have added entries, another call runs the entries that are not
 *  done.
 *
 *  If the option `file` is set, the study appends every result to this file as a line of text as
 *  soon as the result is known. When this function returns, all results are on the disk. Another
 *  study can continue with this file if both studies have the same mechanism, the same initial
 *  positions, velocities and inputs, the same time span, samples, reference and definition of the
 *  error, and the same option energy_account, and if both run with the same version of the library.
 *  The other study then reads the results of its entries from the file; a last line that is cut off
 *  does no harm. The library does not check whether the user functions are the same. Only one
 *  process at a time may use the file.
 *  @param study  with at least one entry
 *  @return  BAUM_OK, BAUM_WARNED (the reference is not trusted), BAUM_STOP_CANCELLED (also if the
 *           time budget is spent), BAUM_ERR_STATE (no entries, or already running),
 *           BAUM_ERR_MEMORY, BAUM_ERR_FILE, BAUM_ERR_BUFFER (the file belongs to another study; the
 *           message says what differs), BAUM_ERR_CALLBACK (the function of
 *           baum_study_set_solution()); if no run can be started, the status of
 *           baum_simulation_create() */
BAUM_API baum_status baum_study_run(baum_study *study);

/** Ask baum_study_run() to stop. baum_study_run() then discards the results of entries that are
 *  not finished. If baum_study_add_standard() or baum_study_add_stress() is running, it also stops
 *  and adds no entries. This function may be called from any thread and from signal handlers.
 *  @param study  may be NULL */
BAUM_API void baum_study_cancel(baum_study *study);

/* ---- entries --------------------------------------------------------------------------------- */

/** State of an entry. */
typedef enum baum_study_state {
  BAUM_STUDY_WAITING = 0, /**< The entry has not run yet, or its run was interrupted. */
  BAUM_STUDY_DONE = 1,    /**< The run reached the end of the span. */
  BAUM_STUDY_REFUSED = 2, /**< The run could not be started. */
  BAUM_STUDY_FAILED = 3,  /**< The run failed before the end of the span. */
  /** The run reached the limit of CPU time (option entry_limit), or the entry was skipped because a
   *  coarser setting of its method reached this limit. */
  BAUM_STUDY_TIMED_OUT = 4
} baum_study_state;

/** Name of a state. @param state  any value @return such as "done"; NULL for unknown values */
BAUM_API const char *baum_study_state_name(baum_study_state state);

/** The list of the results of an entry. Each line is X(type, name, known, unit, meaning). The study
 *  file, the reports in CSV and JSON, the class StudyEntry of the Python package, and the last
 *  fields of baum_study_entry are generated from this list. Results marked DONE are known only if
 *  the entry is done.
 *
 *  Each error against the reference is the largest value over all samples, with two exceptions:
 *  fields with `final` in their names contain the error at the last sample, and error_half covers
 *  only the first half of the samples. An error is never smaller than the uncertainty of the
 *  reference. The scale of a length is the characteristic length, and the scale of an angle is 1
 *  rad. Scaled positions and velocities are divided by the scales of their coordinates. The
 *  weighted multiplier of row i is the multiplier times the norm of row i of the Jacobian J; for
 *  this norm, each column of J is first multiplied by the scale of its coordinate. */
#define BAUM_STUDY_ENTRY_LIST(X)                                                                   \
  X(baum_study_state, state, ALWAYS, "", "done, refused, failed, timed_out or waiting")            \
  X(baum_status, status, ALWAYS, "", "status of the run of the entry")                             \
  X(bool, at_floor, ALWAYS, "", "measured error is not above the uncertainty of the reference")    \
  X(bool, untrusted, ALWAYS, "", "the reference is not trusted, so neither are the errors")        \
  X(bool, off, ALWAYS, "", "run followed another motion: error_q above 0.1, or a branch warning")  \
  X(bool, unstable, ALWAYS, "", "the gains do not damp violations at this step")                   \
  X(double, alpha, ALWAYS, "1/s", "alpha in use; 0: no gains")                                     \
  X(double, beta, ALWAYS, "1/s", "beta in use; 0: no gains")                                       \
  X(double, error, DONE, "1", "largest error over all samples, by the definition of the study")    \
  X(double, error_final, DONE, "1", "error at the last sample")                                    \
  X(double, error_half, DONE, "1", "largest error over the first half of the samples")             \
  X(double, error_q, DONE, "1", "error of scaled positions")                                       \
  X(double, error_q_final, DONE, "1", "error_q at the last sample")                                \
  X(double, error_v, DONE, "1", "error of scaled velocities, relative to the largest one")         \
  X(double, error_v_final, DONE, "1", "error_v at the last sample")                                \
  X(double, error_lambda, DONE, "1", "error of weighted multipliers, relative to the largest one") \
  X(double, error_lambda_final, DONE, "1", "error_lambda at the last sample")                      \
  X(double, energy_error, DONE, "J", "difference of energy from the reference")                    \
  X(double, energy_error_final, DONE, "J", "energy_error at the last sample")                      \
  X(double, error_estimate, DONE, "1", "error_estimate of baum_counters")                          \
  X(double, error_validated, DONE, "1", "largest error of the validation, see option validate")    \
  X(double, max_phi, DONE, "m or rad", "largest constraint violation |Phi| over all steps")        \
  X(double, max_phi_rate, DONE, "m/s or rad/s", "largest |Phi'| over all steps")                   \
  X(double, violation_work, DONE, "J", "work of violated constraints, see baum_energy_account")    \
  X(double, projection_work, DONE, "J", "change of energy by projections")                         \
  X(double, gains_work, DONE, "J", "work of Baumgarte's gains, see baum_energy_account")           \
  X(double, work, DONE, "evaluations", "evaluations + factorizations + implicit iterations")       \
  X(double, cpu, DONE, "s", "least CPU time to create a run and advance it, without samples")      \
  X(double, cpu_spread, DONE, "s", "second smallest CPU time minus the smallest")                  \
  X(int32_t, repeats, DONE, "1", "number of runs that measured the CPU time")                      \
  X(int64_t, evaluations, DONE, "1", "evaluations in the run, without those for samples")          \
  X(int64_t, factorizations, DONE, "1", "factorizations of matrices, without those for samples")   \
  X(int64_t, nonlinear_iterations, DONE, "1", "iterations of implicit methods")                    \
  X(int64_t, steps, DONE, "1", "accepted steps")                                                   \
  X(int64_t, rejected, DONE, "1", "steps that were repeated")                                      \
  X(int64_t, forced_steps, DONE, "1", "steps across singularities, see baum_counters")             \
  X(int64_t, near_singular_intervals, DONE, "1", "number of near-singular intervals of the run")   \
  X(int64_t, warnings, DONE, "1", "number of kinds of warnings of the run")                        \
  X(int64_t, branch_warnings, DONE, "1", "near-singular intervals with a doubtful branch")         \
  X(int64_t, doubts, DONE, "1", "number of kinds of warnings that put the motion in doubt")

/** An entry: a setting, how accurate it is and what it costs. The last fields of the struct are
 *  those of BAUM_STUDY_ENTRY_LIST, which states their units and meanings. A result of type double
 *  that is not known is NaN. Do not use the counts (such as `steps`) of an entry that is not done.
 *  error_validated is infinite if the setting fails in the validation. It is NaN for entries that
 *  are not validated. The study does not validate an entry whose work is much larger than the work
 *  of another entry that is at least as accurate. */
typedef struct baum_study_entry {
  size_t struct_size; /**< Set by baum_study_entry_at(). */
  const char *name;   /**< The name, such as "rk8 projection, rtol 1e-06". */
  /** The reason why the entry was refused or failed. For other entries: the first warning of the
   *  run, or "" if the run has no warning. */
  const char *message;
  const baum_integrator *integrator; /**< The integrator. */
  baum_formulation formulation;      /**< The formulation; never BAUM_FORMULATION_DEFAULT. */
  baum_gains gains;                  /**< The gain rule, as given in the options. */
  double step;                       /**< [s] fixed step; NaN if the entry has rtol. */
  double rtol;                       /**< [-] tolerance; NaN if the entry has a step. */
  /** [-] number of the method of this entry among all methods of the study, counted from 0. */
  int32_t method;
/** Expands a line of the list. */
#define BAUM_X(type, name, known, unit, meaning) type name;
  BAUM_STUDY_ENTRY_LIST(BAUM_X)
#undef BAUM_X
} baum_study_entry;

/** Count the entries. @param study  may be NULL @return 0 for NULL */
BAUM_API int32_t baum_study_entry_count(const baum_study *study);

/** Read an entry.
 *  @param      study        the study
 *  @param      k            number of the entry, 0 to baum_study_entry_count() - 1, in the order in
 *                           which the entries were added
 *  @param[out] out          filled
 *  @param      caller_size  sizeof *out
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT */
BAUM_API baum_status baum_study_entry_at(const baum_study *study, int32_t k, baum_study_entry *out,
                                         size_t caller_size);

/** Read the options of an entry. You can pass them to baum_simulation_create(). The study owns the
 *  array row_gains of the options.
 *  @param      study        the study
 *  @param      k            0 to baum_study_entry_count() - 1
 *  @param[out] out          filled
 *  @param      caller_size  sizeof *out
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT */
BAUM_API baum_status baum_study_entry_options(const baum_study *study, int32_t k,
                                              baum_simulation_options *out, size_t caller_size);

/* ---- reference ------------------------------------------------------------------------------- */

/** The origin of a reference: where it comes from. */
typedef enum baum_study_origin {
  BAUM_STUDY_OWN = 0,     /**< Computed by the study. */
  BAUM_STUDY_GIVEN = 1,   /**< Given by baum_study_set_reference(). */
  BAUM_STUDY_SOLUTION = 2 /**< Given by baum_study_set_solution(). */
} baum_study_origin;

/** The quality of a reference: how far it can be trusted. */
typedef struct baum_study_reference {
  size_t struct_size;       /**< Set by baum_study_reference_read(). */
  baum_study_origin origin; /**< Where the reference comes from. */
  /** False if the study has computed the reference itself, and the runs for the reference agree to
   *  fewer than three digits or pass near a singular configuration. */
  bool trusted;
  /** [-] number of digits that can be trusted, -log10(uncertainty). NaN before the reference is
   *  computed. */
  double digits;
  /** [-] uncertainty of the reference, measured like `error` of an entry. */
  double uncertainty;
  /** [-] uncertainty of the reference, measured like error_q of an entry. */
  double uncertainty_q;
  /** [-] uncertainty of the reference, measured like error_v of an entry. */
  double uncertainty_v;
  /** [-] uncertainty of the reference, measured like error_lambda of an entry. */
  double uncertainty_lambda;
  /** [J] uncertainty of the reference, measured like energy_error of an entry. */
  double uncertainty_energy;
  int32_t samples; /**< [-] number of samples. */
  /** A text that states the number of digits to which the runs for the reference agree, or the
   *  reason why the reference is not trusted. */
  const char *text;
} baum_study_reference;

/** Read how far the reference can be trusted. This is known after baum_study_run().
 *  @param      study        the study
 *  @param[out] out          filled
 *  @param      caller_size  sizeof *out
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT */
BAUM_API baum_status baum_study_reference_read(const baum_study *study, baum_study_reference *out,
                                               size_t caller_size);

/** Read a sample of the reference.
 *  @param      study   the study
 *  @param      k       0 to samples - 1
 *  @param[out] t       [s] time. May be NULL.
 *  @param[out] q       (nq) positions. May be NULL.
 *  @param[out] v       (nv) velocities, NaN if unknown. May be NULL.
 *  @param[out] lambda  (nc) multipliers, NaN if unknown. May be NULL.
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STATE (the reference has not been computed; a
 *           study that finds the results of all entries in its file does not compute it) */
BAUM_API baum_status baum_study_reference_sample(const baum_study *study, int32_t k, double *t,
                                                 double *q, double *v, double *lambda);

/** Read the time span and the options of a study.
 *  @param      study        the study
 *  @param[out] t0           [s] start of the time span. May be NULL.
 *  @param[out] t1           [s] end of the time span. May be NULL.
 *  @param[out] options      options of the study. May be NULL.
 *  @param      caller_size  sizeof *options
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT */
BAUM_API baum_status baum_study_settings(const baum_study *study, double *t0, double *t1,
                                         baum_study_options *options, size_t caller_size);

/** State in words how the error is defined.
 *  @param study  may be NULL
 *  @return  such as "largest error of all positions over all samples, lengths divided by 0.51 m,
 *           angles in rad"; NULL if the argument is NULL */
BAUM_API const char *baum_study_error_text(const baum_study *study);

/* ---- answers --------------------------------------------------------------------------------- */

/** A measure of cost. */
typedef enum baum_study_cost {
  /** [-] number of evaluations of the equations of motion, plus number of factorizations, plus
   *  number of iterations of implicit methods. This cost is the same on every machine. */
  BAUM_STUDY_WORK = 0,
  BAUM_STUDY_CPU = 1 /**< [s] measured CPU time. */
} baum_study_cost;

/** A method: the entries with the same integrator, formulation and gains. These entries differ only
 *  in step or in rtol. */
typedef struct baum_study_method {
  size_t struct_size; /**< Set by baum_study_method_at(). */
  /** The name, such as "rk8 projection". If an integrator can use fixed and variable steps, two
   *  methods have the same name; the field fixed_step distinguishes them. */
  const char *name;
  const baum_integrator *integrator; /**< Integrator of the method. */
  baum_formulation formulation;      /**< Formulation of the method. */
  baum_gains gains;                  /**< Gain rule of the method. */
  bool fixed_step;                   /**< True if the entries differ in step, false if in rtol. */
  int32_t entries;                   /**< [-] number of entries. */
  /** [-] number of entries that are done, whose CPU time is measured, whose error is finite and not
   *  0, and whose field `off` is false. If `off` is true, the run has followed another motion than
   *  the reference: error_q is above 0.1, or the run has a branch warning. */
  int32_t usable;
  double least_error; /**< [-] smallest error of the usable entries; NaN if there are none. */
  /** [-] slope of the error curve: d log error / d log step, or d log error / d log rtol if entries
   *  differ in rtol. NaN: unknown. */
  double slope;
  /** [-] factor by which the work grows for one more correct digit; NaN: unknown. */
  double work_per_digit;
  /** [-] factor by which the CPU time grows for one more correct digit; NaN: unknown. */
  double cpu_per_digit;
  /** [-] geometric mean of error_validated / error over the usable entries whose error_validated is
   *  finite; NaN if there are none. */
  double growth;
} baum_study_method;

/** Count the methods. @param study  may be NULL @return 0 for NULL */
BAUM_API int32_t baum_study_method_count(const baum_study *study);

/** Read a method.
 *  @param      study        the study
 *  @param      k            0 to baum_study_method_count() - 1
 *  @param[out] out          filled
 *  @param      caller_size  sizeof *out
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT */
BAUM_API baum_status baum_study_method_at(const baum_study *study, int32_t k,
                                          baum_study_method *out, size_t caller_size);

/** Find the Pareto front: the entries for which no other entry is both cheaper and more accurate.
 *  Entries whose error is at or below the uncertainty of the reference count as equally accurate.
 *  @param      study     the study
 *  @param      cost      how cost is measured
 *  @param      capacity  [-] size of `entries`; >= 0
 *  @param[out] entries   (capacity) numbers of the entries on the front, from the cheapest to the
 *                        most accurate; if the front has more than `capacity` entries, only the
 *                        cheapest ones. May be NULL if capacity is 0.
 *  @param[out] count     [-] number of entries on the front, which may exceed the capacity
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT */
BAUM_API baum_status baum_study_front(const baum_study *study, baum_study_cost cost,
                                      int32_t capacity, int32_t *entries, int32_t *count);

/** Compute what a method costs for a given error. The cost is interpolated between the
 *  usable entries of the method (see baum_study_method), linearly in the logarithms of error and
 *  cost. If the error is larger than that of the coarsest entry, the cost is extrapolated by at
 *  most the distance between the two coarsest entries. If the error is smaller than that of the
 *  finest entry, the cost is extrapolated by at most the distance between the two finest entries.
 *  @param      study   the study
 *  @param      method  number of the method, 0 to baum_study_method_count() - 1
 *  @param      error   [-] > 0
 *  @param      cost    how cost is measured
 *  @param[out] out     [- or s] the cost
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT (also if the method was not measured near that error; the
 *           message states the smallest and the largest error with which it was measured) */
BAUM_API baum_status baum_study_cost_at(const baum_study *study, int32_t method, double error,
                                        baum_study_cost cost, double *out);

/** Compare the cost of two methods at equal error.
 *  @param      study  the study
 *  @param      a      number of a method, 0 to baum_study_method_count() - 1
 *  @param      b      number of the other method, 0 to baum_study_method_count() - 1
 *  @param      error  [-] > 0
 *  @param      cost   how cost is measured
 *  @param[out] ratio  [-] cost of method a / cost of method b; below 1 if a is cheaper
 *  @return  as baum_study_cost_at() */
BAUM_API baum_status baum_study_compare(const baum_study *study, int32_t a, int32_t b, double error,
                                        baum_study_cost cost, double *ratio);

/** Recommend a setting: find the cheapest setting whose error is small enough. Its step or rtol may
 *  lie between those of two entries. The function uses a safety margin and the errors of the
 *  validation (error_validated), so that the setting is also accurate enough for similar starts and
 *  for twice the span. If no entry is accurate enough with this margin, the result is a setting
 *  whose measured error is small enough without the margin, and `why` says so.
 *  @param      study        after baum_study_run(); unchanged
 *  @param      error        [-] > 0, largest error that you accept; see baum_study_set_error()
 *  @param      cost         how cost is measured
 *  @param[out] best         options for baum_simulation_create(); unchanged on failure
 *  @param      caller_size  sizeof *best
 *  @param[out] why          (size) a message with the measured figures, truncated if too long. May
 *                           be NULL.
 *  @param      size         [byte] size of `why`
 *  @return  BAUM_OK, BAUM_WARNED (the reference is not trusted), BAUM_ERR_ARGUMENT (also if no
 *           entry is accurate enough, or if the uncertainty of the reference is larger than
 *           `error`), BAUM_ERR_STATE (no entry has a measured time) */
BAUM_API baum_status baum_study_recommend(const baum_study *study, double error,
                                          baum_study_cost cost, baum_simulation_options *best,
                                          size_t caller_size, char *why, size_t size);

/** Recommend a setting: find the most accurate setting that takes at most a given CPU time.
 *  Otherwise this function is like baum_study_recommend().
 *  @param      study        after baum_study_run(); unchanged
 *  @param      seconds      [s] > 0, finite, largest CPU time that you accept for a run over the
 *                           span of the study on this machine
 *  @param[out] best         options for baum_simulation_create(); unchanged on failure
 *  @param      caller_size  sizeof *best
 *  @param[out] why          (size) a message with the measured figures, truncated if too long. May
 *                           be NULL.
 *  @param      size         [byte] size of `why`
 *  @return  as baum_study_recommend(); BAUM_ERR_ARGUMENT also if no entry is fast enough */
BAUM_API baum_status baum_study_recommend_budget(const baum_study *study, double seconds,
                                                 baum_simulation_options *best, size_t caller_size,
                                                 char *why, size_t size);

#ifdef __cplusplus
}
#endif

#endif
