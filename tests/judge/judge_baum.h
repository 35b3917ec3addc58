/* SPDX-License-Identifier: BSD-3-Clause */
/* Builds a judge_scene as a mechanism of the library. */
#ifndef BAUM_JUDGE_BAUM_H
#define BAUM_JUDGE_BAUM_H

#include <baum/baum.h>

#include "judge_scene.h"

/** Builds and freezes the mechanism; returns NULL on failure. Driver laws point into the scene, so
 *  it must outlive the mechanism. */
baum_mechanism *judge_build(const judge_scene *s);

#endif
