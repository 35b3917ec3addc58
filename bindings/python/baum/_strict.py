# SPDX-License-Identifier: BSD-3-Clause
"""Refuse assignments to attributes that do not exist. Python would accept them silently, and they
would have no effect."""

from __future__ import annotations

import functools
from typing import TYPE_CHECKING, Any, ClassVar

from ._values import there_are

PACKAGE = __name__.partition(".")[0]


class Strict:
    """Base class of objects whose public attributes can be set only if their class declares them,
    by an annotation or as a property with a setter. Names that begin with "_" are free, and so are
    all names in classes that users derive."""

    _advice: ClassVar[str] = ""  # what to do instead of setting an attribute

    if not TYPE_CHECKING:  # type checkers would otherwise accept every assignment

        def __setattr__(self, name: str, value: Any) -> None:
            if not name.startswith("_") and name not in _declared(type(self)):
                if type(self).__module__.partition(".")[0] == PACKAGE:
                    raise AttributeError(self._refusal(name))
            super().__setattr__(name, value)

    def _refusal(self, name: str) -> str:
        """Return the message for an attribute that cannot be set."""
        known = sorted(properties(type(self)))
        listed = f"; {there_are(known, name)}" if known else ""
        what = f"a {type(self).__name__} has no attribute {name!r} that can be set"
        return f"{what}{listed}{self._advice and '; '}{self._advice}"


def properties(cls: type) -> frozenset[str]:
    """Return the names of the properties with setters."""
    found = ((name, getattr(cls, name)) for name in dir(cls))
    return frozenset(name for name, p in found if isinstance(p, property) and p.fset)


@functools.lru_cache(None)
def _declared(cls: type) -> frozenset[str]:
    return properties(cls).union(*(getattr(base, "__annotations__", ()) for base in cls.__mro__))
