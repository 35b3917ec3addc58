# SPDX-License-Identifier: BSD-3-Clause
"""Finds a C compiler for tests that need one. Also gives the folder of the project."""

import os
import shutil
import subprocess
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
CC = next(
    (
        path
        for path in map(shutil.which, (os.environ.get("CC", "cc"), "cc", "gcc", "clang"))
        if path
    ),
    None,
)


class Folder(tempfile.TemporaryDirectory):
    """A folder in which a test can compile C. It is removed at the end of the test."""

    def _compile(self, source, name, *flags):
        path, output = Path(self.name) / "source.c", Path(self.name) / name
        path.write_text(source, encoding="utf-8")
        subprocess.run(
            [CC, "-std=c11", f"-I{ROOT / 'include'}", *flags, str(path), "-o", str(output)],
            check=True,
        )
        return str(output)

    def program(self, source):
        """Compile a program and return its path."""
        return self._compile(source, "program")

    def shared_object(self, source, name="libtest.so"):
        """Compile a shared library and return its path."""
        return self._compile(source, name, "-shared", "-fPIC")
