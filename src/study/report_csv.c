/* SPDX-License-Identifier: BSD-3-Clause */
/* Writes the entries of a study as CSV (RFC 4180). */
#include "study/report.h"

static void put_cell(baum_i_buffer *out, const baum_i_field *field, const void *entry)
{
  if (field->kind > BAUM_I_LAST_TEXT) {
    baum_i_put(out, baum_i_exact(baum_i_field_number(field, entry), "").text);
  } else if (baum_i_field_text(field, entry)) {
    baum_i_put(out, "\"");
    baum_i_put_user_text(out, baum_i_field_text(field, entry), BAUM_I_CSV);
    baum_i_put(out, "\"");
  }
}

void baum_i_report_csv(const baum_i_snapshot *snapshot, baum_i_buffer *out)
{
  const baum_i_field *const fields = baum_i_entry_fields;
  for (const baum_i_field *f = fields; f->key; f++) {
    baum_i_putf(out, "%s%s", f == fields ? "" : ",", f->key);
  }
  baum_i_put(out, "\r\n");
  for (int k = 0; k < snapshot->entry_count; k++) {
    for (const baum_i_field *f = fields; f->key; f++) {
      baum_i_put(out, f == fields ? "" : ",");
      put_cell(out, f, &snapshot->entries[k]);
    }
    baum_i_put(out, "\r\n");
  }
}
