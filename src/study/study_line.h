/* SPDX-License-Identifier: BSD-3-Clause */
/* Lines of the study file: results as text, and the sum at the end of each. */
#ifndef BAUM_I_STUDY_STUDY_LINE_H
#define BAUM_I_STUDY_STUDY_LINE_H

#include "study/fields.h"

enum { BAUM_I_STUDY_LINE = 4096 }; /* most characters of a line, with its zero */

/* Appends the fields that are written to study files, in their order. */
void baum_i_study_write_fields(char line[BAUM_I_STUDY_LINE], const void *object,
                               const baum_i_field *fields);

/* Reads fields. Returns where they end, or NULL where one is missing or invalid; the object is then
 * partly read. */
const char *baum_i_study_read_fields(const char *text, void *object, const baum_i_field *fields);

/* Appends " | TEXT", without characters that end a line. */
void baum_i_study_write_text(char line[BAUM_I_STUDY_LINE], const char *text);

/* Appends the sum over the line and `seed`, and ends the line. */
void baum_i_study_seal(char line[BAUM_I_STUDY_LINE], uint64_t seed);

/* Removes the sum from a line if it is correct; otherwise returns false. */
bool baum_i_study_unseal(char *line, uint64_t seed);

#endif
