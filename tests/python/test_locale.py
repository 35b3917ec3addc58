# SPDX-License-Identifier: BSD-3-Clause
"""Tests that texts of the library have a decimal point even if the locale uses a comma."""

import os
import shutil
import subprocess
import sys
import tempfile
import unittest

COMMA = """LC_NUMERIC
decimal_point ","
thousands_sep ""
grouping -1
END LC_NUMERIC
"""

# The character maps of localedef are in the package locales, which may be missing.
ASCII = "\n".join(["<code_set_name> ANSI_X3.4-1968", "<mb_cur_min> 1", "<mb_cur_max> 1", "CHARMAP"]
                  + [f"<U{c:04X}> \\x{c:02x} <c{c}>" for c in range(128)] + ["END CHARMAP", ""])

PROGRAM = """
import locale
import os
import baum
locale.setlocale(locale.LC_NUMERIC, "comma")
assert locale.localeconv()["decimal_point"] == ","
def make():
    file = os.path.join(os.environ["LOCPATH"], "a.study")
    made = baum.study(baum.catalog.build("pendulum"), 0, 0.5, samples=5, repeats=1, file=file)
    made.add("rk8", step=0.0125)
    return made.add("rk4", formulation="baumgarte", gains=baum.fixed(1.5, 2.5), step=0.0125).run()

study = make()
# the values come from the file
assert [entry.cpu for entry in make().entries] == [entry.cpu for entry in study.entries]
texts = [entry.name for entry in study.entries] + [study.error_text, study.reference.text]
texts += [study.recommend(1e-3).why, study.report("csv"), study.report("json"), study.report("text")]
try:
    baum.study(baum.catalog.build("pendulum"), 0.5, 0.5)
except baum.Error as error:
    texts.append(str(error))
print("\\n".join(texts))
"""


@unittest.skipUnless(shutil.which("localedef"), "localedef, which makes the locale, is missing")
class Commas(unittest.TestCase):
    def test_no_number_has_one(self):
        with tempfile.TemporaryDirectory() as folder:
            source, charmap = os.path.join(folder, "source"), os.path.join(folder, "charmap")
            for path, text in (source, COMMA), (charmap, ASCII):
                with open(path, "w", encoding="ascii") as file:
                    file.write(text)
            made = os.path.join(folder, "comma")
            subprocess.run(["localedef", "-c", "-i", source, "-f", charmap, made],
                           capture_output=True)  # it warns about missing categories
            if not os.path.exists(os.path.join(made, "LC_NUMERIC")):
                self.skipTest("localedef makes no locale with a decimal comma here")
            done = subprocess.run([sys.executable, "-c", PROGRAM], capture_output=True, text=True,
                                  env=dict(os.environ, LOCPATH=folder))
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("rk8 projection, step 0.0125 s", done.stdout)
        self.assertIn("alpha 1.5 beta 2.5 1/s", done.stdout)
        self.assertIn("t0 is 0.5 s", done.stdout)
        self.assertNotRegex(done.stdout.replace('",', ' '), r"[ (]\d+,\d+( |$)")


if __name__ == "__main__":
    unittest.main()
