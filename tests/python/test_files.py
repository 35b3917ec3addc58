# SPDX-License-Identifier: BSD-3-Clause
"""Tests that a file that cannot be written completely leaves the old file, and no other files."""

import csv
import io
import os
import tempfile
import unittest
from pathlib import Path

try:
    import resource
except ImportError:  # Windows
    resource = None

import baum
from baum import _files
from baum.__main__ import _write_csv

NAME = "arm, left ω"  # a comma separates the columns of a CSV file


def arm():
    m = baum.Mechanism()
    m.planar_body(NAME, mass=1, inertia=0.1, position=(0.3, 0))
    m.revolute("pin", "ground", NAME, point=(0, 0))
    return m


def swept(path, masses=(1, 2, 3)):
    given = dict(step=0.01, record="pin.angle", file=path)
    return baum.sweep(arm(), {f"{NAME}.mass": masses}, [0, 0.1], "rk4", **given)


class FilesTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="file ä ")
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def writers(self):
        """Return functions that write a file, by the name of the file."""
        run = arm().freeze().simulate([0, 0.1], "rk4", step=0.01)
        return {
            "a.json": arm().save,
            "a.svg": arm().draw().save,
            "a.html": run.page,
            "a.csv": lambda path: _write_csv(run, path),
            "a.fmu": lambda path: arm().export_fmu(path, "rk4", step=0.01, outputs=["energy"]),
            "a.sweep": swept,
        }

    @unittest.skipUnless(resource, "the system cannot limit the size of files")
    def test_a_full_disk_leaves_the_old_file(self):
        """A limit on the size of files simulates the full disk."""
        before = resource.getrlimit(resource.RLIMIT_FSIZE)
        for name, write in self.writers().items():
            path = self.folder / name
            write(path)  # a sweep refuses an existing file that no sweep has written
            old = path.read_bytes()
            resource.setrlimit(resource.RLIMIT_FSIZE, (100, before[1]))
            try:
                with self.subTest(name), self.assertRaises(OSError) as caught:
                    write(path)
            finally:
                resource.setrlimit(resource.RLIMIT_FSIZE, before)
            self.assertEqual(caught.exception.filename, str(path))
            self.assertEqual(path.read_bytes(), old)
            self.assertEqual([one.name for one in self.folder.iterdir()], [name])
            path.unlink()

    def test_modes_and_links_are_kept(self):
        path, link = self.folder / "a.json", self.folder / "link"
        path.write_text("old")
        path.chmod(0o640)
        _files.write(path, "new ω")
        self.assertEqual(path.read_bytes(), "new ω".encode())
        if os.name == "posix":
            self.assertEqual(path.stat().st_mode & 0o777, 0o640)
            link.symlink_to(path)
            _files.write(link, b"newer")
            self.assertTrue(link.is_symlink())
            self.assertEqual(path.read_text(), "newer")
        with self.assertRaises(OSError):
            _files.write(self.folder, "x")
        if os.path.exists("/dev/full"):
            with self.assertRaisesRegex(OSError, "'/dev/full'"):
                _files.write("/dev/full", "x")
        with self.assertRaises(FileNotFoundError) as caught:
            _files.write(self.folder / "no" / "a.json", "x")
        self.assertTrue(caught.exception.filename.endswith("a.json"))

    @unittest.skipUnless(os.name == "posix", "the system has no such permissions")
    def test_a_private_file_is_private_while_it_is_written(self):
        path = self.folder / "a.json"
        path.touch(0o600)
        with _files.part(path) as part:
            self.assertEqual(part.stat().st_mode & 0o777, 0o600)

    def test_messages_do_not_name_the_part(self):
        path = self.folder / "no" / "a.gif"
        with self.assertRaises(FileNotFoundError) as caught, _files.part(path):
            self.fail("there is no such folder")
        self.assertEqual(caught.exception.filename, str(path))

    def test_names_with_commas_stay_in_one_column(self):
        run = arm().freeze().simulate([0, 0.1], "rk4", step=0.01, record=f"{NAME}.pose")
        _write_csv(run, self.folder / "a.csv")
        text = (self.folder / "a.csv").read_text(encoding="utf-8")
        rows = list(csv.reader(io.StringIO(text)))
        self.assertEqual(rows[0], list(run.to_dict()))
        self.assertEqual([float(x) for x in rows[-1]], [x[-1] for x in run.to_dict().values()])

    def test_a_damaged_sweep_file_is_refused(self):
        path = self.folder / "a.sweep"
        first = swept(path)
        whole = path.read_bytes()
        for wrong in (b"", b"x", whole[:100], whole[:-1], whole[:-20] + b"\1" + whole[-19:]):
            path.write_bytes(wrong)
            with self.assertRaisesRegex(ValueError, "a.sweep: this is not the file of a sweep, or it is damaged"):
                swept(path)
            self.assertEqual(path.read_bytes(), wrong)
        path.write_bytes(whole)
        self.assertEqual(swept(path)["pin.angle"].tolist(), first["pin.angle"].tolist())


if __name__ == "__main__":
    unittest.main()
