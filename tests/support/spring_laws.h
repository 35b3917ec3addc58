/* SPDX-License-Identifier: BSD-3-Clause */
/* A user's law of springs, right or faulty on purpose, and what is expected of the fault. */
#ifndef BAUM_TEST_SPRING_LAWS_H
#define BAUM_TEST_SPRING_LAWS_H

#include <baum/planar.h>

#include "point.h"

/* `user` of the law; all zero: right. */
typedef struct spring_law {
  int answer; /* returned */
  int spoil;  /* entry spoil - 1 is NaN */
  int wrong;  /* this entry of out, 1 or 2, is 1 too large */
} spring_law;

extern spring_law spring_law_good;

/* T = 2 + 3 l^3 + 0.4 l' + 0.1 l l'^2; fails unless out arrives zeroed. */
int spring_law_cubic(double length, double rate, double out[3], void *user);

/* Its value and derivatives. */
void spring_law_cubic_at(double length, double rate, double out[3]);

/* Force and linearize fail alike. */
void check_spring_law_fails(test_point *p, baum_status status, bool retry, const char *message);

/* The check of derivatives finds the wrong entry of the law of force 1, or 0 none; gives the
 * mechanism up. */
void check_spring_law_verdict(baum_mechanism *mechanism, const char *name, int entry);

#endif
