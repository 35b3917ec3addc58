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


def _permissions(path: Path) -> int | None:
    """Return the permissions of a new file that takes the place of this one. Return None if no file
    can take its place. Such paths, for example devices, links and files that must not be written,
    are opened as they are."""
    try:
        found = path.lstat()
    except OSError:
        return 0o666  # there is no file yet
    is_own = not hasattr(os, "geteuid") or found.st_uid == os.geteuid()
    is_single = stat.S_ISREG(found.st_mode) and found.st_nlink == 1
    is_replaceable = is_single and is_own and os.access(path, os.W_OK)
    return stat.S_IMODE(found.st_mode) if is_replaceable else None


@contextlib.contextmanager
def part(path: str | os.PathLike[str]) -> Iterator[Path]:
    """Give the path of a new file, which replaces the file `path` when the block ends. If the block
    raises an exception, the new file is deleted, and the old file stays."""
    place = Path(path)
    permissions = _permissions(place)
    if permissions is None:
        yield place
        return
    new = place.with_name(f".baum-{secrets.token_hex(8)}.part{place.suffix}")
    try:
        # Only users who may read the old file may read the new one, while it is written, too.
        new.touch(permissions | stat.S_IRUSR | stat.S_IWUSR, exist_ok=False)
    except OSError as error:  # it names the part
        raise OSError(error.errno, error.strerror, os.fspath(path)) from None
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
