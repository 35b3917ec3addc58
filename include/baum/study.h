/* SPDX-License-Identifier: BSD-3-Clause */
/** @file
 *  Studies: accuracy against cost, measured. A study runs one mechanism over one time span with
 *  many settings. It measures the error and the cost of each and recommends a setting.
 *
 *    baum_study_create(mechanism, 0.0, 2.0, &study);
 *    baum_study_add_standard(study, NULL);
 *    baum_study_run(study);
 *    baum_study_recommend(study, 1e-6, BAUM_STUDY_WORK, &options, sizeof options, why, sizeof why);
 *
 *  An *entry* is one setting. A *method* is the set of entries with the same integrator,
 *  formulation and gains, which differ in step or rtol. Errors are differences from a *reference*
 *  at the samples t0 + k (t1 - t0) / n, k = 1 to n. The study computes its own reference or uses
 *  one that you give. No error is reported below the uncertainty of the reference.
 *  docs/theory/work-precision.md explains the details.
 *
 *  Threads: one study is used by one thread at a time, except baum_study_cancel(). baum_study_run()
 *  uses as many threads as the options say and calls user functions, including those of the
 *  mechanism, from each of them. The progress function may cancel the study and, with one thread,
 *  read it. Functions that change the study fail inside the progress function with BAUM_ERR_STATE,
 *  and destroying the study does nothing.
 *
 *  Texts are owned by the study. They are valid until the next call that changes it.
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

/** Many runs of one mechanism. */
typedef struct baum_study baum_study;

/* ---- making one ------------------------------------------------------------------------------ */

/** Create a study without entries.
 *  @param      mechanism  frozen; the study keeps it alive
 *  @param      t0         [s] finite, start of all runs
 *  @param      t1         [s] finite, end of all runs, not t0; before t0 for runs backward in time
 *  @param[out] out        receives the study, NULL on failure; release it with baum_study_destroy()
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STATE (not frozen), BAUM_ERR_MEMORY */
BAUM_API baum_status baum_study_create(const baum_mechanism *mechanism, double t0, double t1,
                                       baum_study **out);

/** Release a study. @param study  may be NULL */
BAUM_API void baum_study_destroy(baum_study *study);

/** Called after each entry and during the reference, by one thread at a time, which may differ from
 *  the calling thread.
 *  @param study  the study
 *  @param done   number of entries whose error is known plus number of those whose time is known
 *  @param total  2 x number of entries
 *  @param user   the option `user`
 *  @return  non-zero to cancel */
typedef int baum_study_progress_fn(const baum_study *study, int32_t done, int32_t total,
                                   void *user);

/** How to study. */
typedef struct baum_study_options {
  size_t struct_size; /**< Set by the default. Do not write. */
  /** [-] 2 to 1e6, at most 1e8 / (nq + nv + nc); number of samples of the error. Default: 100. */
  int32_t samples;
  /** [-] 1 to 1024, threads that compute errors; times are measured one by one. Default: 1. */
  int32_t threads;
  /** [-] 1 to 1e6, largest number of runs that measure the time of an entry; long runs are repeated
   *  less often. Default: 5. */
  int32_t repeats;
  /** [s] > 0, largest CPU time of a run; may be infinite. A run of the reference may take five
   *  times this limit. Default: 10. */
  double entry_limit;
  /** [s] > 0, largest wall time of one baum_study_run(); may be infinite. Default: infinity. */
  double time_budget;
  /** Measure the work of the stabilization. This takes the additional evaluations that
   *  baum_energy_account states. Default: true. */
  bool energy_account;
  /** Path of the study file, see baum_study_run(). Copied. Default: NULL, none. */
  const char *file;
  baum_study_progress_fn *progress; /**< Default: NULL, none. */
  void *user;                       /**< Passed to progress. Not owned. Default: NULL. */
  /** Before an entry is recommended, run it over twice the span and from perturbed starts, too, so
   *  that the recommendation holds there. Default: true. */
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

/** Set the options. After the first run, samples, energy_account and file must stay the same.
 *  @param     study    unchanged on failure
 *  @param[in] options  copied
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STRUCT, BAUM_ERR_STATE, BAUM_ERR_MEMORY */
BAUM_API baum_status baum_study_set_options(baum_study *study, const baum_study_options *options);

/* ---- settings -------------------------------------------------------------------------------- */

/** Add one setting. A setting is only checked when it runs; if it cannot run, its entry is marked
 *  as refused.
 *  @param     study    unchanged on failure
 *  @param[in] options  copied; start_time, progress and user are ignored
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT (NULL, or no integrator), BAUM_ERR_STRUCT, BAUM_ERR_STATE,
 *           BAUM_ERR_MEMORY */
BAUM_API baum_status baum_study_add(baum_study *study, const baum_simulation_options *options);

/** Contents of the standard grid. */
typedef struct baum_study_grid {
  size_t struct_size;                /**< Set by the default. Do not write. */
  const baum_integrator *integrator; /**< Only this one. Default: NULL, all in this build. */
  baum_formulation formulation;      /**< Only this one. Default: BAUM_FORMULATION_DEFAULT, all. */
  int32_t settings; /**< [-] 1 to 64, steps or tolerances of each method. Default: 8. */
  /** [-] 0 to 4, number of constant gains alpha = beta in addition to the integrator's default rule
   *  and auto: 1, 10, 100, 1000 times the angular velocity of the motion. Default: 2. */
  int32_t constants;
  /** [s] > 0, longest step of methods of order 2 and above. Default: NaN, from the time scale of
   *  the motion. */
  double coarsest;
  /** [-] > 0, < 1e-2, smallest rtol; the largest is 1e-2. Default: NaN: 1e-13, or 1e-11 if a user
   *  constraint has neither jacobian nor gamma, because finite differences are not more accurate
   *  than this. */
  double finest;
  /** A first answer for about a 25th of the cost: every integrator with its default formulation (or
   *  the one above) and its default gains, at most 5 settings; `constants` is ignored.
   *  Default: false. */
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

/** Add the standard grid: every integrator of the build with each of its formulations, its default
 *  gains, auto gains and some constant gains, each with steps or tolerances from coarse to fine.
 *  The steps follow from the time scale of the motion, which a trial run determines.
 *  @param     study  unchanged on failure
 *  @param[in] grid   NULL: the default
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT (also if the build has no such integrator with that
 *           formulation), BAUM_ERR_STRUCT, BAUM_ERR_STATE, BAUM_ERR_MEMORY, BAUM_STOP_CANCELLED; if
 *           the mechanism cannot be started, the status of baum_simulation_create() */
BAUM_API baum_status baum_study_add_standard(baum_study *study, const baum_study_grid *grid);

/** Add stress settings: steps of 1e-1 to 1e-9 of a period of the motion, and rtol of 1e-2 to 1e-14.
 *  BAUMGARTE also gets gains alpha = beta of 0 and of 1e-6 to 1e12 1/s, at a step of 1e-3 of a
 *  period or at rtol 1e-7. Every entry should either be as accurate as its setting suggests or have
 *  a message or warning that explains why not. The entry limit bounds the CPU time of entries with
 *  tiny steps.
 *  @param study       unchanged on failure
 *  @param integrator  NULL: all in this build that take a step or a tolerance
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT (also if the build lacks that integrator), BAUM_ERR_STATE,
 *           BAUM_ERR_MEMORY, BAUM_STOP_CANCELLED; if the mechanism cannot be started, the status of
 *           baum_simulation_create() */
BAUM_API baum_status baum_study_add_stress(baum_study *study, const baum_integrator *integrator);

/* ---- what error means ------------------------------------------------------------------------ */

/** Define the error: the largest |difference from the reference| / unit over all columns of some
 *  channels. Without this call it is the largest error of all positions, with lengths relative to
 *  the characteristic length and angles in radians. Call it before the first run.
 *  @param     study     unchanged on failure
 *  @param[in] channels  (count) copied
 *  @param     count     [-] >= 1
 *  @param     unit      [of the channels] > 0, finite; a difference of this size is an error of 1
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STRUCT (of a channel), BAUM_ERR_STATE,
 *           BAUM_ERR_MEMORY */
BAUM_API baum_status baum_study_set_error(baum_study *study, const baum_channel *channels,
                                          int32_t count, double unit);

/** Give a reference as samples. The option samples is then ignored. NaN entries are not compared.
 *  Call it before the first run. Revolutions of angles in space are counted from sample to sample;
 *  where samples are too far apart for that, energies and the channels of baum_study_set_error()
 *  are not compared.
 *  @param     study   unchanged on failure
 *  @param[in] times   (n) [s] strictly monotone, from t0 (excluded) to t1
 *  @param     n       [-] >= 1
 *  @param[in] q       (n x nq) copied
 *  @param[in] v       (n x nv) copied. NULL: unknown.
 *  @param[in] lambda  (n x nc) copied. NULL: unknown.
 *  @param     digits  [-] > 0, trusted digits: errors below 10^-digits are not distinguished
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STATE, BAUM_ERR_MEMORY */
BAUM_API baum_status baum_study_set_reference(baum_study *study, const double *times, int32_t n,
                                              const double *q, const double *v,
                                              const double *lambda, double digits);

/** A solution given by formulas.
 *  @param      t       [s]
 *  @param[out] q       (nq)
 *  @param[out] v       (nv)
 *  @param[out] lambda  (nc) NaN at the call; leave it if unknown
 *  @param      user    as given to baum_study_set_solution()
 *  @return  0 on success */
typedef int baum_study_solution_fn(double t, double *q, double *v, double *lambda, void *user);

/** Give a reference as a function. Otherwise like baum_study_set_reference().
 *  @param study     unchanged on failure
 *  @param solution  called from the thread of baum_study_run()
 *  @param user      passed to it. Not owned. May be NULL.
 *  @param digits    [-] > 0, trusted digits
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STATE */
BAUM_API baum_status baum_study_set_solution(baum_study *study, baum_study_solution_fn *solution,
                                             void *user, double digits);

/* ---- running --------------------------------------------------------------------------------- */

/** Compute the reference and run the entries that are not done. First come all errors, by several
 *  threads, coarse settings first; then all times, one by one. Entries that fail, are refused or
 *  reach the limit stay in the study. If a setting reaches the entry limit, finer settings of its
 *  method are skipped. Another call continues after a stop and runs entries added since.
 *
 *  With the option file, every result is appended to the file as a line of text as soon as it is
 *  known, and all results are on the disk when this function returns. A study of the same
 *  mechanism, span, samples, error and reference reads its entries from the file, even if a line is
 *  cut off. User functions are not compared. Only one process may use the file at a time.
 *  @param study  with at least one entry
 *  @return  BAUM_OK, BAUM_WARNED (the reference is not trusted), BAUM_STOP_CANCELLED (also if the
 *           time budget is spent), BAUM_ERR_STATE (no entries, or already running),
 *           BAUM_ERR_MEMORY, BAUM_ERR_FILE, BAUM_ERR_BUFFER (the file belongs to another study; the
 *           message says what differs), BAUM_ERR_CALLBACK (the solution); if no run can be started,
 *           the status of baum_simulation_create() */
BAUM_API baum_status baum_study_run(baum_study *study);

/** Ask baum_study_run() to stop; it discards entries that are not finished. A call that is adding
 *  entries then adds none. May be called from any thread or signal handler.
 *  @param study  may be NULL */
BAUM_API void baum_study_cancel(baum_study *study);

/* ---- entries --------------------------------------------------------------------------------- */

/** State of an entry. */
typedef enum baum_study_state {
  BAUM_STUDY_WAITING = 0, /**< Not run yet, or interrupted. */
  BAUM_STUDY_DONE = 1,    /**< Reached the end of the span. */
  BAUM_STUDY_REFUSED = 2, /**< Could not be started. */
  BAUM_STUDY_FAILED = 3,  /**< Failed during the run. */
  /** Reached the entry limit, or a coarser setting of its method did. */
  BAUM_STUDY_TIMED_OUT = 4
} baum_study_state;

/** Name of a state. @param state  any value @return such as "done"; NULL for unknown values */
BAUM_API const char *baum_study_state_name(baum_study_state state);

/** The results of an entry: X(type, name, known, unit, meaning). The struct below, the study file,
 *  CSV, JSON and Python are generated from this list. Results marked DONE are known for entries
 *  that are done. Errors are the largest over all samples; names with `final` mean the error at the
 *  last sample. Errors are never below the uncertainty of the reference. */
#define BAUM_STUDY_ENTRY_LIST(X)                                                                   \
  X(baum_study_state, state, ALWAYS, "", "done, refused, failed, timed_out or waiting")            \
  X(baum_status, status, ALWAYS, "", "status of its run")                                          \
  X(bool, at_floor, ALWAYS, "", "error is at the uncertainty of the reference")                    \
  X(bool, untrusted, ALWAYS, "", "the reference is not trusted, so neither are the errors")        \
  X(bool, off, ALWAYS, "", "another motion: error_q above 0.1, or a branch warning")               \
  X(bool, unstable, ALWAYS, "", "its gains do not damp with this step")                            \
  X(double, alpha, ALWAYS, "1/s", "alpha in use; 0: no gains")                                     \
  X(double, beta, ALWAYS, "1/s", "beta in use; 0: no gains")                                       \
  X(double, error, DONE, "1", "the error, see baum_study_set_error()")                             \
  X(double, error_final, DONE, "1", "error at the last sample")                                    \
  X(double, error_half, DONE, "1", "error over the first half of the samples")                     \
  X(double, error_q, DONE, "1", "error of positions, relative to the scales")                      \
  X(double, error_q_final, DONE, "1", "error of positions at the last sample")                     \
  X(double, error_v, DONE, "1", "error of velocities, relative to scales and largest velocity")    \
  X(double, error_v_final, DONE, "1", "error of velocities at the last sample")                    \
  X(double, error_lambda, DONE, "1", "error of multipliers, times the displacement of their rows") \
  X(double, error_lambda_final, DONE, "1", "error of multipliers at the last sample")              \
  X(double, energy_error, DONE, "J", "drift of energy against the reference")                      \
  X(double, energy_error_final, DONE, "J", "drift of energy at the last sample")                   \
  X(double, error_estimate, DONE, "1", "error_estimate of baum_counters")                          \
  X(double, error_validated, DONE, "1", "error over twice the span and from perturbed starts")     \
  X(double, max_phi, DONE, "m or rad", "largest constraint violation |Phi| over all steps")        \
  X(double, max_phi_rate, DONE, "m/s or rad/s", "largest |Phi'| over all steps")                   \
  X(double, violation_work, DONE, "J", "work of violated constraints, see baum_energy_account")    \
  X(double, projection_work, DONE, "J", "change of energy by projections")                         \
  X(double, gains_work, DONE, "J", "work of the gains, see baum_energy_account")                   \
  X(double, work, DONE, "evaluations", "see BAUM_STUDY_WORK; the same on every machine")           \
  X(double, cpu, DONE, "s", "least CPU time of a run with its creation, without samples")          \
  X(double, cpu_spread, DONE, "s", "second least CPU time minus the least")                        \
  X(int32_t, repeats, DONE, "1", "runs for the CPU time")                                          \
  X(int64_t, evaluations, DONE, "1", "right-hand sides or residuals, without samples")             \
  X(int64_t, factorizations, DONE, "1", "factorizations of matrices, without samples")             \
  X(int64_t, nonlinear_iterations, DONE, "1", "iterations of implicit methods")                    \
  X(int64_t, steps, DONE, "1", "accepted steps")                                                   \
  X(int64_t, rejected, DONE, "1", "steps that were repeated")                                      \
  X(int64_t, forced_steps, DONE, "1", "steps over singular configurations")                        \
  X(int64_t, near_singular_intervals, DONE, "1", "near-singular intervals of its run")             \
  X(int64_t, warnings, DONE, "1", "kinds of warnings of its run")                                  \
  X(int64_t, branch_warnings, DONE, "1", "intervals after which the branch is in doubt")           \
  X(int64_t, doubts, DONE, "1", "kinds of warnings that doubt the motion")

/** What a setting costs and how accurate it is. Its last fields are those of BAUM_STUDY_ENTRY_LIST.
 *  NaN: unknown. error_validated is infinite if the setting fails in the validation, and NaN for
 *  entries that are not validated because they cost far more than others of the same accuracy. */
typedef struct baum_study_entry {
  size_t struct_size;  /**< Set by baum_study_entry_at(). */
  const char *name;    /**< Such as "rk8 projection, rtol 1e-06". */
  const char *message; /**< Why it is refused or failed, or its first warning, or "". */
  const baum_integrator *integrator; /**< Of the options. */
  baum_formulation formulation;      /**< The actual one, never DEFAULT. */
  baum_gains gains;                  /**< Of the options. */
  double step;                       /**< [s] NaN for entries with rtol. */
  double rtol;                       /**< [-] NaN for entries with a step. */
  int32_t method;                    /**< [-] see baum_study_method_at(). */
/** Expands a line of the list. */
#define BAUM_X(type, name, known, unit, meaning) type name;
  BAUM_STUDY_ENTRY_LIST(BAUM_X)
#undef BAUM_X
} baum_study_entry;

/** Count the entries. @param study  may be NULL @return 0 for NULL */
BAUM_API int32_t baum_study_entry_count(const baum_study *study);

/** Read an entry.
 *  @param      study        the study
 *  @param      k            0 to baum_study_entry_count() - 1, in the order of adding
 *  @param[out] out          filled
 *  @param      caller_size  sizeof *out
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT */
BAUM_API baum_status baum_study_entry_at(const baum_study *study, int32_t k, baum_study_entry *out,
                                         size_t caller_size);

/** Read the options of an entry, ready for baum_simulation_create(). The study owns row_gains.
 *  @param      study        the study
 *  @param      k            0 to baum_study_entry_count() - 1
 *  @param[out] out          filled
 *  @param      caller_size  sizeof *out
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT */
BAUM_API baum_status baum_study_entry_options(const baum_study *study, int32_t k,
                                              baum_simulation_options *out, size_t caller_size);

/* ---- reference ------------------------------------------------------------------------------- */

/** Where the reference comes from. */
typedef enum baum_study_origin {
  BAUM_STUDY_OWN = 0,     /**< Computed by the study. */
  BAUM_STUDY_GIVEN = 1,   /**< baum_study_set_reference(). */
  BAUM_STUDY_SOLUTION = 2 /**< baum_study_set_solution(). */
} baum_study_origin;

/** How far the reference can be trusted. */
typedef struct baum_study_reference {
  size_t struct_size;       /**< Set by baum_study_reference_read(). */
  baum_study_origin origin; /**< Where it comes from. */
  /** False if the study's own reference runs agree to fewer than three digits or met a singular
   *  configuration. */
  bool trusted;
  double digits;        /**< [-] trusted digits, -log10(uncertainty); NaN before it is computed. */
  double uncertainty;   /**< [-] of error. */
  double uncertainty_q; /**< [-] of error_q. */
  double uncertainty_v; /**< [-] of error_v. */
  double uncertainty_lambda; /**< [-] of error_lambda. */
  double uncertainty_energy; /**< [J] of energy_error. */
  int32_t samples;           /**< [-] number of samples. */
  /** Which runs agree to how many digits, or why the reference is not trusted. */
  const char *text;
} baum_study_reference;

/** Read how far the reference can be trusted; known after baum_study_run().
 *  @param      study        the study
 *  @param[out] out          filled
 *  @param      caller_size  sizeof *out
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT */
BAUM_API baum_status baum_study_reference_read(const baum_study *study, baum_study_reference *out,
                                               size_t caller_size);

/** Read a sample of the reference.
 *  @param      study   the study
 *  @param      k       0 to samples - 1
 *  @param[out] t       [s] May be NULL.
 *  @param[out] q       (nq) May be NULL.
 *  @param[out] v       (nv) NaN if unknown. May be NULL.
 *  @param[out] lambda  (nc) NaN if unknown. May be NULL.
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STATE (not computed; a study that finds all
 *           entries in its file does not compute the reference again) */
BAUM_API baum_status baum_study_reference_sample(const baum_study *study, int32_t k, double *t,
                                                 double *q, double *v, double *lambda);

/** Read what the study was given.
 *  @param      study        the study
 *  @param[out] t0,t1        [s] Each may be NULL.
 *  @param[out] options      as set. May be NULL.
 *  @param      caller_size  sizeof *options
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT */
BAUM_API baum_status baum_study_settings(const baum_study *study, double *t0, double *t1,
                                         baum_study_options *options, size_t caller_size);

/** State in words how the error is defined.
 *  @param study  may be NULL
 *  @return  such as "largest error of all positions, lengths by 0.51 m, angles in rad"; NULL for
 *           NULL */
BAUM_API const char *baum_study_error_text(const baum_study *study);

/* ---- answers --------------------------------------------------------------------------------- */

/** How cost is measured. */
typedef enum baum_study_cost {
  /** [-] evaluations plus factorizations and iterations of implicit methods, each counted as one;
   *  the same on every machine. */
  BAUM_STUDY_WORK = 0,
  BAUM_STUDY_CPU = 1 /**< [s] measured CPU time. */
} baum_study_cost;

/** Entries with the same integrator, formulation and gains, which differ in step or in rtol. */
typedef struct baum_study_method {
  size_t struct_size;                /**< Set by baum_study_method_at(). */
  const char *name;                  /**< Such as "rk8 projection". */
  const baum_integrator *integrator; /**< Of its entries. */
  baum_formulation formulation;      /**< Of its entries. */
  baum_gains gains;                  /**< Of its entries. */
  bool fixed_step;                   /**< True if entries differ in step, false if in rtol. */
  int32_t entries;                   /**< [-] number of entries. */
  int32_t usable;                    /**< [-] entries that are done and not `off`. */
  double least_error; /**< [-] the smallest error of its entries; NaN if none is usable. */
  double slope;       /**< [-] d log error / d log step, or rtol in place of step; NaN: unknown. */
  double work_per_digit; /**< [-] factor on work for one more digit; NaN: unknown. */
  double cpu_per_digit;  /**< [-] factor on CPU time for one more digit; NaN: unknown. */
  /** [-] geometric mean of error_validated / error over its entries; NaN if none was validated to
   *  the end. */
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
 *  Entries whose error is at the uncertainty of the reference count as equally accurate.
 *  @param      study     the study
 *  @param      cost      how cost is measured
 *  @param      capacity  [-] of `entries`; >= 0
 *  @param[out] entries   (capacity) the first ones, from cheap to accurate. NULL if capacity is 0.
 *  @param[out] count     [-] number of entries on the front, which may exceed the capacity
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT */
BAUM_API baum_status baum_study_front(const baum_study *study, baum_study_cost cost,
                                      int32_t capacity, int32_t *entries, int32_t *count);

/** Interpolate the cost of a method at an error, linearly in the logarithms of error and cost.
 *  Beyond the first and last entry it extrapolates by at most the distance of two entries.
 *  @param      study   the study
 *  @param      method  0 to baum_study_method_count() - 1
 *  @param      error   [-] > 0
 *  @param      cost    how cost is measured
 *  @param[out] out     [- or s]
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT (also if the method does not reach that error; the message
 *           states its smallest error) */
BAUM_API baum_status baum_study_cost_at(const baum_study *study, int32_t method, double error,
                                        baum_study_cost cost, double *out);

/** Compare the cost of two methods at equal error.
 *  @param      study  the study
 *  @param      a,b    0 to baum_study_method_count() - 1
 *  @param      error  [-] > 0
 *  @param      cost   how cost is measured
 *  @param[out] ratio  [-] cost of a over cost of b; below 1 if a is cheaper
 *  @return  as baum_study_cost_at() */
BAUM_API baum_status baum_study_compare(const baum_study *study, int32_t a, int32_t b, double error,
                                        baum_study_cost cost, double *ratio);

/** Find the cheapest setting for an error. Its step or rtol may lie between those of entries. The
 *  choice includes a margin and the errors of the validation (error_validated), so that it holds
 *  for similar starts and for twice the span. If no entry reaches the error with that margin, the
 *  result is a setting whose measured error is small enough, and `why` says that no margin is left.
 *  @param      study        after baum_study_run(); unchanged
 *  @param      error        [-] > 0, wanted; see baum_study_set_error()
 *  @param      cost         how cost is measured
 *  @param[out] best         options for baum_simulation_create(); unchanged on failure
 *  @param      caller_size  sizeof *best
 *  @param[out] why          (size) a message with the measured figures, cut if too long. May be
 *                           NULL.
 *  @param      size         [byte] of why
 *  @return  BAUM_OK, BAUM_WARNED (the reference is not trusted), BAUM_ERR_ARGUMENT (also if no
 *           entry is accurate enough, or if the uncertainty of the reference is larger),
 *           BAUM_ERR_STATE (no entry is timed) */
BAUM_API baum_status baum_study_recommend(const baum_study *study, double error,
                                          baum_study_cost cost, baum_simulation_options *best,
                                          size_t caller_size, char *why, size_t size);

/** Find the most accurate setting for a CPU time. Otherwise like baum_study_recommend().
 *  @param      study        after baum_study_run(); unchanged
 *  @param      seconds      [s] > 0, finite, for a run over the span of the study on this machine
 *  @param[out] best         options for baum_simulation_create(); unchanged on failure
 *  @param      caller_size  sizeof *best
 *  @param[out] why          (size) a message with the measured figures, cut if too long. May be
 *                           NULL.
 *  @param      size         [byte] of why
 *  @return  as baum_study_recommend(); BAUM_ERR_ARGUMENT also if no entry is fast enough */
BAUM_API baum_status baum_study_recommend_budget(const baum_study *study, double seconds,
                                                 baum_simulation_options *best, size_t caller_size,
                                                 char *why, size_t size);

#ifdef __cplusplus
}
#endif

#endif
