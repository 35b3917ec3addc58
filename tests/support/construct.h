/* SPDX-License-Identifier: BSD-3-Clause */
/* Creates mechanisms and adds planar joints. If a call fails, the test fails with its message. */
#ifndef BAUM_TEST_CONSTRUCT_H
#define BAUM_TEST_CONSTRUCT_H

#include <baum/mechanism.h>

baum_mechanism *create_mechanism(void);

/* The point (x, y) [m] of the joint is given in the design configuration. `name` may be NULL. */
baum_joint_id add_planar_pin(baum_mechanism *m, const char *name, baum_body_id a, baum_body_id b,
                             double x, double y);
baum_joint_id add_planar_weld(baum_mechanism *m, baum_body_id a, baum_body_id b, double x,
                              double y);

#endif
