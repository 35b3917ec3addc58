# SPDX-License-Identifier: BSD-3-Clause
"""Writes whole files, as the library does: a new file replaces the old one when it is complete."""

from __future__ import annotations

import os
import secrets
import shutil
import stat
from pathlib import Path


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


def _replace(path: Path, data: bytes) -> None:
    part = path.with_name(f".baum-{secrets.token_hex(8)}.part")
    try:
        with open(part, "xb") as file:
            file.write(data)
            file.flush()
            os.fsync(file.fileno())
        if path.exists():
            shutil.copymode(path, part)
        os.replace(part, path)
    finally:
        part.unlink(missing_ok=True)


def write(path: str | os.PathLike[str], contents: str | bytes) -> None:
    """Write a file. If this fails or is interrupted, the old file stays. Texts are in UTF-8."""
    data = contents.encode() if isinstance(contents, str) else contents
    place = Path(path)
    try:
        if _is_replaceable(place):
            _replace(place, data)
        else:
            place.write_bytes(data)
    except OSError as error:  # it names the part, or no file
        raise OSError(error.errno, error.strerror, str(place)) from None
