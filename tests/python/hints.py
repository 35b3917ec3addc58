# SPDX-License-Identifier: BSD-3-Clause
"""Correct and wrong uses of the Python interface. `sh tests/run.sh types` checks them with mypy and
pyright. This file is never run.

Each "ignore" comment marks an error that the type checkers must find. If they did not find it,
--strict would refuse the comment as unnecessary.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import baum
from baum.typing import Array, SimulationOptions

if TYPE_CHECKING:
    from typing_extensions import assert_type


def right() -> None:
    m = baum.Mechanism(gravity=(0, 0, -9.81))
    body = assert_type(m.planar_body("a", mass=1, position=(0, 1)), baum.Body)
    pin = assert_type(m.revolute("pin", m.ground, "a", point=(0, 0)), baum.Joint)
    body.outline = [(0, 0), (1, 0), (0, 1)]
    m.planar_body("c", outline=["M 0 0 1 0 1 1 z", baum.Circle(1, (0, 1)), [(0, 0), (1, 0), (0, 1)]])
    assert_type(body.outline, "list[baum.Outline]")
    m.force("drag", [body], lambda t, q, v: -0.1 * v)
    assert_type(pin.set(point_a=(0, 1)), baum.Joint)
    options: SimulationOptions = {"step": 1e-3, "formulation": "baumgarte", "gains": baum.auto()}
    run = assert_type(m.freeze().simulate([0, 1], "rk4", record="pin.phi", **options), baum.Run)
    assert_type(run[pin.phi], Array)
    assert_type(run.counters.steps, int)
    assert_type(run.events[0].name, str)
    assert_type(run.counters.max_phi_joint, "baum.Joint | None")
    with m.simulation("rk8", rtol=1e-8, progress=True) as s:
        assert_type(s, baum.Simulation)
        assert_type(s.advance_to(1), baum.Status)
        assert_type(s.get("pin.phi"), Array)
        assert_type(s.view(traces=[body, "a.pose"]).url, str)
        assert_type(s.get("pin.phi", body.pose), "tuple[Array, ...]")
    with baum.study(m, 0, 1, grid="full") as study:
        best = study.add("rk4", step=1e-3).run().recommend(1e-6)
        assert_type(study.entries[0].error, float)
        m.simulate([0], **best)
    run.page("x.html", forces=["pin.reaction"])
    run.figure(0.5, traces=[body.pose], size=(300, 200)).save("x.pdf")
    run.movie("x.gif", fps=25, speed=0.5, forces=True, progress=print)
    m.page(run.t, run.q, "x.html", plots={"y [m]": run.q[:, 1]}, marks=[(0.5, "half")])
    m.export_fmu("a.fmu", "rk8", step=1e-3, outputs=[pin.phi, "energy"], parameters=["a.mass"])
    assert_type(baum.stability("rk4", 1, 1).roots, "tuple[complex, complex]")
    assert_type(baum.AccuracyWarning.code, int)


def wrong(m: baum.Mechanism, study: baum.Study) -> None:
    m.planar_body("b", mass="heavy")  # type: ignore[arg-type]
    m.planar_body("b", outline=baum.Circle("1"))  # type: ignore[arg-type]
    m.planar_body("b", weight=1)  # type: ignore[call-arg]
    m.driver("motor", m.ground)  # type: ignore[arg-type]
    m.simulate([0, 1], "rk4", steps=1e-3)  # type: ignore[call-arg]
    m.simulate([0, 1], "rk4", step=1e-3, formulation="bdf")  # type: ignore[arg-type]
    m.simulation("rk4", step=1e-3, gains=5)  # type: ignore[arg-type]
    study.add("rk4", step=1e-3, progress=True)  # type: ignore[call-arg]
    study.front("time")  # type: ignore[arg-type]
