/* SPDX-License-Identifier: BSD-3-Clause */
/* The rows of a study for spreadsheets and programs (RFC 4180). */
#include <math.h>

#include "study/report.h"

static void put_cell(baum_i_buffer *out, const baum_i_column *column, const baum_i_report_row *row)
{
  if (column->kind == BAUM_I_COLUMN_TEXT) {
    const char *text = baum_i_column_text(column, row);
    if (text) {
      baum_i_put(out, "\"");
      baum_i_put_csv(out, text);
      baum_i_put(out, "\"");
    }
  } else {
    baum_i_put(out, baum_i_exact(baum_i_column_number(column, row), "").text);
  }
}

void baum_i_report_csv(const baum_i_snapshot *survey, baum_i_buffer *out)
{
  for (int c = 0; c < baum_i_column_count; c++) {
    baum_i_putf(out, "%s%s", c ? "," : "", baum_i_columns[c].key);
  }
  baum_i_put(out, "\r\n");
  for (int k = 0; k < survey->row_count; k++) {
    for (int c = 0; c < baum_i_column_count; c++) {
      baum_i_put(out, c ? "," : "");
      put_cell(out, &baum_i_columns[c], &survey->rows[k]);
    }
    baum_i_put(out, "\r\n");
  }
}
