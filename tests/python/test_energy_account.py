# SPDX-License-Identifier: BSD-3-Clause
"""Tests the energy account of a run."""

import math
import unittest

from mechanisms import rod_pendulum


class EnergyAccount(unittest.TestCase):
    def test_it_closes(self):
        times = [0.0, 0.5, 1.0]
        run = rod_pendulum().simulate(
            times, "rk4", step=1e-3, energy_account=True, record=["energy_account"]
        )
        account = run.energy_account
        self.assertEqual(run["energy_account"].shape, (3, 12))
        self.assertEqual(run["energy_account"][-1, -1], account.residual)
        self.assertEqual(run.counters.energy_residual, account.residual)
        # The kinetic energy at the end is 1.6 J. The error of rk4 with 1000 steps per second is
        # much smaller.
        self.assertLess(abs(account.residual), 1e-9)
        self.assertGreater(account.kinetic, 1.0)
        self.assertGreater(account.evaluations, 0)

    def test_without_the_option_there_is_none(self):
        run = rod_pendulum().simulate([0.0, 0.1], "rk4", step=1e-2)
        self.assertIsNone(run.energy_account)
        self.assertTrue(math.isnan(run.counters.energy_residual))


if __name__ == "__main__":
    unittest.main()
