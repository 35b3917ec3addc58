/* SPDX-License-Identifier: BSD-3-Clause */
/* The entries of a study for spreadsheets and programs (RFC 4180). */
#include <math.h>

#include "study/report.h"

static void put_cell(baum_i_buffer *out, const baum_i_column *column,
                     const baum_i_report_entry *entry)
{
  if (column->kind == BAUM_I_COLUMN_TEXT) {
    const char *text = baum_i_column_text(column, entry);
    if (text) {
      baum_i_put(out, "\"");
      baum_i_put_csv(out, text);
      baum_i_put(out, "\"");
    }
  } else {
    baum_i_put(out, baum_i_exact(baum_i_column_number(column, entry), "").text);
  }
}

void baum_i_report_csv(const baum_i_snapshot *snapshot, baum_i_buffer *out)
{
  for (int c = 0; c < baum_i_column_count; c++) {
    baum_i_putf(out, "%s%s", c ? "," : "", baum_i_columns[c].key);
  }
  baum_i_put(out, "\r\n");
  for (int k = 0; k < snapshot->entry_count; k++) {
    for (int c = 0; c < baum_i_column_count; c++) {
      baum_i_put(out, c ? "," : "");
      put_cell(out, &baum_i_columns[c], &snapshot->entries[k]);
    }
    baum_i_put(out, "\r\n");
  }
}
