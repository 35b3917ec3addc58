/* SPDX-License-Identifier: BSD-3-Clause */
/** @file
 *  Drivers along a spline.
 */
#ifndef BAUM_SPLINE_H
#define BAUM_SPLINE_H

#include <baum/mechanism.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ---- driver along a spline ------------------------------------------------------------------- */

/** A driver as baum_driver_def, whose s(t) is a cubic spline through given values, continuous with
 *  its second derivative. A natural spline goes on straight, with its end slopes, before the first
 *  and after the last time; a periodic one repeats itself. */
typedef struct baum_spline_driver_def {
  size_t struct_size;   /**< Set by the default. Do not write. */
  const char *name;     /**< Label in messages. Copied. Default: NULL, "joint<k>". */
  baum_joint_id joint;  /**< One with a coordinate. Default: none, must be set. */
  const double *times;  /**< (count) [s] rising. Copied. Default: NULL, must be set. */
  const double *values; /**< (count) [rad or m] s at `times`. Copied. Default: NULL, must be set. */
  int32_t count;        /**< [-] >= 3. Default: 0, must be set. */
  bool periodic;        /**< Repeats; first and last value are the same. Default: false, natural. */
} baum_spline_driver_def;

/** Set the defaults of a definition; writes at most caller_size bytes.
 *  @param[out] def          NULL is ignored
 *  @param      caller_size  sizeof *def
 */
BAUM_API void baum_spline_driver_def_init(baum_spline_driver_def *def, size_t caller_size);

/** The default definition of a driver along a spline. */
static inline baum_spline_driver_def baum_spline_driver_def_default(void)
{
  baum_spline_driver_def def;
  baum_spline_driver_def_init(&def, sizeof def);
  return def;
}

/** Add a driver along a spline on the coordinate of a joint.
 *  @param      mechanism  not yet frozen
 *  @param[in]  def        copied
 *  @param[out] id         receives the driver, a joint of one row; left as it is on failure.
 *                         May be NULL.
 *  @return     BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STRUCT, BAUM_ERR_STATE, BAUM_ERR_MEMORY;
 *              the mechanism is unchanged on failure
 */
BAUM_API baum_status baum_mechanism_add_spline_driver(baum_mechanism *mechanism,
                                                      const baum_spline_driver_def *def,
                                                      baum_joint_id *id);

/** Read a definition back; its pointers stay owned by the mechanism, until it is set again.
 *  @return BAUM_OK, BAUM_ERR_ARGUMENT
 */
BAUM_API baum_status baum_mechanism_get_spline_driver(const baum_mechanism *mechanism,
                                                      baum_joint_id id, baum_spline_driver_def *out,
                                                      size_t caller_size);

/** Replace a definition; the joint must stay.
 *  @return as baum_mechanism_add_spline_driver()
 */
BAUM_API baum_status baum_mechanism_set_spline_driver(baum_mechanism *mechanism, baum_joint_id id,
                                                      const baum_spline_driver_def *def);

#ifdef __cplusplus
}
#endif

#endif
