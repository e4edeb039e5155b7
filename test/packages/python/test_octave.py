# SPDX-License-Identifier: MIT
"""To Octave and back."""

import json
import unittest
from pathlib import Path

import numpy

import tinylqg
from designs import InFolder, run
from plants import PLANT, WEIGHTS, assert_plant, cells, save
from readme import run_chapter


class Octave(InFolder):
    def octave(self, *lines):
        Path("script.m").write_text("\n".join(lines))
        done = run("octave-cli", "--norc", "--quiet", "script.m")
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def test_page(self):
        run_chapter("MATLAB and Octave", "octave", "sh", "octave")

    def test_all_formats(self):
        self.octave(
            "A = [0 1; 0 -2]; B = [0; 3]; C = [1 0]; D = 0; Ts = 0; states = {'a [m]'; 'b'};",
            "save -v7 seven.mat A B C D Ts states",
            "save -v6 six.mat A B C D Ts states",
            "save -v4 four.mat A B C D Ts",
        )
        self.assertEqual(assert_plant("seven.mat")["states"], ["a [m]", "b"])
        assert_plant("six.mat")
        assert_plant("four.mat")

    def test_state_space(self):
        self.octave(
            "pkg load control",
            "sys = ss([0 1; 0 -2], [0; 3], [1 0], 0);",
            "save -v7 plain.mat sys",
            "set(sys, 'stname', {'angle', 'speed'}, 'inname', {'u'});",
            "other = 1;",
            "save -v7 named.mat sys other",
            "d = c2d(sys, 0.1);",
            "save -v7 discrete.mat d",
            "e = dss(1, 1, 1, 0, 2);",
            "save -v7 descriptor.mat e",
        )
        self.assertNotIn("states", assert_plant("plain.mat"))
        named = assert_plant("named.mat", variable="sys")
        self.assertEqual((named["states"], named["inputs"]), (["angle", "speed"], ["u"]))
        discrete = tinylqg.read_mat("discrete.mat")["plant"]
        self.assertEqual((discrete["domain"], discrete["sample_time"]), ("discrete", 0.1))
        with self.refused("descriptor system e"):
            tinylqg.read_mat("descriptor.mat")

    def test_it_loads_what_is_saved(self):
        save("plant.mat", **PLANT, **WEIGHTS, states=cells("a [m]", "b"), lqr={"horizon": 3.0})
        tinylqg.write_design("loop.toml", **tinylqg.read_mat("plant.mat"), sample_time=0.01)
        tinylqg.generate("loop.toml").save_mat("gains.mat")
        design = json.loads(Path("loop.json").read_text())
        found = self.octave(
            "load gains.mat",
            "printf('%.17g\\n', K, L, P_prior, Ts, real(poles(1)));",
            "printf('%s\\n', name, states{1});",
            "printf('%d\\n', size(lqr_schedule));",
        ).split()
        numbers = [
            *sum(design["lqr"]["K"], []),
            *sum(design["kalman"]["L"], []),
            *numpy.transpose(design["kalman"]["P_prior"]).flat,
            0.01,
            design["loop"]["poles"][0][0],
        ]
        self.assertEqual([float(word) for word in found[: len(numbers)]], numbers)
        self.assertEqual(found[len(numbers) :], ["loop", "a", "[m]", "1", "2", "3"])


if __name__ == "__main__":
    unittest.main()
