# SPDX-License-Identifier: BSD-3-Clause
"""Named mechanisms whose motion is known.

    from baum import catalog

    for entry in catalog.entries():
        print(entry.name, "-", entry.title)
    m = catalog.build("n_four_bar", windows=3)
    known = catalog.reference("n_four_bar", windows=3)
    run = m.simulate(known.t, "rk8", rtol=1e-8)
    print(catalog.compare(run, "n_four_bar", windows=3).q)

Parameters left out have their defaults; data, times and states are in SI units. A reference that holds
for the defaults alone is refused for others. docs/mechanisms.md lists them all.
"""

import ctypes
from collections import namedtuple

import numpy as np

from . import _abi, _calls, _lib
from ._values import address, number, vector
from .mechanism import Mechanism
from .run import Run

_library = _lib.open_catalog()

Parameter = namedtuple("Parameter", [name for name, _ in _abi.baum_catalog_parameter._fields_[1:]])
Parameter.__doc__ = """A number that a mechanism depends on; see baum_catalog_parameter."""

Entry = namedtuple("Entry", [name for name, _ in _abi.baum_catalog_entry._fields_[1:]] + ["parameters"])
Entry.__doc__ = """A mechanism of the catalogue; see baum_catalog_entry. parameters: a dict of Parameter."""

Reference = namedtuple("Reference", "t q v")
Reference.__doc__ = """Samples of a motion that is known: t (n), q (n x nq), v (n x nv)."""

Error = namedtuple("Error", [name for name, _ in _abi.baum_catalog_error._fields_[1:]])
Error.__doc__ = """How far a run is from the reference; see baum_catalog_error."""


def _values(struct):
    """The fields of a struct but its size, texts as strings."""
    values = [getattr(struct, name) for name, _ in struct._fields_[1:]]
    return [value.decode() if isinstance(value, bytes) else value for value in values]


def _read(struct, function, *arguments):
    _calls.make(function, *arguments, ctypes.byref(struct), ctypes.sizeof(struct))
    return _values(struct)


def entry(name):
    """The entry of that name."""
    values = _read(_abi.baum_catalog_entry(), _library.baum_catalog_find, str(name).encode())
    found = Entry(*values, {})
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


def entries():
    """All of them."""
    names = [
        _read(_abi.baum_catalog_entry(), _library.baum_catalog_entry_at, k)[0]
        for k in range(_library.baum_catalog_count())
    ]
    return [entry(name) for name in names]


def _choice(name, parameters):
    settings = (_abi.baum_catalog_setting * len(parameters))(
        *(
            (key.encode(), number(value, f"catalogue: {key}"))
            for key, value in parameters.items()
        )
    )
    return _abi.baum_catalog_choice(str(name).encode(), settings, len(parameters))


def build(name, **parameters):
    """A frozen mechanism."""
    out = ctypes.c_void_p()
    choice = _choice(name, parameters)
    _calls.make(_library.baum_catalog_build, ctypes.byref(choice), ctypes.byref(out))
    return Mechanism.of_library(out.value)


def times(name):
    """Times [s] of the samples of the reference."""
    values = np.empty(max(1, entry(name).sample_count))
    _calls.make(_library.baum_catalog_times, str(name).encode(), address(values))
    return values


def reference(name, t=None, **parameters):
    """The motion at times t [s], which are those of the samples unless the reference is exact. Default:
    all samples."""
    t = times(name) if t is None else vector(np.atleast_1d(t), None, "t")
    nq, nv, _ = build(name, **parameters).sizes
    choice = _choice(name, parameters)
    q, v = np.empty((len(t), nq)), np.empty((len(t), nv))
    for k in range(len(t)):
        _calls.make(
            _library.baum_catalog_reference, ctypes.byref(choice), t[k], address(q[k]), address(v[k])
        )
    return Reference(t, q, v)


def compare(run, name, **parameters):
    """How far a Run of the mechanism, or (t, q, v) of it, is from the reference."""
    t, q, v = (run.t, run.q, run.v) if isinstance(run, Run) else run
    mechanism = run.mechanism if isinstance(run, Run) else build(name, **parameters)
    nq, nv, _ = mechanism.sizes
    t = vector(np.atleast_1d(t), None, "t")
    q = vector(np.ravel(q), len(t) * nq, "q")
    v = None if v is None else vector(np.ravel(v), len(t) * nv, "v")
    choice = _choice(name, parameters)
    return Error(
        *_read(
            _abi.baum_catalog_error(),
            _library.baum_catalog_compare,
            ctypes.byref(choice),
            mechanism.handle,
            address(t),
            len(t),
            address(q),
            address(v),
        )
    )
