// SPDX-License-Identifier: MIT
#include "emit/text/order_description.hpp"

#include "design/rounding.hpp"
#include "emit/text/columns.hpp"
#include "emit/text/wording.hpp"
#include "trace/wrap.hpp"

namespace lqg::emit {

namespace {

std::string lines_of(const Facts& facts) {
  std::size_t widest = 0;
  for (const auto& [name, value] : facts) widest = std::max(widest, columns(name));
  std::string out;
  for (const auto& [name, value] : facts)
    out += "  " + name + std::string(widest + 3 - columns(name), ' ') + value + "\n";
  return out;
}

std::string poles_in_words(const design::Poles& poles) {
  std::string out;
  for (const std::complex<double>& pole : poles) {
    if (pole.imag() < 0) continue;  // stands with its conjugate
    out += (out.empty() ? "" : ", ") + decimal(pole.real());
    if (pole.imag() > 0) out += " ± " + decimal(pole.imag()) + "i";
  }
  return out;
}

bool is_continuous(const Controller& controller) { return controller.solution.compensator->A_continuous.size() > 0; }

std::string count_of(int count, const std::string& what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

std::string estimated(const Controller& controller) {
  const std::vector<design::Signal> states = state_signals(controller);
  std::string out;
  for (const int i : controller.solution.compensator->estimates) {
    const auto at = static_cast<std::size_t>(i);
    out += (out.empty() ? "" : ", ") + (at < states.size() ? states[at].name : "the last input");
  }
  return out;
}

std::string margins_in_words(const design::Margins& margins) {
  std::string out;
  const auto add = [&](const std::optional<double>& value, const std::string& unit) {
    if (value) out += (out.empty() ? "" : ", ") + decimal(*value) + unit;
  };
  add(margins.gain_dB, " dB");
  add(margins.phase_deg, "°");
  if (margins.disk) add(margins.disk, " (disk)");
  return out.empty() ? "none: the loop is unstable" : out;
}

std::string growth_in_words(double growth) {
  return (growth < 1 ? "decay by a factor of " : "grow by a factor of ") + decimal(growth) + " in a sample";
}

std::string keeps_modes(const Controller& controller) {
  return controller.linear && !(controller.linear->A - controller.solution.compensator->A).isZero(0)
             ? "z: the modes of the compensator"
             : "z: its estimates of " + estimated(controller);
}

}  // namespace

std::optional<double> gap_percent(const design::CompensatorSolution& compensator) {
  if (!compensator.full_cost || !(*compensator.full_cost > 0)) return std::nullopt;
  return 100 * (design::to_double(compensator.cost) / *compensator.full_cost - 1);
}

Facts facts_of_optimum(const Controller& controller) {
  if (!controller.solution.compensator) return {};
  const design::CompensatorSolution& own = *controller.solution.compensator;
  const std::string per = is_continuous(controller) ? "cost per second" : "cost per sample";
  Facts facts = {{per, decimal(design::to_double(own.cost)) + ", a local minimum"},
                 {"reached", "from " + std::to_string(own.reached) + " of " + count_of(own.starts, "start")},
                 {"least curvature", decimal(own.curvature) + " of the largest: the minimum is strict"}};
  if (own.full_cost) {
    const std::string bound = controller.solution.white ? "LQG without white parameters" : "LQG, of full order";
    facts.push_back({"no cost is less than", decimal(*own.full_cost) + ", that of " + bound});
    if (const std::optional<double> gap = gap_percent(own)) facts.push_back({"gap", decimal(*gap) + " %"});
  }
  if (own.held_cost_per_second)
    facts.push_back({"sampled", decimal(*own.held_cost_per_second) + " per second, with y and u held"});
  facts.push_back({"its own poles", poles_in_words(own.poles)});
  return facts;
}

Facts facts_of_white(const Controller& controller) {
  if (!controller.solution.white) return {};
  const design::WhiteReport& white = *controller.solution.white;
  Facts facts = {{"second moments", growth_in_words(white.growth)}};
  if (white.cost_nominal)
    facts.push_back({"cost where nothing is random", decimal(*white.cost_nominal) + " per sample"});
  facts.push_back({"margins", margins_in_words(controller.solution.loop.at_input)});
  facts.push_back({"unaware design, second moments", growth_in_words(white.growth_unaware)});
  if (controller.solution.compensator)
    facts.push_back(
        {"unaware design, cost", white.cost_unaware ? decimal(*white.cost_unaware) + " per sample" : "without bound"});
  facts.push_back({"unaware design, margins", margins_in_words(white.margins_unaware)});
  return facts;
}

std::string describe_optimum(const Controller& controller) {
  if (!controller.solution.compensator) return "";
  return "\nCompensator of " + count_of(static_cast<int>(controller.solution.compensator->A.rows()), "state") +
         ":\n\n" + lines_of(facts_of_optimum(controller));
}

std::string describe_white(const Controller& controller) {
  if (!controller.solution.white) return "";
  return "\nWhite parameters, beside the design that does not know of them:\n\n" + lines_of(facts_of_white(controller));
}

std::string describe_compensator(const Controller& controller) {
  if (!controller.solution.compensator || !controller.linear) return "";
  const design::LinearForm& form = *controller.linear;
  const design::SampledNoise& noise = controller.solution.estimator->noise;
  const bool is_double = controller.target.is_double, predicts = controller.is_predictor;
  std::string out = "\nCompensator of " + count_of(controller.size.nz, "state") + ", " +
                    (predicts ? "predictor form (u[k] depends on the outputs up to y[k−1])"
                              : "filter form (u[k] depends on the outputs up to y[k])") +
                    ":\n\n  z⁺ = A z + B y,  u = C z" + (predicts ? "" : " + D y") + "\n\n  " +
                    trace::wrap(keeps_modes(controller), 2, 96) + "\n";
  out += matrix_lines("A", form.A, is_double) + matrix_lines("B", form.B, is_double) +
         matrix_lines("C", form.C, is_double);
  if (!predicts) out += matrix_lines("D", form.D, is_double);
  out += std::string("  x̂ = X z") + (predicts ? "" : " + Y y") + ": the best linear estimate of the states that z " +
         (predicts ? "allows" : "and y allow") + "\n";
  out += matrix_lines("X", form.estimate, is_double);
  if (!predicts) out += matrix_lines("Y", form.heard, is_double);
  out += "\nIt is made for these covariances per sample:\n\n" +
         matrix_lines("G", controller.solution.plant.G, is_double) + matrix_lines("W = E[w wᵀ]", noise.W, is_double) +
         matrix_lines("V = E[v vᵀ]", noise.V, is_double);
  if (!design::is_zero(noise.Swv)) out += matrix_lines("E[w vᵀ]", noise.Swv, is_double);
  return out + "\nThe optimum:\n\n" + lines_of(facts_of_optimum(controller));
}

}  // namespace lqg::emit
