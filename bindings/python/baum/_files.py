# SPDX-License-Identifier: BSD-3-Clause
"""Writes whole files, as the library does: a new file replaces the old one when it is complete."""

from __future__ import annotations

import contextlib
import os
import secrets
import shutil
import stat
from pathlib import Path
from typing import Iterator


def _is_replaceable(path: Path) -> bool:
    """Tell whether a new file can take the place of this one. Other paths, such as devices, links
    and files that must not be written, are opened as they are."""
    try:
        found = path.lstat()
    except OSError:
        return True  # there is no file yet
    is_own = not hasattr(os, "geteuid") or found.st_uid == os.geteuid()
    is_single = stat.S_ISREG(found.st_mode) and found.st_nlink == 1
    return is_single and is_own and os.access(path, os.W_OK)


@contextlib.contextmanager
def part(path: str | os.PathLike[str]) -> Iterator[Path]:
    """Give the path of a new file, which replaces the file `path` when the block ends. If the block
    raises an exception, the new file is deleted, and the old file stays."""
    place = Path(path)
    if not _is_replaceable(place):
        yield place
        return
    new = place.with_name(f".baum-{secrets.token_hex(8)}.part{place.suffix}")
    try:
        yield new
        with open(new, "rb+") as file:
            os.fsync(file.fileno())
        if place.exists():
            shutil.copymode(place, new)
        os.replace(new, place)
    finally:
        new.unlink(missing_ok=True)


def write(path: str | os.PathLike[str], contents: str | bytes) -> None:
    """Write a file. If this fails or is interrupted, the old file stays. Texts are in UTF-8."""
    data = contents.encode() if isinstance(contents, str) else contents
    try:
        with part(path) as file:
            file.write_bytes(data)
    except OSError as error:  # it names the part, or no file
        raise OSError(error.errno, error.strerror, os.fspath(path)) from None
