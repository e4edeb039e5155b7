// SPDX-License-Identifier: MIT
#include "bad_designs.hpp"

namespace {

// In place of the last line: [[scenario]] is line 41, `keys` begin in line 44.
std::vector<Edit> scenario(const std::string& keys) {
  return {{41, "[[scenario]]\nname = \"s\"\nduration = 5\n" + keys}};
}

}  // namespace

std::vector<BadDesign> wrong_scenarios() {
  return {
      {"scenario without a name", {{41, "[[scenario]]\nduration = 1"}}, {"41:1: scenario[0].name: missing"}},
      {"scenario without a length", {{41, "[[scenario]]\nname = \"s\""}}, {"41:1: scenario[0].duration: missing"}},
      {"scenario that is one table",
       {{41, "[scenario]\nname = \"s\""}},
       {"41:1: scenario: expected tables [[scenario]], found a table"}},
      {"two scenarios of one name",
       scenario("[[scenario]]\nname = \"s\"\nduration = 1"),
       {"45:8: scenario[1].name: expected a name of its own, found that of a scenario before, \"s\""}},
      {"scenario of too many samples",
       {{41, "[[scenario]]\nname = \"s\"\nduration = 1e6"}},
       {"43:12: scenario[0].duration: expected at most 1e+06 samples, found 2e+06"}},
      {"start of another plant", scenario("x0 = [1, 2]"), {"44:6: scenario[0].x0: expected 4 numbers (nx), found 2"}},
      {"noise that is a word",
       scenario("noise = \"no\""),
       {"44:9: scenario[0].noise: expected true or false, found \"no\""}},
      {"unknown key of a load",
       scenario("load = [{ inptu = 0 }]"),
       {"44:11: scenario[0].load[0].inptu: unknown key, did you mean `input`?"}},
      {"load on nothing",
       scenario("load = [{ value = 1 }]"),
       {"44:9: scenario[0].load[0].input: missing: expected input or state"}},
      {"load on two places",
       scenario("load = [{ input = 0, state = 1 }]"),
       {"44:30: scenario[0].load[0].state: says again what scenario[0].load[0].input says: expected one of the two"}},
      {"load on an input that is not there",
       scenario("load = [{ input = \"torque\" }]"),
       {"44:19: scenario[0].load[0].input: expected a whole number from 0 to 0, or one of \"force\", found "
        "\"torque\""}},
      {"load on the fifth of four states",
       scenario("load = [{ state = 4 }]"),
       {"44:19: scenario[0].load[0].state: expected a whole number from 0 to 3, or one of \"dy1\", \"v1\", \"dy2\", "
        "\"v2\", found 4"}},
      {"course that ends before it begins",
       scenario("load = [{ input = 0, at = 2, until = 1 }]"),
       {"44:38: scenario[0].load[0].until: expected more than at = 2, found 1"}},
      {"course of two shapes",
       scenario("load = [{ input = 0, ramp = 1, sine = 1 }]"),
       {"44:39: scenario[0].load[0].sine: expected one of ramp, sine and csv, found ramp, too"}},
      {"column without a file",
       scenario("load = [{ input = 0, column = \"f\" }]"),
       {"44:31: scenario[0].load[0].column: needs csv"}},
      {"file that is not there",
       scenario("load = [{ input = 0, csv = \"none.csv\" }]"),
       {"44:28: scenario[0].load[0].csv: …none.csv: cannot be read"}},
      {"file that is no table of numbers",
       scenario("load = [{ input = 0, csv = \"design.toml\" }]"),
       {"44:28: scenario[0].load[0].csv: …design.toml: expected a column \"t\" with numbers, found none"}},
      {"reference of an output that follows none",
       scenario("reference = [{ output = \"y1\" }]"),
       {"44:25: scenario[0].reference[0].output: expected an output of lqr.track or lqr.integral.outputs: no other "
        "follows a reference"}},
      {"input beside a regulator",
       scenario("input = [{ input = 0 }]"),
       {"44:9: scenario[0].input: needs a design without [lqr]: the regulator makes u; `load` adds to it"}},
      {"gap that ends before it begins",
       scenario("dropout = [{ output = 0, from = 3, until = 3 }]"),
       {"44:44: scenario[0].dropout[0].until: expected more than from = 3, found 3"}},
      {"outlier without a time",
       scenario("outlier = [{ output = 0, value = 1 }]"),
       {"44:12: scenario[0].outlier[0].at: missing"}},
      {"sensor with no range",
       scenario("sensor = [{ output = 0, min = 1, max = 1 }]"),
       {"44:40: scenario[0].sensor[0].max: expected min < max, found 1 and 1"}},
      {"another plant of other size",
       scenario("plant = { A = [[1]] }"),
       {"44:15: scenario[0].plant.A: expected 4 rows (nx), found 1",
        "44:15: scenario[0].plant.A: expected 4 columns (nx), found 1"}},
      {"continuous plant in place of one that is",
       scenario("plant = { continuous = true, A = [[0, 1, 0, 0], [0, 0, 0, 0], [0, 0, 0, 1], [0, 0, 0, 0]],"
                " B = [[0], [1], [0], [0]] }"),
       {"44:24: scenario[0].plant.continuous: needs plant.domain = \"discrete\""}},
      {"row that no matrix has",
       scenario("plant = { scale = [{ matrix = \"C\", row = \"v1\", factor = 2 }] }"),
       {"44:42: scenario[0].plant.scale[0].row: expected one of \"y1\", \"y2\", or its number from 0, found \"v1\""}},
      {"matrix that is not of the plant",
       scenario("plant = { scale = [{ matrix = \"K\", factor = 2 }] }"),
       {"44:31: scenario[0].plant.scale[0].matrix: expected \"A\", \"B\" or \"C\", found \"K\""}},
      {"requirement of a scenario that is not there",
       scenario("[require]\nscenario = \"t\"\novershoot = 0.1"),
       {"45:12: require.scenario: expected one of \"s\", found \"t\""}},
      {"requirement without a scenario",
       {{41, "[require]\nshare_at_limits = 0.1"}},
       {"42:19: require.share_at_limits: needs [[scenario]], in which it is measured"}},
      {"rms of nothing",
       scenario("[require]\nrms = [{ value = 1 }]"),
       {"45:8: require.rms[0].state: missing: expected state, input or output"}},
  };
}

std::vector<BadDesign> missed_in_scenarios() {
  return {
      {"rms that a load exceeds",
       scenario("load = [{ input = 0, value = 1 }]\n[require]\nrms = [{ input = \"force\", value = 1e-3 }]"),
       {"46:35: require.rms[0].value: requires at most 0.001, scenario \"s\": the rms of force is …"}},
      {"overshoot without a step",
       scenario("[require]\novershoot = 0.1"),
       {"45:13: require.overshoot: scenario \"s\" has no step of a reference to measure it by"}},
      {"limits that are reached",
       scenario("x0 = [100, 0, 100, 0]\n[require]\nshare_at_limits = 0"),
       {"46:19: require.share_at_limits: requires at most 0, scenario \"s\": the share of samples at a limit is …"}},
      {"delay margin that no loop of this sampling has",
       {{41, "[require]\ndelay_margin = 1000"}},
       {"42:16: require.delay_margin: requires at least 1000 s, the loop has …"}},
  };
}
