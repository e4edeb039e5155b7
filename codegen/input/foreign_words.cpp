// SPDX-License-Identifier: MIT
#include "input/foreign_words.hpp"

#include <string_view>

#include "input/text.hpp"

namespace lqg::input {
namespace {

struct Word {
  std::string_view name;  // in lower case
  std::string_view path;
  std::string_view only_in = {};  // this table, "" for all
};

constexpr Word known_words[] = {
    {"ts", "plant.sample_time"},
    {"dt", "plant.sample_time"},
    {"period", "plant.sample_time"},
    {"sampling_time", "plant.sample_time"},
    {"sampling_period", "plant.sample_time"},
    {"f", "plant.A", "plant"},
    {"phi", "plant.A", "plant"},
    {"gamma", "plant.B", "plant"},
    {"dead_time", "plant.delay"},
    {"input_delay", "plant.delay"},
    {"inputdelay", "plant.delay"},
    {"iodelay", "plant.delay"},
    {"statename", "plant.states"},
    {"inputname", "plant.inputs"},
    {"outputname", "plant.outputs"},
    {"qn", "kalman.process_noise"},
    {"rn", "kalman.measurement_noise"},
    {"nn", "kalman.cross_noise"},
    {"q", "kalman.process_noise", "kalman"},
    {"r", "kalman.measurement_noise", "kalman"},
    {"n", "kalman.cross_noise", "kalman"},
    {"w", "kalman.process_noise"},
    {"v", "kalman.measurement_noise"},
    {"swv", "kalman.cross_noise"},
    {"x0", "kalman.initial_state"},
    {"p0", "kalman.initial_covariance"},
    {"ltrsyn", "kalman.recovery"},
    {"ltr", "kalman.recovery"},
    {"loop_transfer_recovery", "kalman.recovery"},
    {"transfer_recovery", "kalman.recovery"},
    {"fictitious_noise", "kalman.recovery"},
    {"qi", "lqr.integral.Q"},
    {"qf", "lqr.Q_final"},
    {"qy", "lqr.Q_output"},
    {"reference", "lqr.track"},
    {"umin", "limits.u_min"},
    {"umax", "limits.u_max"},
    {"min", "limits.u_min", "limits"},
    {"max", "limits.u_max", "limits"},
    {"slew_rate", "limits.u_rate"},
    {"gain_margin", "require.gain_margin_dB"},
    {"gm", "require.gain_margin_dB"},
    {"phase_margin", "require.phase_margin_deg"},
    {"pm", "require.phase_margin_deg"},
    {"precision", "code.real"},
};

}  // namespace

ForeignWord foreign_word(const std::string& table, const std::string& name) {
  if (name == "K")
    return {"", "K is what lqgen computes: did you mean `Q` and `R` in [lqr], or `poles` in [pole_placement]?"};
  if (name == "L")
    return {"",
            "L is what lqgen computes: did you mean `process_noise` and `measurement_noise` in [kalman], "
            "or `poles` in [observer]?"};
  for (const Word& word : known_words)
    if (word.name == in_lower_case(name) && (word.only_in.empty() || word.only_in == table))
      return {std::string(word.path), ""};
  return {};
}

}  // namespace lqg::input
