# SPDX-License-Identifier: BSD-3-Clause
"""Tests how the library is found, and that a library of another version is refused."""

import ctypes
import os
import subprocess
import sys
import unittest

import baum
from baum import _abi, _lib, library_version
from compiler import CC, Folder

STAND_IN = """
const char *baum_version(void);
const char *baum_version(void) {{ return "{version}"; }}
"""


def import_with(library):
    """Import baum in a new interpreter with BAUM_LIBRARY set, and return what the interpreter
    writes to standard error."""
    environment = {**os.environ, "BAUM_LIBRARY": library}
    done = subprocess.run(
        [sys.executable, "-c", "import baum"], env=environment, capture_output=True, text=True
    )
    return done.stderr


class Library(unittest.TestCase):
    def test_versions_agree(self):
        self.assertEqual(baum.__version__, _abi.VERSION)
        self.assertEqual(library_version.split(".")[:2], baum.__version__.split(".")[:2])

    def test_has_tells_what_is_built_in(self):
        self.assertIn(baum.has("sundials"), (True, False))
        self.assertFalse(baum.has("magic"))

    def test_a_missing_library_is_an_import_error_that_names_it(self):
        said = import_with("/nowhere/libbaum.so")
        self.assertIn("ImportError: baum: the C library could not be loaded", said)
        self.assertIn("/nowhere/libbaum.so", said)
        self.assertIn("BAUM_LIBRARY", said)

    @unittest.skipUnless(CC, "no C compiler")
    def test_another_version_is_refused_with_both_versions(self):
        folder = Folder()
        self.addCleanup(folder.cleanup)
        said = import_with(folder.shared_object(STAND_IN.format(version="7.3.1")))
        self.assertIn("ImportError: baum: the library", said)
        self.assertIn("has version 7.3.1", said)
        self.assertIn(f"has version {_abi.VERSION}", said)

    @unittest.skipUnless(CC, "no C compiler")
    def test_another_library_is_refused(self):
        folder = Folder()
        self.addCleanup(folder.cleanup)
        self.assertIn("is not the library baum", import_with(folder.shared_object("int other;\n")))
        partly = folder.shared_object(STAND_IN.format(version=_abi.VERSION), "libpartly.so")
        self.assertIn("has no function baum_", import_with(partly))

    def test_structs_that_have_grown_are_accepted(self):
        class Library:
            def __init__(self, more):
                self.more = more

            def __getattr__(self, name):
                def init(place, room):
                    place.contents.struct_size = ctypes.sizeof(place.contents) + self.more

                return init

        _lib._check_structs(Library(0), "same")
        _lib._check_structs(Library(8), "newer")
        with self.assertRaisesRegex(ImportError, "bytes in the library older"):
            _lib._check_structs(Library(-8), "older")

    @unittest.skipUnless(CC, "no C compiler")
    def test_a_struct_that_is_smaller_is_refused(self):
        source = STAND_IN.format(version=_abi.VERSION)
        source += "#include <stddef.h>\n"
        for name in _abi.PROTOTYPES:
            if name.endswith("_init"):
                declaration = f"void {name}(void *d, size_t n)"
                source += f"{declaration};\n{declaration} {{ *(size_t *)d = n / n; }}\n"
            elif name != "baum_version":
                source += f"extern int {name};\nint {name};\n"
        folder = Folder()
        self.addCleanup(folder.cleanup)
        said = import_with(folder.shared_object(source))
        self.assertRegex(said, "ImportError: baum: baum_coordinates_def has 1 bytes in the library")


if __name__ == "__main__":
    unittest.main()
