# SPDX-License-Identifier: BSD-3-Clause
"""Run 1000 slider-cranks by baum.sweep() on each kind of executor, and compare all bits of their
results.

usage: bench_executors.py [COUNT]                                 with Dask, if it is installed
       mpiexec -n 3 python -m mpi4py.futures bench_executors.py   with MPI: one manager, 2 workers
"""

import concurrent.futures
import sys
import time

import numpy as np

import baum

TIMES = np.linspace(0, 0.2, 21)


def slider_crank():
    m = baum.Mechanism()
    m.planar_body("crank", mass=0.038, inertia=7.4e-5, position=(0.0765, 0), angular_velocity=150)
    m.planar_body("rod", mass=0.038, inertia=5.9e-4, position=(0.306, 0))
    m.planar_body("slider", mass=0.076, position=(0.459, 0.0))
    m.revolute("A", "ground", "crank", point_a=(0, 0), point_b=(-0.0765, 0))
    m.revolute("B", "crank", "rod", point_a=(0.0765, 0), point_b=(-0.153, 0))
    m.revolute("C", "rod", "slider", point_a=(0.153, 0), point_b=(0, 0))
    m.translational("guide", "ground", "slider", axis=(1, 0), point_a=(0, 0), point_b=(0, 0))
    return m


def stroke(run):
    return run["slider.pose"][:, 0]


class Serial:
    """Runs everything in the calling thread."""

    _max_workers = 1

    def map(self, function, *lists):
        return map(function, *lists)


def count():
    # MPI workers import this file with other arguments, so the argument is read only when needed.
    return int(sys.argv[1]) if len(sys.argv) > 1 else 1000


def measure(name, executor, expected):
    """Print the time of a sweep, and whether its results equal the expected ones."""
    masses = {"rod.mass": np.linspace(0.03, 0.05, count())}
    begun = time.perf_counter()
    swept = baum.sweep(slider_crank(), masses, TIMES, "rk8", rtol=1e-8, reduce=stroke,
                       executor=executor)  # fmt: skip
    seconds = time.perf_counter() - begun
    same = expected is None or np.array_equal(swept["value"], expected)
    words = "" if expected is None else "the same bits" if same else "OTHER RESULTS"
    print(f"{name:12} {seconds:8.2f} s   {len(swept.messages)} failed   {words}", flush=True)
    return swept["value"], same


def main():
    expected, _ = measure("serial", Serial(), None)
    found = []
    with concurrent.futures.ThreadPoolExecutor(2) as executor:
        found.append(measure("2 threads", executor, expected)[1])
    if "mpi4py.futures" in sys.modules:
        from mpi4py.futures import MPIPoolExecutor

        with MPIPoolExecutor(2) as executor:
            found.append(measure("2 ranks", executor, expected)[1])
        return all(found)
    with concurrent.futures.ProcessPoolExecutor(2) as executor:
        found.append(measure("2 processes", executor, expected)[1])
    try:
        from dask.distributed import Client, LocalCluster
    except ImportError:
        print("Dask is not installed")
        return all(found)
    with LocalCluster(2, threads_per_worker=1, dashboard_address=None) as cluster:
        with Client(cluster) as client:
            found.append(measure("Dask", client.get_executor(), expected)[1])
    return all(found)


if __name__ == "__main__":
    sys.exit(0 if main() else 1)
