# SPDX-License-Identifier: BSD-3-Clause
"""A study of accuracy and cost in Python. The mechanism is the slider-crank without a driver, whose
crank is released at 150 rad/s. After the study, the program simulates with the settings that the
study recommends."""

import sys

import baum
import numpy as np
from support.report import Report

SPAN = 0.2  # [s]
INTEGRATORS = ("semi_implicit_euler", "rk4", "dp5", "rk8")
COLUMNS = {
    "name": ("the front", "54s"),
    "error": ("error [-]", "9.1e"),
    "work": ("evaluations", "11.0f"),
    "cpu": ("CPU [ms]", "8.2f"),
    "max_phi": ("max|Phi| [m]", "9.1e"),
}


def slider_crank() -> baum.Mechanism:
    """Build the mechanism of three bodies. The crank is at angle 0. The other poses are only
    approximate; assembly moves the bodies to their places."""
    m = baum.Mechanism(gravity=(0, -9.81))
    crank = m.planar_body(
        "crank", mass=0.038, inertia=7.4e-5, position=(0.0765, 0), held=True, angular_velocity=150
    )
    rod = m.planar_body("rod", mass=0.038, inertia=5.9e-4, position=(0.306, 0))
    slider = m.planar_body("slider", mass=0.076, inertia=2.7e-6, position=(0.459, 0.05))
    m.revolute("A", m.ground, crank, point_a=(0, 0), point_b=(-0.0765, 0))
    m.revolute("B", crank, rod, point_a=(0.0765, 0), point_b=(-0.153, 0))
    m.revolute("C", rod, slider, point_a=(0.153, 0), point_b=(0, 0))
    m.translational("guide", m.ground, slider, axis=(1, 0), point_a=(0, 0.05), point_b=(0, 0))
    return m.freeze()


def error_of(m: baum.Mechanism, study: baum.Study, options: baum.Recommendation) -> float:
    """Return the largest error of a run at the samples of the study's reference."""
    times, q, _, _ = study.reference_samples()
    return float(abs(m.simulate(times, **options).q - q).max())


def main() -> int:
    report = Report("tradeoff", page="write the study into this file, as a page for a browser")
    m = slider_crank()
    study = baum.study(
        m, 0, SPAN, error=["crank.pose", "rod.pose", "slider.pose"], repeats=2, entry_limit=0.1
    )
    for name in INTEGRATORS:
        study.add_standard(name, settings=5, constants=1)
    study.run()
    print(f"{study}\nerror      {study.error_text}\nreference  {study.reference.text}\n")

    entries = study.entries
    front = [entries[k] for k in study.front()]
    table = [
        (entry.name, entry.error, entry.work, 1e3 * entry.cpu, entry.max_phi) for entry in front
    ]
    report.table("front", COLUMNS, table)
    wanted = {error: study.recommend(error) for error in (1e-2, 1e-4, 1e-6, 1e-8)}
    for error, best in wanted.items():
        print(f"for an error of {error:.0e}: {best.why}\n")
    for error, best in wanted.items():
        report.expect(f"error with the setting for {error:.0e}", error_of(m, study, best), error)
    exact = [entry.error for entry in entries if not np.isnan(entry.error)]
    least = study.reference.uncertainty
    report.expect("uncertainty of the reference", least, min(exact))
    if report.options.page:
        study.write(report.options.page, "Slider-crank, released at 150 rad/s")
    return report.end()


if __name__ == "__main__":
    sys.exit(main())
