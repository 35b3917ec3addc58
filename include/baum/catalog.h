/* SPDX-License-Identifier: BSD-3-Clause */
/** @file
 *  The catalogue: a collection of mechanisms. The page "docs/mechanisms.md" lists them. Use the
 *  mechanisms as examples, for tests of integration methods, and for comparisons with other
 *  programs. Almost all of them have a known motion. The catalogue is a separate library,
 *  baum_catalog, which uses only the public interface of baum.
 *
 *    baum_catalog_choice choice = {.name = "slider_crank"};
 *    baum_catalog_build(&choice, &mechanism);
 *
 *  Units are SI. Angles are counter-clockwise from the x axis unless documented otherwise. Strings
 *  in structs are constant and must not be freed.
 *
 *  The reference of a mechanism is its known motion. This motion is given either as stored samples
 *  or by formulas (baum_catalog_entry.exact says which). Samples are valid for the default
 *  parameters only. Formulas are valid for all parameters, and for all times at which their
 *  rounding errors stay below the accuracy that the fields `digits_q` and `digits_v` of
 *  baum_catalog_entry promise. If the reference is not valid for the parameters or the times of a
 *  motion, baum_catalog_compare() refuses to compare this motion with the reference.
 *
 *  Threads: every function may be called from any thread. */
#ifndef BAUM_CATALOG_H
#define BAUM_CATALOG_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <baum/mechanism.h>

/** Marks a public function of the catalogue. */
#if defined(_WIN32) && defined(BAUM_CATALOG_BUILDING) && !defined(BAUM_STATIC)
#define BAUM_CATALOG_API __declspec(dllexport)
#else
#define BAUM_CATALOG_API BAUM_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* ---- entries --------------------------------------------------------------------------------- */

/** A mechanism of the catalogue. */
typedef struct baum_catalog_entry {
  size_t struct_size; /**< Set by the function that fills the struct. */
  const char *name;   /**< Name of the mechanism, such as "slider_crank". */
  const char *title;  /**< Description in a few words. */
  const char *source; /**< Where the data of the mechanism come from. */
  /** How the reference was computed and checked; "" if the mechanism has no reference. */
  const char *provenance;
  const char *note;        /**< A remark, such as "one redundant constraint row"; may be "". */
  int32_t parameter_count; /**< [-] number of parameters, see baum_catalog_parameter_at(). */
  int32_t sample_count;    /**< [-] number of sample times; 0 if there is no reference. */
  double start_time;       /**< [s] start of the motion and of its reference. */
  double end_time;         /**< [s] end of the motion and of its reference. */
  /** [-] number of correct digits of the reference positions: the error of a position q is at most
   *  10^(-digits_q) max(1, |q|). NaN if there is no reference. */
  double digits_q;
  /** [-] number of correct digits of the reference velocities: the error of a velocity v is at most
   *  10^(-digits_v) max(1, |v|). NaN if there is no reference. */
  double digits_v;
  bool exact; /**< True if the reference consists of formulas. */
  /** True if the motion with default parameters passes through no singular configuration. */
  bool smooth;
} baum_catalog_entry;

/** A parameter of a mechanism of the catalogue. */
typedef struct baum_catalog_parameter {
  size_t struct_size;  /**< Set by the function that fills the struct. */
  const char *name;    /**< Name of the parameter, such as "eccentricity". */
  const char *unit;    /**< Unit of `value`, such as "kg m^2"; "-" for a pure number. */
  const char *meaning; /**< What the parameter describes. */
  double value;        /**< [unit] default value of the parameter. */
  bool positive;       /**< True if the value must be > 0. */
  bool whole;          /**< True if the value must be an integer. */
} baum_catalog_parameter;

/** A value for a parameter. */
typedef struct baum_catalog_setting {
  const char *name; /**< Name of the parameter. */
  double value;     /**< [unit of the parameter] value of the parameter, finite. */
} baum_catalog_setting;

/** A choice: which mechanism of the catalogue to build, and with which parameters. */
typedef struct baum_catalog_choice {
  const char *name; /**< Name of the entry. */
  /** (setting_count) values of some parameters. All other parameters have their default values. May
   *  be NULL if setting_count is 0. */
  const baum_catalog_setting *settings;
  int32_t setting_count; /**< [-] >= 0, number of elements of `settings`. */
} baum_catalog_choice;

/** Count the entries of the catalogue. @return number of entries */
BAUM_CATALOG_API int32_t baum_catalog_count(void);

/** Read an entry.
 *  @param      k            number of the entry, 0 to baum_catalog_count() - 1
 *  @param[out] out          filled
 *  @param      caller_size  sizeof *out
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT */
BAUM_CATALOG_API baum_status baum_catalog_entry_at(int32_t k, baum_catalog_entry *out,
                                                   size_t caller_size);

/** Read an entry by name.
 *  @param[in]  name         name of the entry
 *  @param[out] out          filled
 *  @param      caller_size  sizeof *out
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT (for an unknown name the message lists all names) */
BAUM_CATALOG_API baum_status baum_catalog_find(const char *name, baum_catalog_entry *out,
                                               size_t caller_size);

/** Read a parameter of an entry.
 *  @param[in]  name         name of the entry
 *  @param      k            number of the parameter, 0 to parameter_count - 1
 *  @param[out] out          filled
 *  @param      caller_size  sizeof *out
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT */
BAUM_CATALOG_API baum_status baum_catalog_parameter_at(const char *name, int32_t k,
                                                       baum_catalog_parameter *out,
                                                       size_t caller_size);

/* ---- mechanisms ------------------------------------------------------------------------------ */

/** Build a mechanism with its initial configuration and velocities at t = 0.
 *  @param[in]  choice  entry and parameters
 *  @param[out] out     receives the frozen mechanism; NULL on failure; release it with
 *                      baum_mechanism_destroy()
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT (also if the mechanism cannot be assembled with these
 *           parameters), BAUM_ERR_MEMORY */
BAUM_CATALOG_API baum_status baum_catalog_build(const baum_catalog_choice *choice,
                                                baum_mechanism **out);

/* ---- references ------------------------------------------------------------------------------ */

/** Read the times of the samples of a reference. If the reference consists of formulas, the times
 *  are equally spaced.
 *  @param[in]  name   name of the entry
 *  @param[out] times  (sample_count) [s] rising, from start_time to end_time
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_UNSUPPORTED (the entry has no reference) */
BAUM_CATALOG_API baum_status baum_catalog_times(const char *name, double *times);

/** Compute positions and velocities of the reference at a time.
 *  @param[in]  choice  entry and parameters
 *  @param      t       [s] one of the times that baum_catalog_times() returns. If the reference
 *                      consists of formulas, any finite time is allowed.
 *  @param[out] q       (nq) positions in the order of the mechanism's coordinates. May be NULL.
 *  @param[out] v       (nv) velocities. May be NULL.
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT (also for a time without a sample), BAUM_ERR_UNSUPPORTED
 *           (there is no reference, or none for these parameters, or the formulas are not accurate
 *           enough at this time because of rounding) */
BAUM_CATALOG_API baum_status baum_catalog_reference(const baum_catalog_choice *choice, double t,
                                                    double *q, double *v);

/** A function to pass to baum_study_set_solution(). It computes q and v by
 *  baum_catalog_reference(). Use it for mechanisms whose reference consists of formulas.
 *  @param      t       [s] time
 *  @param[out] q       (nq) positions
 *  @param[out] v       (nv) velocities
 *  @param[out] lambda  not written, because the reference has no multipliers
 *  @param[in]  user    the choice, a const baum_catalog_choice *
 *  @return  0, or -1 if baum_catalog_reference() fails */
BAUM_CATALOG_API int baum_catalog_solution(double t, double *q, double *v, double *lambda,
                                           void *user);

/** The result of baum_catalog_compare(): how far states differ from the reference. Errors of
 *  lengths are divided by the characteristic length of the mechanism. Errors of angles [rad] and of
 *  user coordinates are not scaled. The error of an orientation in space is the rotation that leads
 *  from the reference to the state; it has three components, the rotations about the body axes
 *  [rad]. Errors of velocities are scaled in the same way and then divided by the largest scaled
 *  velocity of the reference. The fields q_floor and v_floor contain the uncertainty of the
 *  reference. An error that is smaller than this uncertainty has no meaning. */
typedef struct baum_catalog_error {
  size_t struct_size; /**< Set by baum_catalog_compare(). */
  double q; /**< [-] largest error of positions over all times; NaN if a state is not finite. */
  /** [-] largest error of velocities over all times; NaN if a state is not finite, or if the
   *  argument v was NULL. */
  double v;
  double q_final; /**< [-] error of positions at the last time. */
  double v_final; /**< [-] error of velocities at the last time. */
  double q_time;  /**< [s] time of the largest error of positions. */
  double v_time;  /**< [s] time of the largest error of velocities. */
  double q_floor; /**< [-] uncertainty of the positions of the reference. */
  double v_floor; /**< [-] uncertainty of the velocities of the reference. */
} baum_catalog_error;

/** Compare states with the reference.
 *  @param[in]  choice       the choice from which the mechanism was built
 *  @param      mechanism    frozen
 *  @param[in]  times        (n) [s] each must be allowed as t in baum_catalog_reference()
 *  @param      n            [-] > 0
 *  @param[in]  q            (n x nq) positions at these times
 *  @param[in]  v            (n x nv) velocities at these times. If v is NULL, the function does not
 *                           compare velocities.
 *  @param[out] out          filled
 *  @param      caller_size  sizeof *out
 *  @return  BAUM_OK, BAUM_ERR_STATE (not frozen), or a status of baum_catalog_reference() */
BAUM_CATALOG_API baum_status baum_catalog_compare(const baum_catalog_choice *choice,
                                                  const baum_mechanism *mechanism,
                                                  const double *times, int64_t n, const double *q,
                                                  const double *v, baum_catalog_error *out,
                                                  size_t caller_size);

#ifdef __cplusplus
}
#endif

#endif
