# SPDX-License-Identifier: MIT
"""Without NumPy: design files, gains and headers all the same, and a sentence about what is missing."""

import importlib.util
import json
import sys
import unittest
from pathlib import Path

import tinylqg
from designs import SOURCE, InFolder, run


class Bare(InFolder):
    def test_there_is_no_other_package(self):
        for name in ("numpy", "scipy", "control", "h5py", "matplotlib", "tqdm"):
            self.assertIsNone(importlib.util.find_spec(name), name)

    def test_from_matrices_to_gains(self):
        tinylqg.write_design(
            "mass.toml", ([[1, 0.01], [0, 1]], [[5e-5], [0.01]], [[1, 0]], [[0]], 0.01), Q=[1, 1], R=[1]
        )
        design = tinylqg.generate("mass.toml")
        self.assertEqual(design.K, json.loads(Path("mass.json").read_text())["lqr"]["K"])
        self.assertEqual(design.plant.A, [[1, 0.01], [0, 1]])
        self.assertTrue(all(abs(pole) < 1 for pole in design.lqr.poles))
        self.assertTrue(Path("mass.h").exists())

    def test_design_in_memory_and_its_controller(self):
        design = tinylqg.Design(
            A=[[1, 0.01], [0, 1]],
            B=[[5e-5], [0.01]],
            C=[[1, 0]],
            domain="discrete",
            sample_time=0.01,
            Q=[1, 1],
            R=1,
            W=[1e-4, 1e-2],
            V=1e-3,
        )
        self.assertTrue(all(abs(pole) < 1 for pole in design.poles))
        self.assertEqual(len(design.sweep(rho=[1, 10]).column("loop.disk_margin")), 2)
        for compiled in (True, False):
            with design.controller(compiled) as controller:
                (u,) = controller.step([1])
                self.assertLess(u, 0)
                self.assertEqual([type(value) for value in controller.x], [float, float])
        scenario = {"duration": 0.2, "x0": [1, 0], "noise": False, "spread": {"A": 0.01}}
        run = design.simulate(scenario)
        self.assertEqual((len(run.t), run.x[0], len(run.u[0])), (20, [1, 0], 1))
        many = design.monte_carlo(20, scenario=scenario)
        self.assertLess(many.percentiles[5].cost, many.percentiles[95].cost)
        self.assertEqual((len(many.column("peak.states[0]")), many.failures), (20, [False] * 20))
        with self.assertRaisesRegex(ImportError, r"pip install 'tinylqg\[plot\]'"):
            design.plot("poles")
        with self.assertRaisesRegex(ImportError, r"pip install 'tinylqg\[progress\]'"):
            design.sweep(rho=[1], progress=True)

    def test_what_is_missing_is_said(self):
        design = tinylqg.generate(SOURCE / "codegen" / "designs" / "two_mass.toml")
        for call, package in (
            (design.to_control, "control"),
            (design.to_scipy, "mat"),
            (lambda: design.save_mat("x.mat"), "mat"),
        ):
            with self.assertRaisesRegex(ImportError, rf"pip install 'tinylqg\[{package}\]'"):
                call()
        Path("plant.mat").write_bytes(b"MATLAB 5.0")
        done = run(sys.executable, "-m", "tinylqg", "import", "plant.mat")
        self.assertEqual(
            (done.returncode, done.stderr),
            (3, "reading a .mat file needs scipy, which is not installed: pip install 'tinylqg[mat]'\n"),
        )


if __name__ == "__main__":
    unittest.main()
