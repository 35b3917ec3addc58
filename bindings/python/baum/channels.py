# SPDX-License-Identifier: BSD-3-Clause
"""Channels, the quantities that can be read from a run. A channel is a named group of columns.

The channels of the whole mechanism are here: q, v, a, lambda_, phi, phi_rate, energy and
energy_account. The channels of a body or joint are its attributes, such as m["slider"].pose and
m["B"].reaction.
"""

from __future__ import annotations

import ctypes
from typing import TYPE_CHECKING, Any, Iterable

import numpy as np

from . import _abi, _calls
from ._lib import default, lib
from .errors import Error, Status
from .typing import Array

if TYPE_CHECKING:
    from .mechanism import Mechanism

_Q = _abi.baum_quantity


class Channel:
    """A channel: a group of columns that a run records. Attributes of bodies and joints, such as
    m["slider"].pose, are channels. The package has the channels `q`, `v`, `a`, `lambda_`,
    `phi`, `phi_rate`, `energy` and `energy_account` of the whole mechanism, such as baum.energy.

    key: its name in a run, such as "slider.pose".
    """

    __slots__ = ("key", "struct")

    def __init__(self, key: str, quantity: int, **fields: Any) -> None:
        self.key = key
        self.struct = default(_abi.baum_channel)
        for field, value in {"quantity": quantity, **fields}.items():
            setattr(self.struct, field, value)

    @classmethod
    def of_bytes(cls, key: str, struct: bytes, tag: int) -> Channel:
        """Make a channel from the bytes of its struct in C.

        tag: a number that identifies the mechanism. This number becomes part of the ids of bodies
            and joints in the channel.
        """
        made = cls(key, 0)
        made.struct = _abi.baum_channel.from_buffer_copy(struct)
        for id in (made.struct.body, made.struct.joint):
            id.tag = tag if id.index1 > 0 else id.tag
        return made

    def __repr__(self) -> str:
        return f"<channel {self.key}>"


q = Channel("q", _Q.BAUM_Q)
v = Channel("v", _Q.BAUM_V)
a = Channel("a", _Q.BAUM_A)
lambda_ = Channel("lambda", _Q.BAUM_LAMBDA)
phi = Channel("phi", _Q.BAUM_PHI)
phi_rate = Channel("phi_rate", _Q.BAUM_PHI_RATE)
energy = Channel("energy", _Q.BAUM_ENERGY)
energy_account = Channel("energy_account", _Q.BAUM_ENERGY_ACCOUNT)

WHOLE = {
    channel.key: channel for channel in (q, v, a, lambda_, phi, phi_rate, energy, energy_account)
}


class Layout:
    """The order of several channels in one row of numbers: which columns belong to which
    channel."""

    def __init__(self, mechanism: Mechanism, channels: Iterable[Channel]) -> None:
        self.channels = {channel.key: channel for channel in channels}
        self.count = len(self.channels)
        self.structs = (_abi.baum_channel * self.count)(
            *(channel.struct for channel in self.channels.values())
        )
        self.slices: dict[str, slice] = {}
        self.width = 0
        for key, channel in self.channels.items():
            end = self.width + width(mechanism, channel)
            self.slices[key] = slice(self.width, end)
            self.width = end

    def rows(self, count: int) -> Array:
        """Return an uninitialized array with this number of rows."""
        return np.empty((count, self.width))


def several(given: Any) -> tuple[Any, ...]:
    """Return names or objects as a tuple. A single one may be given without a list."""
    is_one = isinstance(given, str) or not isinstance(given, Iterable)
    return (given,) if is_one else tuple(given)


def width(mechanism: Mechanism, channel: Channel) -> int:
    """Return the number of columns of a channel."""
    count = _width(mechanism, channel)
    if count < 0:
        message = _calls.message().replace("channel 0:", f"channel {channel.key!r}:", 1)
        raise Error(Status.ERR_ARGUMENT, message)
    return count


def has(mechanism: Mechanism, channel: Channel) -> bool:
    """Tell whether a frozen mechanism has a channel."""
    return _width(mechanism, channel) >= 0


def _width(mechanism: Mechanism, channel: Channel) -> int:
    count: int = lib.baum_channels_width(mechanism.handle, ctypes.byref(channel.struct), 1)
    return count
