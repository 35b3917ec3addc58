# SPDX-License-Identifier: BSD-3-Clause
"""Determine the units of the columns of channels. "-" stands for a pure number. A unit is "" if it
depends on functions of the user."""

from __future__ import annotations

from typing import TYPE_CHECKING

from . import _abi
from .channels import Channel, width
from .definitions import COORDINATES

if TYPE_CHECKING:
    from .definitions import Kind
    from .elements import Body, Joint
    from .mechanism import Mechanism

Units = tuple[str, ...]

_Q = _abi.baum_quantity
_RATES = {"m": "m/s", "rad": "rad/s", "-": "1/s", "m/s": "m/s^2", "rad/s": "rad/s^2"}
_FORCES = {"m": "N", "rad": "N m", "-": "N m"}
PLANAR_FORCE = ("N", "N", "N m")
SPATIAL_FORCE = ("N",) * 3 + ("N m",) * 3


def of_channel(mechanism: Mechanism, channel: Channel) -> Units:
    """Return the unit of each column of a channel."""
    quantity = channel.struct.quantity
    if quantity in _OF_BODY:
        body = mechanism.find("body", channel.struct.body)
        bodies = [body] if body else [one for one in mechanism if one.family == "body"]
        order = _OF_BODY[quantity]
        return tuple(unit for one in bodies for unit in _of_body(one, order))
    if quantity in (_Q.BAUM_ENERGY, _Q.BAUM_ENERGY_ACCOUNT):
        return ("J",) * width(mechanism, channel)
    joint = mechanism.find("joint", channel.struct.joint)
    if quantity == _Q.BAUM_JOINT_COORDINATE:
        unit = _coordinate(joint, list(COORDINATES)[channel.struct.coordinate])
        return unit, _RATES[unit]
    if quantity == _Q.BAUM_JOINT_REACTION:
        return _reaction(joint, width(mechanism, channel))
    joints = [joint] if joint else [one for one in mechanism if one.family == "joint"]
    rows = tuple(unit for one in joints for unit in _rows(one))
    if quantity in (_Q.BAUM_LAMBDA, _Q.BAUM_DRIVE_EFFORT):
        return tuple(_FORCES.get(unit, "") for unit in rows)
    return _rates(rows, quantity == _Q.BAUM_PHI_RATE)


# Order of the time derivative: 0 for positions of bodies, 1 for velocities, 2 for accelerations.
_OF_BODY = {
    _Q.BAUM_Q: 0,
    _Q.BAUM_V: 1,
    _Q.BAUM_A: 2,
    _Q.BAUM_BODY_POSE: 0,
    _Q.BAUM_BODY_VELOCITY: 1,
    _Q.BAUM_BODY_ACCELERATION: 2,
}


def _of_body(body: Body, order: int) -> Units:
    """Return the units of the positions of a body (order 0), or of their first or second time
    derivatives."""
    if body.kind is None:  # ground
        return ()
    count = body.nv if order else body.nq
    units = order and body.kind.displacements or body.kind.units
    return _rates(units, order) or ("",) * count


def _rates(units: Units, order: int) -> Units:
    for _ in range(order):
        units = tuple(_RATES.get(unit, "") for unit in units)
    return units


def _coordinate(joint: Joint, name: str) -> str:
    assert joint.kind is not None
    return "rad" if joint.kind.coordinate(name).startswith("angle") else "m"


def _rows(joint: Joint) -> Units:
    """Return the units of the rows of a joint. The rows of couplings and drivers have the units of
    coordinates."""
    assert joint.kind is not None
    if joint.kind.units:
        return joint.kind.units
    values = joint.definition
    if "joint_b" in values:
        return (_coordinate(values["joint_b"], values["coordinate_b"]),)
    if "joint" in values:
        return (_coordinate(values["joint"], values["coordinate"]),)
    return ("",) * int(values["rows"])


def _driven(joint: Joint) -> Kind | None:
    """Return the kind of the joint on which a driver acts."""
    driven: Joint | None = joint.definition.get("joint")
    return None if driven is None else driven.kind


def _reaction(joint: Joint, columns: int) -> Units:
    """Return the units of force and moment, or of generalized forces on planar bodies."""
    assert joint.kind is not None
    moved = joint.kind if joint.kind.units else _driven(joint)
    if moved is not None and moved.is_spatial:
        return SPATIAL_FORCE
    planar = joint.kind.name != "user_constraint" and columns % 3 == 0
    return PLANAR_FORCE * (columns // 3) if planar else ("",) * columns
