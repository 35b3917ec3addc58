/* SPDX-License-Identifier: BSD-3-Clause */
/** @file
 *  Sweeps: many runs of one mechanism in several threads. Each run uses its own copy of the
 *  mechanism, and a function that you write changes data of this copy, such as masses or lengths.
 */
#ifndef BAUM_SWEEP_H
#define BAUM_SWEEP_H

#include <baum/simulation.h>

#ifdef __cplusplus
extern "C" {
#endif

/** A function that changes a mechanism for one run of a sweep. It calls functions such as
 *  baum_mechanism_set_planar_body(). The ids of the original mechanism are also valid for the copy.
 *  Several threads call this function at the same time, each with its own copy.
 *  @param copy  a copy of the mechanism of the sweep, not frozen
 *  @param run   [-] number of the run, from 0
 *  @param user  the member `user` of the definition
 *  @return  BAUM_OK, or an error, which makes this run fail */
typedef baum_status baum_sweep_change_fn(baum_mechanism *copy, int64_t run, void *user);

/** The definition of a sweep: what the sweep computes. */
typedef struct baum_sweep_def {
  size_t struct_size; /**< Set by the default function. Do not write. */
  int64_t count;      /**< [-] > 0, number of runs. Default: 0, must be set. */
  /** Changes the copy of the mechanism that a run uses. Default: NULL, must be set. */
  baum_sweep_change_fn *change;
  void *user; /**< Passed to the function `change`, not owned. Default: NULL. */
  /** (time_count) [s] times of the samples, monotone. Default: NULL, must be set. */
  const double *times;
  int64_t time_count; /**< [-] > 0, number of times. Default: 0, must be set. */
  /** (channel_count) sampled channels. Default: NULL, must be set. */
  const baum_channel *channels;
  int32_t channel_count; /**< [-] > 0, number of channels. Default: 0, must be set. */
  int32_t threads;       /**< [-] 1 to 1024, number of threads. Default: 1. */
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

/** Execute all runs of a sweep. For each run, this function copies the mechanism, calls the
 *  function `change` of the definition for the copy, and samples the channels like
 *  baum_simulation_sample(). The results do not depend on the number of threads. A run that fails
 *  does not stop the others; its samples are NaN from the failure on. Several threads may call a
 *  user function at the same time, such as a force function of the mechanism or the progress
 *  function of the options.
 *  @param      mechanism  frozen; it is not modified
 *  @param[in]  options    options of all runs
 *  @param[in]  def        what the sweep computes
 *  @param[out] rows       (count x time_count x width) samples of all runs; width is
 *                         baum_channels_width() of the channels
 *  @param[out] statuses   (count) the baum_status of each run. May be NULL.
 *  @return  BAUM_OK if no run has failed. Otherwise the status of the first failed run, which is
 *           the one with the smallest run number; the message begins with this run number. If an
 *           argument is wrong (BAUM_ERR_ARGUMENT, BAUM_ERR_STRUCT) or the mechanism is not frozen
 *           (BAUM_ERR_STATE), no run is started. */
BAUM_API baum_status baum_sweep(const baum_mechanism *mechanism,
                                const baum_simulation_options *options, const baum_sweep_def *def,
                                double *rows, int32_t *statuses);

#ifdef __cplusplus
}
#endif

#endif
