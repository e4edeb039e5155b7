# SPDX-License-Identifier: MIT
"""To Scilab and back."""

import unittest
from pathlib import Path

import tinylqg
from designs import InFolder, run
from plants import assert_plant
from readme import as_script, run_chapter


class Scilab(InFolder):
    def scilab(self, *lines):
        Path("script.sce").write_text(as_script("scilab", "\n".join(lines)))
        done = run("scilab-cli", "-nb", "-quit", "-f", "script.sce")
        self.assertIn("no error", done.stdout, done.stderr)

    def test_page(self):
        run_chapter("Scilab", "scilab", "sh", "scilab")

    def test_all_formats(self):
        self.scilab(
            "A = [0 1; 0 -2]; B = [0; 3]; C = [1 0]; D = 0; Ts = 0; name = 'servo';",
            "lqr = struct('Q', [1 0; 0 2], 'cost', 'sampled'); states = {'a [m]'; 'b'};",
            *(
                f"savematfile('{name}.mat', 'A', 'B', 'C', 'D', 'Ts', 'name', 'lqr', 'states', '-{version}');"
                for name, version in (("seven", "v7"), ("six", "v6"))
            ),
            "G = []; inputs = {}; observer = struct('poles', [0.1+%i*0.2 0.1-%i*0.2]);",
            "stage(1).from = 20; stage(1).R = 2; stage(2).from = 60; stage(2).R = 3;",
            "savematfile('hdf5.mat', 'A', 'B', 'C', 'D', 'Ts', 'name', 'lqr', 'states', 'observer', 'G', "
            "'inputs', 'stage', '-v7.3');",
        )
        for name in ("seven.mat", "six.mat"):
            self.assertEqual(assert_plant(name)["states"], ["a [m]", "b"])
            self.assertEqual(tinylqg.read_mat(name)["lqr"]["cost"], "sampled")
        text = tinylqg.design_text(**tinylqg.read_mat("hdf5.mat"), sample_time=0.1)
        for part in (
            'name = "servo"',
            'states = ["a [m]", "b"]',
            'Q = [[1, 0],\n     [0, 2]]',
            'cost = "sampled"',
            "poles = [[0.1, 0.2], [0.1, -0.2]]",
            "[[stage]]\nR = [2]\nfrom = 20\n\n[[stage]]\nR = [3]\nfrom = 60",
        ):
            self.assertIn(part + "\n", text)
        self.assertEqual(set(assert_plant("hdf5.mat")), {*"ABCD", "states", "domain"})


if __name__ == "__main__":
    unittest.main()
