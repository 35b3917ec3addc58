/* SPDX-License-Identifier: BSD-3-Clause */
/* A judge_scene as a mechanism of baum. */
#ifndef BAUM_JUDGE_BAUM_H
#define BAUM_JUDGE_BAUM_H

#include <baum/baum.h>

#include "judge_scene.h"

/** Build and freeze; the scene must outlive the mechanism, whose laws point into it. NULL on
 *  failure. */
baum_mechanism *judge_build(const judge_scene *s);

#endif
