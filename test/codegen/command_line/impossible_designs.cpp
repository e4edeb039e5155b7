// SPDX-License-Identifier: MIT
#include "bad_designs.hpp"

namespace {

// Five lines of plant with its `A`, `B`, `C` in lines 5, 6, 7, and both tables below.
std::string design(const std::string& domain, const std::string& A, const std::string& B, const std::string& C) {
  return "name = \"base\"\n[plant]\ndomain = \"" + domain + "\"\nsample_time = 0.1\nA = " + A + "\nB = " + B +
         "\nC = " + C +
         "\nstates = [\"angle [rad]\", \"rate [rad/s]\"]\n[lqr]\nQ = [1, 1]\nR = [1]\n[kalman]\n"
         "process_noise = [1, 1]\nmeasurement_noise = [1]\n";
}

}  // namespace

std::vector<BadDesign> impossible() {
  return {
      {"unstable mode that no input reaches",
       {{0, design("discrete", "[[1.5, 0], [0, 0.5]]", "[[0], [1]]", "[[1, 1]]")}},
       {"6:5: plant.B: …z = 1.5…angle…not stabilisable"}},
      {"unstable mode that no output shows",
       {{0, design("discrete", "[[1.5, 0], [0, 0.5]]", "[[1], [1]]", "[[0, 1]]")}},
       {"7:5: plant.C: …z = 1.5…angle…not detectable"}},
      {"unstable mode that stands alone",
       {{0, design("continuous", "[[2, 0], [0, -3]]", "[[0], [1]]", "[[0, 1]]")}},
       {"6:5: plant.B: …s = 2…angle…not stabilisable", "7:5: plant.C: …s = 2…angle…not detectable"}},
      {"oscillation that no input damps",
       {{0, design("continuous", "[[0, 1], [-1, 0]]", "[[0], [0]]", "[[1, 0]]")}},
       {"6:5: plant.B: …not stabilisable"}},
      {"integrator that no output shows",
       {{0, design("continuous", "[[0, 1], [0, 0]]", "[[0], [1]]", "[[0, 1]]")}},
       {"7:5: plant.C: …angle…not detectable"}},
      // diag(1.05, 0.5) and [0 1]ᵀ turned by 0.7 rad in double
      {"unstable mode that no input reaches but for rounding",
       {{0, design("discrete", "[[0.8217409642975664, 0.2709986757468266], [0.2709986757468266, 0.7282590357024338]]",
                   "[[-0.644217687237691], [0.7648421872844885]]", "[[1, 1]]")}},
       {"6:5: plant.B: …z = 1.05…angle, rate…only by the rounding of the file's numbers: "
        "move every number of A and B by 9.6e-17 of itself…"}},
      {"limits that are foreseen with an integral",
       {{16, "[lqr]\nintegral = { outputs = [0], Q = [1] }"}, {34, "horizon = 5\nu_min = [-1]"}},
       {"35:11: limits.horizon: cannot be had with lqr.integral: …winds up"}},
      {"limits that are foreseen with the gain of a continuous cost",
       {{20, "cost = \"continuous\""}, {34, "horizon = 5\nu_min = [-1]"}},
       {"34:11: limits.horizon: needs lqr.cost = \"sampled\" or \"discrete\": …"}},
      {"limits that are foreseen with a law of a horizon",
       {{16, "[lqr]\nhorizon = 9"}, {34, "horizon = 5\nu_min = [-1]"}},
       {"35:11: limits.horizon: needs one plant and lqr.horizon = 0: …"}},
      {"more limits that are foreseen than a byte counts",
       {{34, "horizon = 300\nstates = { v1 = 1 }\nu_min = [-1]"}},
       {"34:11: limits.horizon: expected at most 255 limits that are looked at, found 599: …"}},
      {"disturbances that the one output does not tell",
       {{0,
         "name = \"base\"\n[plant]\ndomain = \"discrete\"\nsample_time = 0.1\nA = [[0.9, 0.1], [0, 0.8]]\n"
         "B = [[1, 0], [0, 1]]\nC = [[1, 0]]\n[kalman]\nprocess_noise = [1, 1]\nmeasurement_noise = [1]\n"
         "disturbance = { u0 = 1, u1 = 1 }\n"}},
       {"11:15: kalman.disturbance: …z = 1…is seen in no output…at most as many as outputs…"}},
      {"late output without a filter",
       {{0,
         "name = \"base\"\n[plant]\ndomain = \"discrete\"\nsample_time = 0.1\nA = [[0.9]]\nB = [[1]]\n"
         "C = [[1]]\noutput_delay = [0.1]\n[lqr]\nQ_output = [1]\nR = [1]\n"}},
       {"8:16: plant.output_delay: needs [kalman]: only the filter knows late outputs"}},
      {"folded form of a law with limits",
       {{40, "realisation = \"folded\""}},
       {"40:15: code.realisation: expected \"physical\": with [limits] x̂ has to hear of the input that was applied"}},
      {"folded form of a gain that is not constant",
       {{27, "gain = \"online\""}, {33, "", 35}, {40, "realisation = \"folded\""}},
       {"40:15: code.realisation: expected \"physical\": the filter's gain is not constant"}},
      {"modal form of a schedule of gains",
       {{27, "gain = \"schedule\""}, {33, "", 35}, {40, "realisation = \"modal\""}},
       {"40:15: code.realisation: expected \"physical\": the filter's gain is not constant"}},
      {"folded form in the library's loops",
       {{33, "", 35}, {40, "style = \"compact\"\nrealisation = \"folded\""}},
       {"41:15: code.realisation: expected \"physical\": the library's loops, style = \"compact\", are of x̂"}},
      {"compensator beside limits",
       {{36, "[compensator]\norder = 2\n"}},
       {"33:1: limits: does not go together with [compensator]: it does not hear of the input that was applied"}},
      {"compensator of more states than the plant",
       {{33, "[compensator]\norder = 5\n", 35}},
       {"34:9: compensator.order: expected 1 to 4, the states of the plant, found 5"}},
      {"compensator with a gain that changes",
       {{27, "gain = \"online\""}, {33, "[compensator]\norder = 2\n", 35}},
       {"27:8: kalman.gain: does not go together with [compensator]: expected \"steady\""}},
      {"compensator of a continuous cost and of noise between samples",
       {{20, "cost = \"continuous\""}, {33, "[compensator]\norder = 2\n", 35}},
       {"26:9: kalman.noise: the continuous compensator counts with densities: expected \"continuous\""}},
      {"continuous compensator that is too fast for the samples",
       {{0,
         "name = \"base\"\n[plant]\ndomain = \"continuous\"\nsample_time = 2\nA = [[0, 1], [2, 0]]\nB = [[0], [1]]\n"
         "C = [[1, 0]]\n[lqr]\nQ = [1, 1]\nR = [1]\ncost = \"continuous\"\n[kalman]\nprocess_noise = [1, 1]\n"
         "measurement_noise = [0.1]\ngain = \"steady\"\n[compensator]\norder = 2\n"}},
       {"11:8: lqr.cost: the continuous compensator, sampled exactly, does not stabilise the sampled plant: expected a "
        "shorter plant.sample_time, or \"sampled\""}},
      {"output that always drops out",
       {{14, "outputs = [\"y1 [m]\", \"y2 [m]\"]\ndropout = [1, 0]"}, {33, "", 35}},
       {"15:11: plant.dropout: expected a probability from 0 to below 1, found 1 for output 0"}},
      {"jitter of more than a period",
       {{14, "outputs = [\"y1 [m]\", \"y2 [m]\"]\njitter = 0.6"}, {33, "", 35}},
       {"15:10: plant.jitter: expected less than plant.sample_time, 0.5, found 0.6"}},
      {"uncertainty of nothing",
       {{33, "[[uncertain]]\nA = [[0, 0, 0, 0], [0, 0, 0, 0], [0, 0, 0, 0], [0, 0, 0, 0]]\n", 35}},
       {"…uncertain[0]: expected A, B or C with an entry that is not 0"}},
      {"plant that no law keeps in bounds in the mean square",
       {{0,
         "name = \"base\"\n[plant]\ndomain = \"discrete\"\nsample_time = 1\nA = [[2]]\nB = [[1]]\n[lqr]\nQ = [1]\n"
         "R = [1]\n[[uncertain]]\nB = [[0.578]]\n"}},
       {"…uncertain: expected a plant that can be stabilised in the mean square: whatever the law, its second moments "
        "grow by a factor of 1.0017 in a sample; less uncertainty may do"}},
      {"filter alone of a plant whose second moments grow",
       {{0,
         "name = \"base\"\n[plant]\ndomain = \"discrete\"\nsample_time = 1\nA = [[0.9]]\nC = [[1]]\n[kalman]\n"
         "process_noise = [1]\nmeasurement_noise = [1]\ngain = \"steady\"\n[[uncertain]]\nA = [[0.5]]\n"}},
       {"…uncertain: expected a plant whose state has bounded second moments, …they grow by a factor of 1.06 in a "
        "sample"}},
  };
}
