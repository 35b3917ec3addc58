/* SPDX-License-Identifier: BSD-3-Clause */
/** @file
 *  Sweeps: many runs of one mechanism with different numbers, in several threads.
 */
#ifndef BAUM_SWEEP_H
#define BAUM_SWEEP_H

#include <baum/simulation.h>

#ifdef __cplusplus
extern "C" {
#endif

/** A function that changes a mechanism for one run of a sweep, by functions such as
 *  baum_mechanism_set_planar_body(). Ids of the mechanism of the sweep are valid. Several threads
 *  call this function at the same time, each with another copy of the mechanism.
 *  @param copy  a copy of the mechanism of the sweep, not frozen
 *  @param run   [-] number of the run, from 0
 *  @param user  the member `user` of the definition
 *  @return  BAUM_OK; the run fails if the status is not BAUM_OK */
typedef baum_status baum_sweep_change_fn(baum_mechanism *copy, int64_t run, void *user);

/** What a sweep computes. */
typedef struct baum_sweep_def {
  size_t struct_size;           /**< Set by the default. Do not write. */
  int64_t count;                /**< [-] > 0, number of runs. Default: 0, must be set. */
  baum_sweep_change_fn *change; /**< Default: NULL, must be set. */
  void *user;                   /**< Passed to change, not owned. Default: NULL. */
  const double *times;          /**< (time_count) [s] monotone, of the samples. Default: NULL. */
  int64_t time_count;           /**< [-] > 0. Default: 0, must be set. */
  const baum_channel *channels; /**< (channel_count) what is sampled. Default: NULL. */
  int32_t channel_count;        /**< [-] > 0. Default: 0, must be set. */
  int32_t threads;              /**< [-] 1 to 1024, number of threads. Default: 1. */
} baum_sweep_def;

/** Set every field to its default.
 *  @param[out] def          NULL is ignored
 *  @param      caller_size  sizeof *def; no byte beyond it is written */
BAUM_API void baum_sweep_def_init(baum_sweep_def *def, size_t caller_size);
/** @copydoc baum_coordinates_def_default() */
static inline baum_sweep_def baum_sweep_def_default(void)
{
  baum_sweep_def def;
  baum_sweep_def_init(&def, sizeof def);
  return def;
}

/** Run all runs of a sweep. Each run begins with a copy of the mechanism, which `change` may
 *  change, and then samples the channels like baum_simulation_sample(). The results do not depend
 *  on the number of threads. A run that fails does not stop the others; its samples are NaN from
 *  the failure on. Functions of the user, such as those of the mechanism and the progress function
 *  of the options, are called from all threads.
 *  @param      mechanism  frozen; does not change
 *  @param[in]  options    of all runs
 *  @param[in]  def        what the sweep computes
 *  @param[out] rows       (count x time_count x width), see baum_channels_width()
 *  @param[out] statuses   (count) the baum_status of each run. May be NULL.
 *  @return  BAUM_OK if no run has failed, otherwise the status of the first run that failed, whose
 *           message begins with its number; BAUM_ERR_ARGUMENT, BAUM_ERR_STRUCT and BAUM_ERR_STATE
 *           (not frozen) before any run */
BAUM_API baum_status baum_sweep(const baum_mechanism *mechanism,
                                const baum_simulation_options *options, const baum_sweep_def *def,
                                double *rows, int32_t *statuses);

#ifdef __cplusplus
}
#endif

#endif
