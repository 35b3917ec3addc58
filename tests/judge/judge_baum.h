/* SPDX-License-Identifier: BSD-3-Clause */
/* Builds the mechanism of a judge_scene with the library. */
#ifndef BAUM_JUDGE_BAUM_H
#define BAUM_JUDGE_BAUM_H

#include <baum/baum.h>

#include "judge_scene.h"

/** Builds and freezes the mechanism. Returns NULL if this fails. The laws of its drivers keep
 * pointers into the scene, so the scene must not be destroyed before the mechanism. */
baum_mechanism *judge_build(const judge_scene *s);

#endif
