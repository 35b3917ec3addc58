# SPDX-License-Identifier: BSD-3-Clause
"""A catalogue of mechanisms whose motion is known.

    from baum import catalog

    for entry in catalog.entries():
        print(entry.name, "-", entry.title)
    m = catalog.build("n_four_bar", windows=3)
    known = catalog.reference("n_four_bar", windows=3)
    run = m.simulate(known.t, "rk8", rtol=1e-8)
    print(catalog.compare(run, "n_four_bar", windows=3).q)

Keyword arguments set the parameters of a mechanism; the other parameters have their defaults. Data,
times and states are in SI units. A reference is the known motion of a mechanism. Some references
exist only for the default parameters. baum.Error is raised if you ask for such a reference with
other parameters, or if a name or a parameter is unknown. The page docs/mechanisms.md lists all
mechanisms.
"""

from __future__ import annotations

import ctypes
from typing import Any, NamedTuple, Union

import numpy as np

from . import _abi, _calls, _lib
from ._records import CatalogEntry as Entry
from ._records import CatalogError as Error
from ._records import CatalogParameter as Parameter
from ._values import address, number, vector
from .mechanism import Mechanism
from .run import Run
from .typing import Array, ArrayLike, Scalar

_library = _lib.open_catalog()


class Reference(NamedTuple):
    """Samples of a known motion: t (n) [s], q (n x nq), v (n x nv)."""

    t: Array
    q: Array
    v: Array


def _values(struct: Any) -> list[Any]:
    """Return the fields of a struct except its size, with texts as strings."""
    values = [getattr(struct, field[0]) for field in struct._fields_[1:]]
    return [value.decode() if isinstance(value, bytes) else value for value in values]


def _read(struct: Any, function: Any, *arguments: Any) -> list[Any]:
    _calls.make(function, *arguments, ctypes.byref(struct), ctypes.sizeof(struct))
    return _values(struct)


def entry(name: str) -> Entry:
    """Return the entry of that name: a named tuple. Its fields name, title, source and note are
    texts, and provenance is a text about how the reference was computed and checked. The field
    parameters is a dict that gives the unit, meaning and default value of each parameter. The
    reference has sample_count samples from start_time to end_time [s]. digits_q and digits_v are
    the numbers of correct digits of the positions and velocities of the reference. The field exact
    is True if the reference consists of formulas. The field smooth is True if the motion with the
    default parameters passes through no singular configuration."""
    values = _read(_abi.baum_catalog_entry(), _library.baum_catalog_find, str(name).encode())
    found = Entry._make([*values, {}])
    for k in range(found.parameter_count):
        parameter = Parameter(
            *_read(
                _abi.baum_catalog_parameter(),
                _library.baum_catalog_parameter_at,
                found.name.encode(),
                k,
            )
        )
        found.parameters[parameter.name] = parameter
    return found


def entries() -> list[Entry]:
    """Return all entries of the catalogue."""
    names = [
        _read(_abi.baum_catalog_entry(), _library.baum_catalog_entry_at, k)[0]
        for k in range(_library.baum_catalog_count())
    ]
    return [entry(name) for name in names]


def _choice(name: str, parameters: dict[str, Scalar]) -> ctypes.Structure:
    settings = (_abi.baum_catalog_setting * len(parameters))(
        *(
            _abi.baum_catalog_setting(key.encode(), number(value, f"catalogue: {key}"))
            for key, value in parameters.items()
        )
    )
    return _abi.baum_catalog_choice(str(name).encode(), settings, len(parameters))


def build(name: str, **parameters: Scalar) -> Mechanism:
    """Build the mechanism of that name with these parameters. The result is frozen."""
    out = ctypes.c_void_p()
    choice = _choice(name, parameters)
    _calls.make(_library.baum_catalog_build, ctypes.byref(choice), ctypes.byref(out))
    return Mechanism.of_library(out.value)


def times(name: str) -> Array:
    """Return the times (n) [s] of the samples of the reference."""
    values: Array = np.empty(max(1, entry(name).sample_count))
    _calls.make(_library.baum_catalog_times, str(name).encode(), address(values))
    return values


def reference(name: str, t: ArrayLike | None = None, **parameters: Scalar) -> Reference:
    """Return the known motion at the times t (n) [s], by default at the times that times() returns.
    Times that times() does not return are allowed only if the reference consists of formulas."""
    at = times(name) if t is None else vector(np.atleast_1d(t), None, "t")
    nq, nv, _ = build(name, **parameters).sizes
    choice = ctypes.byref(_choice(name, parameters))
    q, v = np.empty((len(at), nq)), np.empty((len(at), nv))
    for k in range(len(at)):
        places = address(q[k]), address(v[k])
        _calls.make(_library.baum_catalog_reference, choice, at[k], *places)
    return Reference(at, q, v)


def compare(
    run: Union[Run, tuple[ArrayLike, ArrayLike, Union[ArrayLike, None]]],
    name: str,
    **parameters: Scalar,
) -> Error:
    """Compute the errors of a motion against the reference. The motion is a Run of the mechanism,
    or a tuple (t, q, v), where v may be None.

    Returns a named tuple. q and v are the largest errors of positions and velocities, and q_time
    and v_time are the times [s] at which they occur. q_final and v_final are the errors at the last
    time. q_floor and v_floor are the uncertainties of the reference.
    """
    t, q, v = (run.t, run.q, run.v) if isinstance(run, Run) else run
    known = run.mechanism if isinstance(run, Run) else None
    mechanism = build(name, **parameters) if known is None else known
    nq, nv, _ = mechanism.sizes
    at = vector(np.atleast_1d(t), None, "t")
    positions = vector(np.ravel(q), len(at) * nq, "q")
    velocities = None if v is None else vector(np.ravel(v), len(at) * nv, "v")
    values = _read(
        _abi.baum_catalog_error(),
        _library.baum_catalog_compare,
        ctypes.byref(_choice(name, parameters)),
        mechanism.handle,
        address(at),
        len(at),
        address(positions),
        address(velocities),
    )
    return Error(*values)
