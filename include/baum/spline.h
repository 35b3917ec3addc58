/* SPDX-License-Identifier: BSD-3-Clause */
/** @file
 *  Drivers that prescribe a joint coordinate as a spline of time.
 */
#ifndef BAUM_SPLINE_H
#define BAUM_SPLINE_H

#include <baum/mechanism.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ---- driver along a spline ------------------------------------------------------------------- */

/** A driver that prescribes a joint coordinate, as baum_driver_def does. Its law s(t) is a cubic
 *  spline through given values, and the second derivative of the spline is continuous. Before the
 *  first and after the last of the given times, a natural spline continues as a straight line. A
 *  periodic spline repeats. */
typedef struct baum_spline_driver_def {
  size_t struct_size;  /**< Set by the default function. Do not write. */
  const char *name;    /**< Label in messages. Copied. Default: NULL, "joint<k>". */
  baum_joint_id joint; /**< A joint with a coordinate. Default: none, must be set. */
  const double *times; /**< (count) [s] times, rising. Copied. Default: NULL, must be set. */
  /** (count) [rad or m] values of the law s(t) at the times in `times`. Copied. Default: NULL, must
   *  be set. */
  const double *values;
  int32_t count; /**< [-] >= 3, number of times. Default: 0, must be set. */
  /** True for a periodic spline, which repeats; the first and the last value must then be equal.
   *  Default: false, a natural spline. */
  bool periodic;
  /** [-] which coordinate of the joint the driver prescribes. Default: BAUM_COORDINATE_FIRST. */
  baum_joint_coordinate coordinate;
} baum_spline_driver_def;

/** @copydoc baum_coordinates_def_init() */
BAUM_API void baum_spline_driver_def_init(baum_spline_driver_def *def, size_t caller_size);
/** @copydoc baum_coordinates_def_default() */
static inline baum_spline_driver_def baum_spline_driver_def_default(void)
{
  baum_spline_driver_def def;
  baum_spline_driver_def_init(&def, sizeof def);
  return def;
}
/** @copydoc baum_mechanism_add_coordinates() */
BAUM_API baum_status baum_mechanism_add_spline_driver(baum_mechanism *mechanism,
                                                      const baum_spline_driver_def *def,
                                                      baum_joint_id *id);
/** @copydoc baum_mechanism_get_coordinates() */
BAUM_API baum_status baum_mechanism_get_spline_driver(const baum_mechanism *mechanism,
                                                      baum_joint_id id, baum_spline_driver_def *out,
                                                      size_t caller_size);
/** @copydoc baum_mechanism_set_coordinates() */
BAUM_API baum_status baum_mechanism_set_spline_driver(baum_mechanism *mechanism, baum_joint_id id,
                                                      const baum_spline_driver_def *def);

#ifdef __cplusplus
}
#endif

#endif
