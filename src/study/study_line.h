/* SPDX-License-Identifier: BSD-3-Clause */
/* Lines of the study file. They contain results as text, and each line ends with a digest. */
#ifndef BAUM_I_STUDY_STUDY_LINE_H
#define BAUM_I_STUDY_STUDY_LINE_H

#include "study/fields.h"

enum { BAUM_I_STUDY_LINE = 4096 }; /* largest length of a line, including the terminating zero */

/* Appends to the line all fields whose `filed` is true, in the order of the table. */
void baum_i_study_write_fields(char line[BAUM_I_STUDY_LINE], const void *object,
                               const baum_i_field *fields);

/* Reads fields from a line and stores their values in an object. Returns the end of the fields.
 * Returns NULL if a field is missing or invalid; some members may have changed nevertheless. */
const char *baum_i_study_read_fields(const char *text, void *object, const baum_i_field *fields);

/* Appends " | " and a text to the line. Characters that would end the line are replaced. */
void baum_i_study_write_text(char line[BAUM_I_STUDY_LINE], const char *text);

/* Appends the digest of `seed` and of the line, and ends the line. */
void baum_i_study_seal(char line[BAUM_I_STUDY_LINE], uint64_t seed);

/* Removes the digest from the end of a line. Returns false if the digest is not correct. */
bool baum_i_study_unseal(char *line, uint64_t seed);

#endif
