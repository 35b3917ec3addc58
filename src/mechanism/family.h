/* SPDX-License-Identifier: BSD-3-Clause */
/* The families of elements: bodies, joints and forces. Code that is common to all elements is
 * written once, for a family. */
#ifndef BAUM_I_MECHANISM_FAMILY_H
#define BAUM_I_MECHANISM_FAMILY_H

#include "mechanism/model.h"

/* Sums over the elements of a family, where nl is the number of local velocities of an element
 * (baum_i_span). The freeze computes these sums while it numbers the elements. */
typedef struct baum_i_totals {
  int64_t positions;
  int64_t rows;    /* velocities of bodies or rows of joints; not used for forces */
  int64_t blocks;  /* sum of rows x nl over the elements */
  int64_t squares; /* sum of nl x nl over the elements */
} baum_i_totals;

/* The differences between families. Each family has its own element struct, which begins with a
 * baum_i_element. */
typedef struct baum_i_family {
  const char *name; /* "body", for messages and default names */
  size_t size;      /* size of the struct of an element */
  size_t span;      /* offset of the baum_i_span in an element */
  size_t count;     /* offset of the element count (an int) in the mechanism */
  /* returns element k; k counts from 0, and ground is not counted */
  baum_i_element *(*at)(const baum_mechanism *mechanism, int k);
  /* Functions that return a status fail only when out of memory. They then set the message. */
  baum_status (*append)(baum_mechanism *mechanism, baum_i_element *element);
  /* set the type and the sizes that the definition determines */
  void (*prepare)(baum_i_element *element);
  /* The freeze calls these three functions. rows() returns the number of rows or velocities of an
   * element, place() stores where the blocks of an element begin, and close() stores the sizes of
   * the mechanism. */
  int (*rows)(const baum_i_element *element);
  void (*place)(baum_i_element *element, const baum_i_totals *before);
  void (*close)(baum_mechanism *mechanism, const baum_i_totals *all);
  /* These functions build the groups. A group is the list of all elements of one type. */
  baum_status (*open_groups)(baum_mechanism *mechanism);
  baum_status (*join_group)(baum_mechanism *mechanism, baum_i_element *element);
  void (*free_groups)(baum_mechanism *mechanism); /* does nothing if the mechanism has no groups */
} baum_i_family;

extern const baum_i_family baum_i_body_family;
extern const baum_i_family baum_i_joint_family;
extern const baum_i_family baum_i_force_family;

enum { BAUM_I_FAMILIES = 3 };
/* bodies are the first family */
extern const baum_i_family *const baum_i_families[BAUM_I_FAMILIES];

static inline int baum_i_family_count(const baum_i_family *family, const baum_mechanism *mechanism)
{
  return *(const int *)(const void *)((const char *)mechanism + family->count);
}

static inline baum_i_span *baum_i_family_span(const baum_i_family *family, baum_i_element *element)
{
  return (baum_i_span *)(void *)((char *)element + family->span);
}

#endif
