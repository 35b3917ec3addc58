/* SPDX-License-Identifier: BSD-3-Clause */
/* Whether forces depend on velocities, or masses on time and positions. */
#ifndef BAUM_I_DYNAMICS_DEPENDENCE_H
#define BAUM_I_DYNAMICS_DEPENDENCE_H

#include "dynamics/dynamics.h"

typedef enum baum_i_dependence {
  BAUM_I_DEPENDS_NOT,
  BAUM_I_DEPENDS_FORCE, /* a force depends on velocities */
  BAUM_I_DEPENDS_MASS   /* a mass depends on time or positions */
} baum_i_dependence;

/* Where it is asked about; velocities are of the size rate times scale, in powers of ten up and down. */
typedef struct baum_i_dependence_probe {
  double t;
  const double *q; /* (nq) */
  double rate;     /* [1/s] > 0 */
} baum_i_dependence_probe;

/* The first that does, with its label. Functions of the user are asked at the pose and at some others about it; where
 * they fail nothing is learnt. BAUM_OK, BAUM_ERR_MEMORY. */
baum_status baum_i_find_dependence(baum_workspace *workspace, const baum_i_dependence_probe *probe,
                                   baum_i_dependence *found, char label[BAUM_I_LABEL_SIZE]);

#endif
