/* SPDX-License-Identifier: BSD-3-Clause */
/** @file
 *  Speed against accuracy, measured: one mechanism, one time span, many settings of a run; what
 *  each of them costs, how exact it is, and which one to take.
 *
 *    baum_study_create(mechanism, 0.0, 2.0, &study);
 *    baum_study_add_standard(study, NULL);
 *    baum_study_run(study);
 *    baum_study_recommend(study, 1e-6, BAUM_STUDY_WORK, &options, sizeof options, why, sizeof why);
 *
 *  A setting is an entry. Entries with the same integrator, formulation and gains, which differ in
 *  step or rtol, are a method. Errors are differences from a reference at samples t0 + k (t1 - t0)
 *  / n, k = 1 to n. The study makes its own reference or is given one; no entry is graded better
 *  than the reference is known. docs/theory/work-precision.md says how all of it is done.
 *
 *  Threads: one study is used by one thread at a time, but for baum_study_cancel().
 *  baum_study_run() uses the threads of the options, and calls functions of the user, those of the
 *  mechanism too, from each of them. While baum_study_run() is under way, its progress function may
 *  cancel it and, with one thread, read it: what would change it fails with BAUM_ERR_STATE, and it
 *  cannot be destroyed. Texts are owned by the study and stay as they are until the next call that
 *  is not reading, or its end.
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

/** A study without settings.
 *  @param[in]  mechanism  frozen; kept alive by the study
 *  @param      t0         [s] finite, start of all runs
 *  @param      t1         [s] finite, their end, not t0; before t0 for runs backward in time
 *  @param[out] out        receives the study, NULL on failure; release with baum_study_destroy()
 *  @return     BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STATE (not frozen), BAUM_ERR_MEMORY
 */
BAUM_API baum_status baum_study_create(const baum_mechanism *mechanism, double t0, double t1,
                                       baum_study **out);

/** End a study.
 *  @param study  may be NULL
 */
BAUM_API void baum_study_destroy(baum_study *study);

/** Called after each entry, and for the reference; by one thread at a time, not always the
 *  caller's.
 *  @param done   entries that are done, timed ones twice: half of `total` after all errors are
 *                known
 *  @param total  2 x entries
 *  @return       non-zero to cancel */
typedef int baum_study_progress_fn(const baum_study *study, int32_t done, int32_t total,
                                   void *user);

/** How to study. Start from baum_study_options_default(). */
typedef struct baum_study_options {
  size_t struct_size; /**< Set by the default. Do not write. */
  int32_t samples;    /**< [-] 2 to 1e6, at which errors are taken; at most 1e8 / (nq + nv + nc) for
                        large mechanisms. Default: 100. */
  int32_t threads; /**< [-] 1 to 1024, for errors; times are always taken one by one. Default: 1. */
  int32_t repeats; /**< [-] 1 to 1e6, most runs for the time of an entry; fewer where they are long.
                            Default: 5. */
  double entry_limit;  /**< [s] > 0 of CPU time, longest run of an entry; may be infinite. The
                           reference may take a minute, or five times that. Default: 10. */
  double time_budget;  /**< [s] > 0 of wall time, of one baum_study_run(); may be infinite. Default:
                            infinity. */
  bool energy_account; /**< Take the works of the stabilization, at the price of
                            baum_energy_account. Default: true. */
  const char *file;    /**< Path of the study file, see baum_study_run(). Copied. Default: NULL,
                            none. */
  baum_study_progress_fn *progress; /**< Default: NULL, none. */
  void *user;                       /**< Passed to progress, not owned. Default: NULL. */
  bool validate; /**< Run entries that may be recommended over twice the span and from other starts,
                      too, so that recommendations hold there. Default: true. */
} baum_study_options;

/** Set the default options; writes at most caller_size bytes.
 *  @param[out] options      NULL is ignored
 *  @param      caller_size  sizeof *options
 */
BAUM_API void baum_study_options_init(baum_study_options *options, size_t caller_size);

/** The default options. */
static inline baum_study_options baum_study_options_default(void)
{
  baum_study_options options;
  baum_study_options_init(&options, sizeof options);
  return options;
}

/** Set the options. Once entries have been run samples, energy_account and file stay as they are.
 *  @param[in] options  copied
 *  @return    BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STRUCT, BAUM_ERR_STATE, BAUM_ERR_MEMORY;
 *             unchanged on failure
 */
BAUM_API baum_status baum_study_set_options(baum_study *study, const baum_study_options *options);

/* ---- settings -------------------------------------------------------------------------------- */

/** Add one setting. Whether it can be run is found out by running it: one that is refused is an
 *  entry.
 *  @param[in] options  copied; start_time, progress and user are the study's whatever they say
 *  @return    BAUM_OK, BAUM_ERR_ARGUMENT (NULL, or no integrator), BAUM_ERR_STRUCT, BAUM_ERR_STATE,
 *             BAUM_ERR_MEMORY
 */
BAUM_API baum_status baum_study_add(baum_study *study, const baum_simulation_options *options);

/** What the standard grid has. Start from baum_study_grid_default(). */
typedef struct baum_study_grid {
  size_t struct_size;                /**< Set by the default. Do not write. */
  const baum_integrator *integrator; /**< This one alone. Default: NULL, all of the build. */
  baum_formulation formulation;      /**< This one alone. Default: BAUM_FORMULATION_DEFAULT, all. */
  int32_t settings;  /**< [-] 1 to 64, steps or tolerances of each method. Default: 8. */
  int32_t constants; /**< [-] 0 to 4, constant gains alpha = beta beside the rule of the integrator
                          and auto: 1, 10, 100, 1000 times the rate of the motion. Default: 2. */
  double coarsest; /**< [s] > 0, longest step of order 2 and more. Default: NaN, by the rate of the
                        motion. */
  double finest;   /**< [-] > 0, < 1e-2, least rtol; the largest is 1e-2. Default: NaN, 1e-13, or
                        1e-11 where a constraint of the user has neither jacobian nor gamma: what
                        differences leave there. */
  bool quick;      /**< The quick grid, a first answer for about a 25th of the cost: every
                        integrator with its default formulation (or the one above) and its own rule
                        for gains, at most 5 settings; `constants` does not apply. Default: false.
                        */
} baum_study_grid;

/** Set the default grid; writes at most caller_size bytes.
 *  @param[out] grid         NULL is ignored
 *  @param      caller_size  sizeof *grid
 */
BAUM_API void baum_study_grid_init(baum_study_grid *grid, size_t caller_size);

/** The default grid. */
static inline baum_study_grid baum_study_grid_default(void)
{
  baum_study_grid grid;
  baum_study_grid_init(&grid, sizeof grid);
  return grid;
}

/** Add the standard grid: every integrator that the build has, with each of its formulations, gains
 *  by its own rule, auto and some constants, each with some steps or tolerances from coarse to
 *  fine.
 *  @param[in] grid  NULL: the default
 *  @return    BAUM_OK, BAUM_ERR_ARGUMENT (also when the build has no such integrator with that
 *             formulation), BAUM_ERR_STRUCT, BAUM_ERR_STATE, BAUM_ERR_MEMORY,
 *             BAUM_STOP_CANCELLED; and when the
 *             mechanism cannot be started, whose rate is looked for, what baum_simulation_create()
 *             returns. Unchanged on failure
 */
BAUM_API baum_status baum_study_add_standard(baum_study *study, const baum_study_grid *grid);

/** Add stress settings: steps of 1e-1 to 1e-9 of a period of the motion, rtol of 1e-2 to 1e-14, and
 *  with BAUMGARTE gains alpha = beta of 0 and of 1e-6 to 1e12 1/s, at a step of 1e-3 of a period or
 *  rtol 1e-7. Every entry is to meet its tolerance, or to say why not. The entry limit bounds what
 *  tiny steps take.
 *  @param[in] integrator  NULL: all of the build that take a step or a tolerance
 *  @return    BAUM_OK, BAUM_ERR_ARGUMENT (also when the build has not that integrator),
 *             BAUM_ERR_STATE, BAUM_ERR_MEMORY, BAUM_STOP_CANCELLED; and when the mechanism cannot
 *             be started, what baum_simulation_create() returns. Unchanged on failure
 */
BAUM_API baum_status baum_study_add_stress(baum_study *study, const baum_integrator *integrator);

/* ---- what error means ------------------------------------------------------------------------ */

/** Say what error means: the largest |difference from the reference| / unit over all columns of
 *  some channels. Without this call it is that of all positions, lengths by the scale of the
 *  mechanism and angles in radians. Before entries have been run.
 *  @param[in] channels  (count) copied
 *  @param     count     [-] >= 1
 *  @param     unit      [of the channels] > 0, finite: a difference of that size is an error of 1
 *  @return    BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STRUCT (of a channel), BAUM_ERR_STATE,
 *             BAUM_ERR_MEMORY; unchanged on failure
 */
BAUM_API baum_status baum_study_set_error(baum_study *study, const baum_channel *channels,
                                          int32_t count, double unit);

/** Give a reference as samples, in place of the study's own; the option samples does not apply
 *  then. Before entries have been run. A number that is NaN is not compared.
 *  @param[in] times   (n) [s] strictly monotone from t0 to t1, t0 excluded
 *  @param     n       [-] >= 1
 *  @param[in] q       (n x nq) copied
 *  @param[in] v       (n x nv) copied. NULL: not known
 *  @param[in] lambda  (n x nc) copied. NULL: not known
 *  @param     digits  [-] > 0, to which it can be trusted: errors below 10^-digits are not told
 *                     apart
 *  @return    BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STATE, BAUM_ERR_MEMORY; unchanged on failure
 */
BAUM_API baum_status baum_study_set_reference(baum_study *study, const double *times, int32_t n,
                                              const double *q, const double *v,
                                              const double *lambda, double digits);

/** A solution known by formulas.
 *  @param      t       [s]
 *  @param[out] q       (nq)
 *  @param[out] v       (nv)
 *  @param[out] lambda  (nc) NaN at call, may stay so: not known
 *  @return     0 when fine */
typedef int baum_study_solution_fn(double t, double *q, double *v, double *lambda, void *user);

/** Give a reference as a function, otherwise as baum_study_set_reference().
 *  @param solution  called from the thread of baum_study_run()
 *  @param user      passed to it, not owned
 *  @param digits    [-] > 0
 *  @return          BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STATE
 */
BAUM_API baum_status baum_study_set_solution(baum_study *study, baum_study_solution_fn *solution,
                                             void *user, double digits);

/* ---- running --------------------------------------------------------------------------------- */

/** Make the reference and run the entries that are not done: first all errors, by several threads,
 *  coarse settings first, then all times, one after the other. Entries that fail, are refused or
 *  reach the limit are entries like others. A finer setting of a method that has reached the entry
 *  limit is not tried. Another call goes on where one has stopped, with entries that were added
 *  since. With the option file every result is appended to it as a line of text when it is known,
 *  and all are on the disk when this returns; a study of the same mechanism, span, samples, error
 *  and reference takes its entries from there, also where a line is cut off. What functions of the
 *  user do is not compared. One process at a time.
 *  @return  BAUM_OK, BAUM_WARNED (the reference is not to be trusted), BAUM_STOP_CANCELLED (also
 *           the time budget is spent), BAUM_ERR_STATE (no entries, or under way), BAUM_ERR_MEMORY,
 *           BAUM_ERR_FILE, BAUM_ERR_BUFFER (the file is another study's: the message says what
 *           differs), BAUM_ERR_CALLBACK (the solution), and what stops every run: what
 *           baum_simulation_create() returns for the mechanism
 */
BAUM_API baum_status baum_study_run(baum_study *study);

/** Ask baum_study_run() to stop, which does not keep entries under way, or a call that adds
 *  entries, which then adds none. From any thread or signal handler.
 *  @param study  may be NULL
 */
BAUM_API void baum_study_cancel(baum_study *study);

/* ---- entries --------------------------------------------------------------------------------- */

/** How far an entry has come. */
typedef enum baum_study_state {
  BAUM_STUDY_WAITING = 0,  /**< Not run, or not to its end. */
  BAUM_STUDY_DONE = 1,     /**< Has reached the end of the span. */
  BAUM_STUDY_REFUSED = 2,  /**< Could not be started. */
  BAUM_STUDY_FAILED = 3,   /**< Stopped on its way. */
  BAUM_STUDY_TIMED_OUT = 4 /**< Reached the entry limit, or a coarser setting of its method did. */
} baum_study_state;

/** Name of a state such as "done"; NULL for an unknown value. */
BAUM_API const char *baum_study_state_name(baum_study_state state);

/** What is found out about a setting: X(type, name, known, unit, meaning). The one list from which
 *  the struct below, the study file, CSV, JSON and Python come. Reports give figures that are known
 *  when DONE for entries that are done only. Errors are the largest over all samples, `final` ones
 *  those at the last; where they would be below the uncertainty of the reference they are that. */
#define BAUM_STUDY_ENTRY_LIST(X)                                                                   \
  X(baum_study_state, state, ALWAYS, "", "done, refused, failed, timed_out or waiting")            \
  X(baum_status, status, ALWAYS, "", "of its run")                                                 \
  X(bool, at_floor, ALWAYS, "", "error is the uncertainty of the reference, as good as it gets")   \
  X(bool, untrusted, ALWAYS, "", "the reference is not to be trusted, so errors are not either")   \
  X(bool, off, ALWAYS, "", "another motion: error_q above 0.1, or a branch warning")               \
  X(bool, unstable, ALWAYS, "", "its gains do not damp with this step")                            \
  X(double, alpha, ALWAYS, "1/s", "of the gains that the run used, whatever their rule; 0: none")  \
  X(double, beta, ALWAYS, "1/s", "likewise")                                                       \
  X(double, error, DONE, "1", "what the study calls error, see baum_study_set_error()")            \
  X(double, error_final, DONE, "1", "error at the last sample")                                    \
  X(double, error_half, DONE, "1", "error over the first half of the samples: how errors grow")    \
  X(double, error_q, DONE, "1", "of positions, by the scales")                                     \
  X(double, error_q_final, DONE, "1", "of positions at the last sample")                           \
  X(double, error_v, DONE, "1", "of velocities, by the scales and the largest scaled velocity")    \
  X(double, error_v_final, DONE, "1", "of velocities at the last sample")                          \
  X(double, error_lambda, DONE, "1", "of multipliers, times the displacement of their rows")       \
  X(double, error_lambda_final, DONE, "1", "of multipliers at the last sample")                    \
  X(double, energy_error, DONE, "J", "drift of energy against the reference")                      \
  X(double, energy_error_final, DONE, "J", "drift of energy at the last sample")                   \
  X(double, error_estimate, DONE, "1", "as in baum_counters")                                      \
  X(double, error_validated, DONE, "1", "over twice the span and from starts nearby; see below")   \
  X(double, max_phi, DONE, "m or rad", "largest constraint violation |Phi| over all steps")        \
  X(double, max_phi_rate, DONE, "m/s or rad/s", "largest |Phi'| over all steps")                   \
  X(double, violation_work, DONE, "J", "work of constraint forces, see baum_energy_account")       \
  X(double, projection_work, DONE, "J", "energy that projections have changed, likewise")          \
  X(double, gains_work, DONE, "J", "work of the stabilization, likewise")                          \
  X(double, work, DONE, "evaluations", "the same on every machine: BAUM_STUDY_WORK")               \
  X(double, cpu, DONE, "s", "least CPU time of a run from its making to its end, without samples") \
  X(double, cpu_spread, DONE, "s", "second least CPU time less the least")                         \
  X(int32_t, repeats, DONE, "1", "runs for the CPU time")                                          \
  X(int64_t, evaluations, DONE, "1", "right-hand sides or residuals, without those of samples")    \
  X(int64_t, factorizations, DONE, "1", "of matrices, likewise")                                   \
  X(int64_t, nonlinear_iterations, DONE, "1", "of implicit methods")                               \
  X(int64_t, steps, DONE, "1", "accepted")                                                         \
  X(int64_t, rejected, DONE, "1", "steps that were repeated")                                      \
  X(int64_t, forced_steps, DONE, "1", "over singular configurations")                              \
  X(int64_t, near_singular_intervals, DONE, "1", "of its run")                                     \
  X(int64_t, warnings, DONE, "1", "of its run")                                                    \
  X(int64_t, branch_warnings, DONE, "1", "of its run")                                             \
  X(int64_t, doubts, DONE, "1", "kinds of warnings that doubt the motion")

/** What a setting costs and how exact it is. NaN: not known. error_validated is infinite where the
 *  setting fails there, and not known for entries that cost far more than others as exact. */
typedef struct baum_study_entry {
  size_t struct_size;  /**< Set by baum_study_entry_at(). */
  const char *name;    /**< Such as "rk8 projection, rtol 1e-06". */
  const char *message; /**< Why it is refused or failed, else its first warning, else "". */
  const baum_integrator *integrator; /**< Of the options. */
  baum_formulation formulation;      /**< The one it stands for, not DEFAULT. */
  baum_gains gains;                  /**< Of the options. */
  double step;                       /**< [s] NaN: it goes by rtol. */
  double rtol;                       /**< [-] NaN: it goes by step. */
  int32_t method;                    /**< See baum_study_method_at(). */
#define BAUM_X(type, name, known, unit, meaning) type name;
  BAUM_STUDY_ENTRY_LIST(BAUM_X)
#undef BAUM_X
} baum_study_entry;

/** Number of entries; 0 for NULL. */
BAUM_API int32_t baum_study_entry_count(const baum_study *study);

/** Read an entry.
 *  @param      k            0 to baum_study_entry_count() - 1, in the order of adding
 *  @param[out] out          filled
 *  @param      caller_size  sizeof *out
 *  @return     BAUM_OK, BAUM_ERR_ARGUMENT
 */
BAUM_API baum_status baum_study_entry_at(const baum_study *study, int32_t k, baum_study_entry *out,
                                         size_t caller_size);

/** The options of an entry, ready for baum_simulation_create(). row_gains, if any, are owned by the
 *  study.
 *  @param[out] out          filled
 *  @param      caller_size  sizeof *out
 *  @return     BAUM_OK, BAUM_ERR_ARGUMENT
 */
BAUM_API baum_status baum_study_entry_options(const baum_study *study, int32_t k,
                                              baum_simulation_options *out, size_t caller_size);

/* ---- reference ------------------------------------------------------------------------------- */

/** Where the reference has come from. */
typedef enum baum_study_origin {
  BAUM_STUDY_OWN = 0,     /**< Made by the study. */
  BAUM_STUDY_GIVEN = 1,   /**< baum_study_set_reference(). */
  BAUM_STUDY_SOLUTION = 2 /**< baum_study_set_solution(). */
} baum_study_origin;

/** How far the reference can be trusted. */
typedef struct baum_study_reference {
  size_t struct_size;        /**< Set by baum_study_reference_read(). */
  baum_study_origin origin;  /**< Whose. */
  bool trusted;              /**< Own: its runs agree to three digits or more and met no singular
                           configuration. */
  double digits;             /**< [-] trusted digits, -log10(uncertainty); NaN before it is made. */
  double uncertainty;        /**< [-] of error. */
  double uncertainty_q;      /**< [-] of error_q. */
  double uncertainty_v;      /**< [-] of error_v. */
  double uncertainty_lambda; /**< [-] of error_lambda. */
  double uncertainty_energy; /**< [J] of energy_error. */
  int32_t samples;           /**< [-] number of samples. */
  const char *text; /**< Who agrees with whom to how many digits, or why it is not to be trusted. */
} baum_study_reference;

/** Read how far the reference can be trusted; known after baum_study_run().
 *  @param[out] out          filled
 *  @param      caller_size  sizeof *out
 *  @return     BAUM_OK, BAUM_ERR_ARGUMENT
 */
BAUM_API baum_status baum_study_reference_read(const baum_study *study, baum_study_reference *out,
                                               size_t caller_size);

/** A sample of the reference.
 *  @param      k       0 to samples - 1
 *  @param[out] t       [s] NULL: not wanted, as the others
 *  @param[out] q       (nq)
 *  @param[out] v       (nv) NaN where not known
 *  @param[out] lambda  (nc) NaN where not known
 *  @return     BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STATE (not made; one that goes on from a
 *              complete file does not make it again)
 */
BAUM_API baum_status baum_study_reference_sample(const baum_study *study, int32_t k, double *t,
                                                 double *q, double *v, double *lambda);

/** What has been studied.
 *  @param[out] t0,t1    [s] NULL: not wanted
 *  @param[out] options  as set; NULL: not wanted
 *  @param      caller_size  sizeof *options
 *  @return     BAUM_OK, BAUM_ERR_ARGUMENT
 */
BAUM_API baum_status baum_study_settings(const baum_study *study, double *t0, double *t1,
                                         baum_study_options *options, size_t caller_size);

/** In words what error means, such as "largest error of all positions, lengths by 0.51 m, angles in
 *  rad"; NULL for NULL. */
BAUM_API const char *baum_study_error_text(const baum_study *study);

/* ---- answers --------------------------------------------------------------------------------- */

/** What cost means. */
typedef enum baum_study_cost {
  BAUM_STUDY_WORK =
    0, /**< [-] the same on every machine: evaluations, factorizations and iterations of implicit
            methods, each counted alike. */
  BAUM_STUDY_CPU = 1 /**< [s] as measured. */
} baum_study_cost;

/** Entries with the same integrator, formulation and gains, of which each has a step, or each an
 *  rtol. */
typedef struct baum_study_method {
  size_t struct_size;                /**< Set by baum_study_method_at(). */
  const char *name;                  /**< Such as "rk8 projection". */
  const baum_integrator *integrator; /**< Of its entries. */
  baum_formulation formulation;      /**< Of its entries. */
  baum_gains gains;                  /**< Of its entries. */
  bool fixed_step;                   /**< Of steps rather than tolerances. */
  int32_t entries;                   /**< [-] it has. */
  int32_t usable;                    /**< [-] of these those that are done and not `off`. */
  double least_error;                /**< [-] that it reaches; NaN when none is usable. */
  double slope; /**< [-] d log error / d log step or rtol where errors fall; NaN: not known. */
  double work_per_digit; /**< [-] factor on work for one more digit; NaN likewise. */
  double cpu_per_digit;  /**< [-] factor on CPU time for one more digit; NaN likewise. */
  double growth; /**< [-] error_validated over error of its entries, on geometric average; NaN: none
                      was validated to the end. */
} baum_study_method;

/** Number of methods; 0 for NULL. */
BAUM_API int32_t baum_study_method_count(const baum_study *study);

/** Read a method.
 *  @param      k            0 to baum_study_method_count() - 1
 *  @param[out] out          filled
 *  @param      caller_size  sizeof *out
 *  @return     BAUM_OK, BAUM_ERR_ARGUMENT
 */
BAUM_API baum_status baum_study_method_at(const baum_study *study, int32_t k,
                                          baum_study_method *out, size_t caller_size);

/** The Pareto front: entries than which none is both cheaper and more exact. Entries at the floor
 *  of the reference count as equally exact.
 *  @param      cost      what is cheap
 *  @param      capacity  of `entries`; >= 0
 *  @param[out] entries   (capacity) the first ones, from cheap to exact. NULL when capacity is 0
 *  @param[out] count     receives how many there are, which may exceed the capacity
 *  @return     BAUM_OK, BAUM_ERR_ARGUMENT
 */
BAUM_API baum_status baum_study_front(const baum_study *study, baum_study_cost cost,
                                      int32_t capacity, int32_t *entries, int32_t *count);

/** What a method costs at an error, on the line through the logarithms of its entries; up to one
 *  setting beyond its ends.
 *  @param      method  see baum_study_method_at()
 *  @param      error   [-] > 0
 *  @param[out] out     [- or s]
 *  @return     BAUM_OK, BAUM_ERR_ARGUMENT (also when it does not reach that error: the message
 *              says how far it comes)
 */
BAUM_API baum_status baum_study_cost_at(const baum_study *study, int32_t method, double error,
                                        baum_study_cost cost, double *out);

/** Cost at equal error: of method a over that of method b.
 *  @param[out] ratio  [-] below 1: a is cheaper
 *  @return     as baum_study_cost_at()
 */
BAUM_API baum_status baum_study_compare(const baum_study *study, int32_t a, int32_t b, double error,
                                        baum_study_cost cost, double *ratio);

/** The cheapest setting for an error. It is chosen so that it holds for starts nearby and for twice
 *  the span, by what entries have shown there (error_validated) and a margin. Its step or rtol may
 *  lie between those of entries of its method. Where no entry keeps the error with all that, one
 *  that keeps it as measured is taken, and `why` says that nothing is left.
 *  @param      error        [-] > 0, wanted; see baum_study_set_error()
 *  @param      cost         what is cheap
 *  @param[out] best         options for baum_simulation_create()
 *  @param      caller_size  sizeof *best
 *  @param[out] why          (size) a message with the measured figures, cut if too long. May be
 *                           NULL
 *  @return     BAUM_OK, BAUM_WARNED (the reference is not to be trusted), BAUM_ERR_ARGUMENT (also
 *              when no entry is so exact, or the reference is not known so well), BAUM_ERR_STATE
 *              (no entry is timed); `best` is unchanged on failure
 */
BAUM_API baum_status baum_study_recommend(const baum_study *study, double error,
                                          baum_study_cost cost, baum_simulation_options *best,
                                          size_t caller_size, char *why, size_t size);

/** The most exact setting for a CPU time, otherwise as baum_study_recommend().
 *  @param seconds  [s] > 0, finite, for a run over the span of the study on this machine
 *  @return         as baum_study_recommend(); BAUM_ERR_ARGUMENT also when no entry is so fast
 */
BAUM_API baum_status baum_study_recommend_budget(const baum_study *study, double seconds,
                                                 baum_simulation_options *best, size_t caller_size,
                                                 char *why, size_t size);

#ifdef __cplusplus
}
#endif

#endif
