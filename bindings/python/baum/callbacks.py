# SPDX-License-Identifier: BSD-3-Clause
"""Wrap functions of the user so that the library can call them.

A Python function receives arguments such as (t, q), (t, q, v) or a point, and returns its result.
This module wraps such a function in another one, called the shell, which has the signature that the
library expects. The shell passes q and v as read-only arrays, which are valid only during the call.
It checks the returned value and writes it to the memory of the library. If the function raises an
exception, the shell stores the exception and stops the present call of the library. The exception
is raised when this call has returned. A force function whose definition names inputs receives their
present values after v, as floats.

Instead of a Python function, the user may give the address of a compiled function: an int, a ctypes
function pointer, or an object with an integer attribute `address`, such as Numba's cfunc. The
library calls a compiled function directly. A compiled force function receives all inputs of the
mechanism, in the order in which they were added.
"""

from __future__ import annotations

import ctypes
from _ctypes import CFuncPtr
from typing import Any, Callable, Sequence

import numpy as np

from . import _abi, _calls
from ._lib import lib
from .errors import Retry, Status
from .typing import Array

FINE, RETRY, STOP = 0, 1, -1  # what a shell returns to the library
CACHED = 64  # largest number of arrays that share memory with the library, for each argument
NUMERIC = "fiub"
DOUBLE = np.dtype(np.float64)

Function = Callable[..., Any]
Shape = tuple[int, ...]
Shell = Callable[..., Any]
Write = Callable[[int, Any], None]


class _Views(dict[int, Array]):
    """Arrays that share memory with the library, one for each address. Creating an array is
    expensive. The library uses few addresses, so each array is stored and reused for its
    address."""

    def __init__(self, shape: Shape, writeable: bool) -> None:
        super().__init__()
        self._shape = shape
        self._type = ctypes.c_double * int(np.prod(shape))
        self._writeable = writeable

    def __missing__(self, address: int) -> Array:
        if len(self) >= CACHED:
            self.clear()
        memory: Any = self._type.from_address(address)
        view: Array = np.frombuffer(memory).reshape(self._shape)
        view.flags.writeable = self._writeable
        self[address] = view
        return view


def _without_ones(shape: Shape) -> Shape:
    return tuple(size for size in shape if size != 1)


def _checked(value: Any, shape: Shape, label: str) -> Array:
    """Convert a returned value to an array of the given shape. Dimensions of length 1 may be
    missing. Raise TypeError or ValueError for other values."""
    wanted = _without_ones(shape)
    asked = "a number" if not wanted else f"an array of shape {shape}"
    try:
        array = np.asarray(value)
    except ValueError:
        raise ValueError(f"{label} must return {asked}, not {value!r}") from None
    if array.dtype.kind not in NUMERIC:
        raise TypeError(f"{label} must return {asked}, not {value!r}")
    if _without_ones(array.shape) != wanted:
        raise ValueError(f"{label} must return {asked}, not one of shape {array.shape}")
    return array.reshape(shape)


def _writer(shape: Shape, label: str) -> Write:
    """Return a function write(address, value), which writes a value into memory. It has a fast path
    for values of the right type."""
    views = _Views(shape, writeable=True)
    single = int(np.prod(shape)) == 1
    first = (0,) * len(shape)

    def write(address: int, value: Any) -> None:
        if single and isinstance(value, float):
            views[address][first] = value
        elif type(value) is np.ndarray and value.shape == shape and value.dtype is DOUBLE:
            views[address][...] = value
        else:
            views[address][...] = _checked(value, shape, label)

    return write


def _shell_q(function: Function, write: Write, nq: int, nv: int) -> Shell:
    q_at = _Views((nq,), writeable=False)

    def shell(t: float, q: int, out: int, user: Any) -> int:
        try:
            write(out, function(t, q_at[q]))
            return FINE
        except BaseException as error:
            return _answer(error)

    return shell


def _shell_qv(function: Function, write: Write, nq: int, nv: int) -> Shell:
    q_at, v_at = _Views((nq,), writeable=False), _Views((nv,), writeable=False)

    def shell(t: float, q: int, v: int, out: int, user: Any) -> int:
        try:
            write(out, function(t, q_at[q], v_at[v]))
            return FINE
        except BaseException as error:
            return _answer(error)

    return shell


def _shell_force(function: Function, write: Write, nq: int, nv: int) -> Shell:
    q_at, v_at = _Views((nq,), writeable=False), _Views((nv,), writeable=False)

    def shell(t: float, q: int, v: int, inputs: int, out: int, user: Any) -> int:
        try:
            write(out, function(t, q_at[q], v_at[v]))
            return FINE
        except BaseException as error:
            return _answer(error)

    return shell


def _shell_force_of(inputs: Sequence[int]) -> Callable[..., Shell]:
    """Return a function that makes the shell of a force function. The force function receives the
    given inputs after v."""

    def make(function: Function, write: Write, nq: int, nv: int) -> Shell:
        q_at, v_at = _Views((nq,), writeable=False), _Views((nv,), writeable=False)
        # The view ends with the last input that the function needs. Its length does not depend on
        # the number of all inputs, because a copy of the mechanism may have more inputs.
        inputs_at = _Views((1 + max(inputs),), writeable=False)

        def shell(t: float, q: int, v: int, given: int, out: int, user: Any) -> int:
            try:
                values = inputs_at[given].tolist()
                write(out, function(t, q_at[q], v_at[v], *[values[k] for k in inputs]))
                return FINE
            except BaseException as error:
                return _answer(error)

        return shell

    return make


def _shell_law(function: Function, write: Write, nq: int, nv: int) -> Shell:
    def shell(x: float, out: int, user: Any) -> int:
        try:
            write(out, function(x))
            return FINE
        except BaseException as error:
            return _answer(error)

    return shell


def _shell_spring(function: Function, write: Write, nq: int, nv: int) -> Shell:
    def shell(length: float, rate: float, out: int, user: Any) -> int:
        try:
            write(out, function(length, rate))
            return FINE
        except BaseException as error:
            return _answer(error)

    return shell


def _shell_curve(function: Function, write: Write, nq: int, nv: int) -> Shell:
    # nq is the number of coordinates of the point, 2 or 3.
    point_at = _Views((nq,), writeable=False)

    def shell(point: int, out: int, user: Any) -> int:
        try:
            write(out, function(point_at[point]))
            return FINE
        except BaseException as error:
            return _answer(error)

    return shell


def _shell_rate(function: Function, write: Write, nq: int, nv: int) -> Shell:
    q_at, v_at = _Views((nq,), writeable=False), _Views((nv,), writeable=False)

    def shell(q: int, v: int, dq: int, user: Any) -> None:
        try:
            write(dq, function(q_at[q], v_at[v]))
        except BaseException as error:
            _answer_nan(error, dq, nq)

    return shell


def _shell_move(function: Function, write: Write, nq: int, nv: int) -> Shell:
    q_at, v_at = _Views((nq,), writeable=False), _Views((nv,), writeable=False)

    def shell(h: float, v: int, q: int, user: Any) -> None:
        try:
            write(q, function(h, v_at[v], q_at[q]))
        except BaseException as error:
            _answer_nan(error, q, nq)

    return shell


def _shell_difference(function: Function, write: Write, nq: int, nv: int) -> Shell:
    q_at = _Views((nq,), writeable=False)

    def shell(start: int, end: int, dx: int, user: Any) -> None:
        try:
            write(dx, function(q_at[start], q_at[end]))
        except BaseException as error:
            _answer_nan(error, dx, nv)

    return shell


def _shell_normalize(function: Function, write: Write, nq: int, nv: int) -> Shell:
    q_at = _Views((nq,), writeable=False)

    def shell(q: int, user: Any) -> None:
        try:
            write(q, function(q_at[q]))
        except BaseException as error:
            _answer_nan(error, q, nq)

    return shell


def _answer_nan(error: BaseException, out: int, count: int) -> None:
    """Report an exception of a function that returns no status. The result of the function becomes
    NaN, which stops the present call of the library."""
    _calls.raise_later(error)
    numbers = ctypes.cast(out, ctypes.POINTER(ctypes.c_double))
    for k in range(count):
        numbers[k] = np.nan


def _answer(error: BaseException) -> int:
    """Store an exception, and return the status that tells the library about it."""
    asks_again = isinstance(error, Retry)
    _calls.raise_later(None if asks_again else error)
    lib.baum_fail(Status.ERR_CALLBACK, repr(error).encode(errors="replace"))
    return RETRY if asks_again else STOP


SHELLS: dict[Any, Callable[..., Shell]] = {
    _abi.baum_q_fn: _shell_q,
    _abi.baum_qv_fn: _shell_qv,
    _abi.baum_force_fn: _shell_force,
    _abi.baum_law_fn: _shell_law,  # of a driver, or of a coupling
    _abi.baum_spring_fn: _shell_spring,
    _abi.baum_curve_fn: _shell_curve,
    _abi.baum_rate_fn: _shell_rate,
    _abi.baum_move_fn: _shell_move,
    _abi.baum_normalize_fn: _shell_normalize,
}

# ctypes has only one type for all functions with the same signature. If functions of the same type
# need different shells, the name of the field selects the shell.
SHELLS_BY_FIELD: dict[str, Callable[..., Shell]] = {"difference": _shell_difference}


# No operating system places functions in the first page of the memory. A smaller number is not the
# address of a function, but for example a constant force.
LOWEST_ADDRESS = 4096


def address_of(function: Any) -> int | None:
    """Return the address of a compiled function, or None for a Python function."""
    if isinstance(function, int) and not isinstance(function, bool):
        return function
    if isinstance(function, CFuncPtr):
        return ctypes.cast(function, ctypes.c_void_p).value
    address = getattr(function, "address", None)
    return address if isinstance(address, int) else None


def wrap(
    kind: Any,
    field: str,
    function: Any,
    label: str,
    shape: Shape,
    nq: int = 0,
    nv: int = 0,
    inputs: Sequence[int] = (),
) -> Any:
    """Make a function pointer of type `kind` for a Python function or for the address of a compiled
    one. The caller writes the pointer to the field of a definition, and keeps it alive.

    label: name of the function in messages.
    shape: shape of the result of the function.
    nq, nv: lengths of q and v.
    inputs: indices of the inputs that a force function receives.
    """
    address = address_of(function)
    if address is not None and address >= LOWEST_ADDRESS:
        return kind(address)
    if not callable(function) or address is not None:
        raise TypeError(f"{label}: a function or the address of one is wanted, not {function!r}")
    takes_inputs = inputs and kind is _abi.baum_force_fn
    usual = _shell_force_of(inputs) if takes_inputs else SHELLS[kind]
    make = SHELLS_BY_FIELD.get(field, usual)
    return kind(make(function, _writer(shape, label), nq, nv))


def event_function(function: Function, nq: int, nv: int) -> Any:
    """Make a function pointer for the function(t, q, v) of an event."""
    shell = _shell_force(function, _writer((1,), "the function of an event"), nq, nv)
    return _abi.baum_force_fn(shell)
