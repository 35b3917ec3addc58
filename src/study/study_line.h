/* SPDX-License-Identifier: BSD-3-Clause */
/* Lines of the study file: results as text, and the sum at the end of each. */
#ifndef BAUM_I_STUDY_STUDY_LINE_H
#define BAUM_I_STUDY_STUDY_LINE_H

#include "study/fields.h"

enum { BAUM_I_STUDY_LINE = 4096 }; /* characters of a line at most, with its zero */

/* Add those of the fields that are filed, in their order. */
void baum_i_study_write_fields(char line[BAUM_I_STUDY_LINE], const void *object,
                               const baum_i_field *fields);

/* Returns where the fields end; NULL where one is missing or has no such value, the object being
 * half-read then. */
const char *baum_i_study_read_fields(const char *text, void *object, const baum_i_field *fields);

/* Add " | TEXT", without what would end a line. */
void baum_i_study_write_text(char line[BAUM_I_STUDY_LINE], const char *text);

/* Add the sum, which is over the line and `seed`, and the end of the line. */
void baum_i_study_seal(char line[BAUM_I_STUDY_LINE], uint64_t seed);

/* Cut the sum off a line that agrees with it. */
bool baum_i_study_unseal(char *line, uint64_t seed);

#endif
