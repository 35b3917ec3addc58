/* SPDX-License-Identifier: BSD-3-Clause */
/** @file
 *  Named mechanisms whose motion is known: to try methods on, to compare them with others, and as
 *  examples. A library of its own, baum_catalog, made from what baum offers to everybody.
 *  docs/mechanisms.md lists them.
 *
 *    baum_catalog_choice choice = {.name = "slider_crank"};
 *    baum_catalog_build(&choice, &mechanism);
 *
 *  Data, results and samples are in SI units. Angles are against the x axis, counterclockwise,
 *  unless a text says otherwise. A reference is either stored samples, which hold for the default
 *  parameters alone, or formulas (`exact`), which hold for all parameters, and for all times at
 *  which rounding leaves them their digits. Nothing is ever compared with a reference that does not
 *  hold. Threads: everything here may be called from any thread. Mechanisms made here need nothing
 *  to be kept beside them. Texts are constant.
 */
#ifndef BAUM_CATALOG_H
#define BAUM_CATALOG_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <baum/mechanism.h>

#if defined(_WIN32) && defined(BAUM_CATALOG_BUILDING) && !defined(BAUM_STATIC)
#define BAUM_CATALOG_API __declspec(dllexport)
#else
#define BAUM_CATALOG_API BAUM_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* ---- what there is --------------------------------------------------------------------------- */

/** A mechanism of the catalogue. */
typedef struct baum_catalog_entry {
  size_t struct_size;      /**< Set by the call. */
  const char *name;        /**< Such as "slider_crank". */
  const char *title;       /**< In words. */
  const char *source;      /**< Where its data come from. */
  const char *provenance;  /**< How its reference was made and checked; "" without one. */
  const char *note;        /**< What to know before running it; may be "". */
  int32_t parameter_count; /**< [-] see baum_catalog_parameter_at(). */
  int32_t sample_count;    /**< [-] of the reference, that of the start among them; 0: none. */
  double start_time;       /**< [s] */
  double end_time;         /**< [s] of the reference, and of the problem as it is posed. */
  double digits_q;         /**< [-] of positions of the reference that can be trusted, relative to
                                max(1, |q|); NaN without one. */
  double digits_v;         /**< [-] likewise of velocities. */
  bool exact;              /**< The reference is formulas. */
  bool smooth; /**< Stays away from singular configurations with the default parameters. */
} baum_catalog_entry;

/** A number that a mechanism of the catalogue depends on. */
typedef struct baum_catalog_parameter {
  size_t struct_size;  /**< Set by the call. */
  const char *name;    /**< Such as "eccentricity". */
  const char *unit;    /**< Such as "kg m^2"; "-" for a pure number. */
  const char *meaning; /**< In words. */
  double value;        /**< [unit] default. */
  bool positive;       /**< Must be > 0. */
  bool whole;          /**< Must be a whole number. */
} baum_catalog_parameter;

/** A parameter that is given another value than its default. */
typedef struct baum_catalog_setting {
  const char *name; /**< Of the parameter. */
  double value;     /**< [unit of the parameter] finite. */
} baum_catalog_setting;

/** A mechanism of the catalogue and its parameters. */
typedef struct baum_catalog_choice {
  const char *name;                     /**< Of the entry. */
  const baum_catalog_setting *settings; /**< (setting_count) NULL when there are none. */
  int32_t setting_count;                /**< [-] >= 0; the other parameters have their default. */
} baum_catalog_choice;

/** Number of entries. */
BAUM_CATALOG_API int32_t baum_catalog_count(void);

/** Read an entry.
 *  @param      k            0 to baum_catalog_count() - 1
 *  @param[out] out          filled
 *  @param      caller_size  sizeof *out
 *  @return     BAUM_OK, BAUM_ERR_ARGUMENT
 */
BAUM_CATALOG_API baum_status baum_catalog_entry_at(int32_t k, baum_catalog_entry *out,
                                                   size_t caller_size);

/** Read an entry by its name.
 *  @param[out] out          filled
 *  @param      caller_size  sizeof *out
 *  @return     BAUM_OK, BAUM_ERR_ARGUMENT (an unknown name: the message lists those there are)
 */
BAUM_CATALOG_API baum_status baum_catalog_find(const char *name, baum_catalog_entry *out,
                                               size_t caller_size);

/** Read a parameter of an entry.
 *  @param      name         of the entry
 *  @param      k            0 to parameter_count - 1
 *  @param[out] out          filled
 *  @param      caller_size  sizeof *out
 *  @return     BAUM_OK, BAUM_ERR_ARGUMENT
 */
BAUM_CATALOG_API baum_status baum_catalog_parameter_at(const char *name, int32_t k,
                                                       baum_catalog_parameter *out,
                                                       size_t caller_size);

/* ---- mechanisms ------------------------------------------------------------------------------ */

/** Build a mechanism, in the configuration and with the velocities of its start at t = 0.
 *  @param[in]  choice  what, with which parameters
 *  @param[out] out     receives it, frozen; NULL on failure; release with baum_mechanism_destroy()
 *  @return     BAUM_OK, BAUM_ERR_ARGUMENT (also for parameters with which it cannot be put
 *              together), BAUM_ERR_MEMORY
 */
BAUM_CATALOG_API baum_status baum_catalog_build(const baum_catalog_choice *choice,
                                                baum_mechanism **out);

/* ---- references ------------------------------------------------------------------------------ */

/** Times of the samples of a reference.
 *  @param      name   of the entry
 *  @param[out] times  (sample_count) [s] rising, from start_time to end_time
 *  @return     BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_UNSUPPORTED (it has no reference)
 */
BAUM_CATALOG_API baum_status baum_catalog_times(const char *name, double *times);

/** The state by the reference.
 *  @param[in]  choice  what, with which parameters
 *  @param      t       [s] a time of baum_catalog_times(); any finite one where the reference is
 *                      exact, before 0 too
 *  @param[out] q       (nq) positions in the order of the mechanism; NULL: not wanted
 *  @param[out] v       (nv) velocities; NULL: not wanted
 *  @return     BAUM_OK, BAUM_ERR_ARGUMENT (also for a time without a sample), BAUM_ERR_UNSUPPORTED
 *              (there is no reference, none for these parameters, or formulas are not known to
 *              their digits so far away)
 */
BAUM_CATALOG_API baum_status baum_catalog_reference(const baum_catalog_choice *choice, double t,
                                                    double *q, double *v);

/** The same as a function for baum_study_set_solution(), for references that are exact.
 *  @param      t       [s]
 *  @param[out] q,v     (nq), (nv)
 *  @param[out] lambda  not written: multipliers are not known
 *  @param[in]  user    const baum_catalog_choice *
 *  @return             0, or -1 where baum_catalog_reference() fails
 */
BAUM_CATALOG_API int baum_catalog_solution(double t, double *q, double *v, double *lambda,
                                           void *user);

/** How far states are from the reference. Errors of positions are relative to the characteristic
 *  length of the mechanism, those of angles and user coordinates in their own unit; those of
 *  velocities likewise, and relative to the largest velocity of the reference so measured. An error
 *  below its floor says nothing but that it is below it: the reference is not known better. */
typedef struct baum_catalog_error {
  size_t struct_size; /**< Set by baum_catalog_compare(). */
  double q;       /**< [-] largest of positions over all times; NaN where a state is not finite. */
  double v;       /**< [-] largest of velocities, likewise; NaN also when they were not given. */
  double q_final; /**< [-] of positions at the last time. */
  double v_final; /**< [-] of velocities at the last time. */
  double q_time;  /**< [s] of the largest error of positions. */
  double v_time;  /**< [s] of the largest error of velocities. */
  double q_floor; /**< [-] what the trusted digits mean for positions. */
  double v_floor; /**< [-] likewise for velocities. */
} baum_catalog_error;

/** Compare states with the reference.
 *  @param[in]  choice       what the mechanism was built from
 *  @param[in]  mechanism    frozen
 *  @param[in]  times        (n) [s] see baum_catalog_reference()
 *  @param      n            [-] > 0
 *  @param[in]  q            (n x nq) positions at these times
 *  @param[in]  v            (n x nv) velocities; NULL: not compared
 *  @param[out] out          filled
 *  @param      caller_size  sizeof *out
 *  @return     BAUM_OK, BAUM_ERR_STATE (not frozen), and as baum_catalog_reference()
 */
BAUM_CATALOG_API baum_status baum_catalog_compare(const baum_catalog_choice *choice,
                                                  const baum_mechanism *mechanism,
                                                  const double *times, int64_t n, const double *q,
                                                  const double *v, baum_catalog_error *out,
                                                  size_t caller_size);

#ifdef __cplusplus
}
#endif

#endif
