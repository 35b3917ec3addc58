# SPDX-License-Identifier: BSD-3-Clause
"""Functions of the user as the library wants them.

A Python function takes (t, q), (t, q, v), (t), a number or two or a point and returns its value.
Here it gets a shell that the library can call: it shows q and v as read-only arrays, checks what
comes back and writes it where it belongs, and keeps an exception until the run that it stopped is
back. q and v are only valid during the call. A force function that names inputs gets their present
values after v, as floats.

Instead of a Python function there may be the address of a compiled one (an int, a ctypes function
pointer, or an object with an integer `address`, as Numba's cfunc); it is passed on as it is and
costs nothing. A compiled force function is given all inputs of the mechanism, in the order of
adding.
"""

import ctypes

import numpy as np

from . import _abi, _calls
from ._lib import lib
from .errors import Retry, Status

FINE, RETRY, STOP = 0, 1, -1
CACHED = 64
NUMERIC = "fiub"
DOUBLE = np.dtype(np.float64)


class _Views(dict):
    """Arrays on memory of the library, by address. The library reuses few addresses, so making an
    array, which is slow, is rare. An array is only a window: one that is met again is right
    again."""

    def __init__(self, shape, writeable):
        super().__init__()
        self._shape = shape
        self._type = ctypes.c_double * int(np.prod(shape))
        self._writeable = writeable

    def __missing__(self, address):
        if len(self) >= CACHED:
            self.clear()
        view = np.frombuffer(self._type.from_address(address)).reshape(self._shape)
        view.flags.writeable = self._writeable
        self[address] = view
        return view


def _without_ones(shape):
    return tuple(size for size in shape if size != 1)


def _checked(value, shape, label):
    """A returned value as an array of that shape; sides of length 1 may be left out. Else
    TypeError, ValueError."""
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


def _writer(shape, label):
    """A function that writes a returned value to an address, quickly if it is what it should be."""
    views = _Views(shape, writeable=True)
    single = int(np.prod(shape)) == 1
    first = (0,) * len(shape)

    def write(address, value):
        if single and isinstance(value, float):
            views[address][first] = value
        elif type(value) is np.ndarray and value.shape == shape and value.dtype is DOUBLE:
            views[address][...] = value
        else:
            views[address][...] = _checked(value, shape, label)

    return write


def _shell_q(function, write, nq, nv):
    q_at = _Views((nq,), writeable=False)

    def shell(t, q, out, user):
        try:
            write(out, function(t, q_at[q]))
            return FINE
        except BaseException as error:
            return _answer(error)

    return shell


def _shell_qv(function, write, nq, nv):
    q_at, v_at = _Views((nq,), writeable=False), _Views((nv,), writeable=False)

    def shell(t, q, v, out, user):
        try:
            write(out, function(t, q_at[q], v_at[v]))
            return FINE
        except BaseException as error:
            return _answer(error)

    return shell


def _shell_force(function, write, nq, nv):
    q_at, v_at = _Views((nq,), writeable=False), _Views((nv,), writeable=False)

    def shell(t, q, v, inputs, out, user):
        try:
            write(out, function(t, q_at[q], v_at[v]))
            return FINE
        except BaseException as error:
            return _answer(error)

    return shell


def _shell_force_of(inputs):
    """A maker of shells for functions that take the inputs at these places after v."""

    def make(function, write, nq, nv):
        q_at, v_at = _Views((nq,), writeable=False), _Views((nv,), writeable=False)
        # As many as are there for certain: a copy of the mechanism may have more.
        inputs_at = _Views((1 + max(inputs),), writeable=False)

        def shell(t, q, v, given, out, user):
            try:
                values = inputs_at[given].tolist()
                write(out, function(t, q_at[q], v_at[v], *[values[k] for k in inputs]))
                return FINE
            except BaseException as error:
                return _answer(error)

        return shell

    return make


def _shell_law(function, write, nq, nv):
    def shell(t, s, user):
        try:
            write(s, function(t))
            return FINE
        except BaseException as error:
            return _answer(error)

    return shell


def _shell_coupling(function, write, nq, nv):
    def shell(x, f, user):
        try:
            write(f, function(x))
            return FINE
        except BaseException as error:
            return _answer(error)

    return shell


def _shell_spring(function, write, nq, nv):
    def shell(length, rate, out, user):
        try:
            write(out, function(length, rate))
            return FINE
        except BaseException as error:
            return _answer(error)

    return shell


def _shell_curve(function, write, nq, nv):
    xy_at = _Views((2,), writeable=False)

    def shell(xy, out, user):
        try:
            write(out, function(xy_at[xy]))
            return FINE
        except BaseException as error:
            return _answer(error)

    return shell


def _shell_rate(function, write, nq, nv):
    q_at, v_at = _Views((nq,), writeable=False), _Views((nv,), writeable=False)

    def shell(q, v, dq, user):
        try:
            write(dq, function(q_at[q], v_at[v]))
        except BaseException as error:
            _answer_nan(error, dq, nq)

    return shell


def _shell_move(function, write, nq, nv):
    q_at, v_at = _Views((nq,), writeable=False), _Views((nv,), writeable=False)

    def shell(h, v, q, user):
        try:
            write(q, function(h, v_at[v], q_at[q]))
        except BaseException as error:
            _answer_nan(error, q, nq)

    return shell


def _shell_difference(function, write, nq, nv):
    q_at = _Views((nq,), writeable=False)

    def shell(start, end, dx, user):
        try:
            write(dx, function(q_at[start], q_at[end]))
        except BaseException as error:
            _answer_nan(error, dx, nv)

    return shell


def _shell_normalize(function, write, nq, nv):
    q_at = _Views((nq,), writeable=False)

    def shell(q, user):
        try:
            write(q, function(q_at[q]))
        except BaseException as error:
            _answer_nan(error, q, nq)

    return shell


def _answer_nan(error, out, count):
    """For functions without a status: the library stops at numbers that are not finite."""
    _calls.raise_later(error)
    numbers = ctypes.cast(out, ctypes.POINTER(ctypes.c_double))
    for k in range(count):
        numbers[k] = np.nan


def _answer(error):
    """What the library is told about an exception."""
    asks_again = isinstance(error, Retry)
    _calls.raise_later(None if asks_again else error)
    lib.baum_fail(Status.ERR_CALLBACK, repr(error).encode(errors="replace"))
    return RETRY if asks_again else STOP


SHELLS = {
    _abi.baum_q_fn: _shell_q,
    _abi.baum_qv_fn: _shell_qv,
    _abi.baum_force_fn: _shell_force,
    _abi.baum_law_fn: _shell_law,
    _abi.baum_coupling_fn: _shell_coupling,
    _abi.baum_spring_fn: _shell_spring,
    _abi.baum_curve_fn: _shell_curve,
    _abi.baum_rate_fn: _shell_rate,
    _abi.baum_move_fn: _shell_move,
    _abi.baum_difference_fn: _shell_difference,
    _abi.baum_normalize_fn: _shell_normalize,
}


def address_of(function):
    """The address of a compiled function, or None for a Python function."""
    if isinstance(function, int) and not isinstance(function, bool):
        return function
    if isinstance(function, ctypes._CFuncPtr):
        return ctypes.cast(function, ctypes.c_void_p).value
    address = getattr(function, "address", None)
    return address if isinstance(address, int) else None


def wrap(kind, function, label, shape, nq=0, nv=0, inputs=()):
    """A function pointer of type `kind` for a Python function or an address. The caller keeps it
    alive.

    label names the function in messages; shape is that of its value; nq, nv are the lengths of q
    and v; inputs are the places of those that a force function takes.
    """
    address = address_of(function)
    if address is not None:
        return kind(address)
    if not callable(function):
        raise TypeError(f"{label}: a function or the address of one is wanted, not {function!r}")
    takes_inputs = inputs and kind is _abi.baum_force_fn
    make = _shell_force_of(inputs) if takes_inputs else SHELLS[kind]
    return kind(make(function, _writer(shape, label), nq, nv))


def event_function(function, nq, nv):
    """function(t, q, v) of an event as the library calls it."""
    shell = _shell_force(function, _writer((1,), "the function of an event"), nq, nv)
    return _abi.baum_force_fn(shell)
