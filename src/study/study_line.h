/* SPDX-License-Identifier: BSD-3-Clause */
/* Lines of the study file: results as text, and a sum at the end of each line. */
#ifndef BAUM_I_STUDY_STUDY_LINE_H
#define BAUM_I_STUDY_STUDY_LINE_H

#include "study/fields.h"

enum { BAUM_I_STUDY_LINE = 4096 }; /* largest length of a line, with the terminating zero */

/* Appends all fields whose `filed` is true, in their order. */
void baum_i_study_write_fields(char line[BAUM_I_STUDY_LINE], const void *object,
                               const baum_i_field *fields);

/* Reads fields. Returns the end of the fields, or NULL if one is missing or invalid. The object is
 * then partly changed. */
const char *baum_i_study_read_fields(const char *text, void *object, const baum_i_field *fields);

/* Appends " | TEXT". Characters that end a line are replaced. */
void baum_i_study_write_text(char line[BAUM_I_STUDY_LINE], const char *text);

/* Appends the digest of the line and `seed`, and ends the line. */
void baum_i_study_seal(char line[BAUM_I_STUDY_LINE], uint64_t seed);

/* Removes the sum from a line. Returns false if the sum is not correct. */
bool baum_i_study_unseal(char *line, uint64_t seed);

#endif
