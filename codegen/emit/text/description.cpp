// SPDX-License-Identifier: MIT
#include "emit/text/description.hpp"

#include <cmath>

#include "controller/operating_point.hpp"
#include "emit/text/continuous_pole.hpp"
#include "emit/text/extended_description.hpp"
#include "emit/text/wording.hpp"
#include "trace/print.hpp"
#include "trace/wrap.hpp"

namespace lqg::emit {

namespace {

std::string signals(const char* what, const std::string& array, const std::vector<design::Signal>& signals) {
  if (signals.empty()) return "";
  std::string line;
  for (std::size_t i = 0; i < signals.size(); ++i) {
    if (i) line += ", ";
    line += array + "[" + std::to_string(i) + "] " + name_with_unit(signals[i]);
  }
  return "  " + trace::wrap(what + line, 0, 96) + "\n";
}

// A wrapped line goes on further in.
std::string indented(const std::string& text) {
  std::string out;
  for (const char& c : text) {
    out += c;
    if (c == '\n' && &c != &text.back()) out += "      ";
  }
  return out;
}

std::string pair(const std::complex<double>& pole) {
  return decimal(pole.real()) + (pole.imag() > 0 ? " ± " + decimal(pole.imag()) + "i" : "");
}

std::string poles(const design::Poles& poles) {
  std::string out;
  for (const std::complex<double>& pole : poles) {
    if (pole.imag() < 0) continue;  // stands with its conjugate
    if (!out.empty()) out += ", ";
    out += pair(pole);
  }
  return out;
}

std::string poles_line(const std::string& matrix, const design::Poles& of) {
  return "  " + indented(trace::wrap("poles of " + matrix + ": " + poles(of), 0, 96)) + "\n";
}

}  // namespace

std::string describe_plant(const Controller& controller) {
  if (controller::is_extended(controller)) return describe_extended_plant(controller);
  const design::SampledPlant& plant = controller.solution.plant;
  const bool is_double = controller.target.is_double;
  std::string out = describe_point(controller) + "\nPlant, sampled every " +
                    number(design::Real(controller.problem.plant.sample_time), true) +
                    " s:  x⁺ = A x + B u + G w,  y = C x + D u + v\n\n";
  out += indented(signals("states   ", "x", state_signals(controller)));
  out += indented(signals("inputs   ", "u", controller.problem.plant.inputs));
  if (controller.has.filter) out += indented(signals("outputs  ", "y", controller.problem.plant.outputs));
  out += "\n" + matrix_lines("A", plant.A, is_double);
  if (controller.size.nu) out += matrix_lines("B", plant.B, is_double);
  if (!controller.has.filter) return out;
  out += matrix_lines("C", plant.C, is_double);
  if (controller.size.nu) out += matrix_lines("D", plant.D, is_double);
  for (const std::size_t start : controller.stage_starts)
    if (start > 0)
      out += "  from sample " + std::to_string(start) + " on another plant, with its numbers in the code\n";
  return out;
}

namespace {

std::string limit(double value, const std::string& sign, bool before) {
  if (std::isinf(value)) return "";
  const std::string number = trace::literal(value, true);
  return before ? number + sign : sign + number;
}

// "  -0.5 ≤ speed ≤ 0.5, or price 1000000 · excess²\n"
std::string soft_limits(const design::SoftLimits& limits, const std::vector<design::Signal>& signals,
                        const std::string& end) {
  std::string out;
  for (Eigen::Index i = 0; i < limits.range.rows(); ++i) {
    const double low = limits.range(i, 0), high = limits.range(i, 1);
    if (std::isinf(low) && std::isinf(high)) continue;
    out += "  " + limit(low, " ≤ ", true) + signals[static_cast<std::size_t>(i)].name + limit(high, " ≤ ", false) +
           end + ", soft: " + decimal(limits.price(i)) + " · excess²\n";
  }
  return out;
}

std::string origin_of_iterations(const Controller& controller) {
  const controller::Iterations& iterations = controller.iterations;
  if (iterations.origin == controller::Iterations::Origin::file) return "limits.iterations";
  if (iterations.origin == controller::Iterations::Origin::cap) return "a cap, not a bound: none was proved";
  std::string states;
  for (Eigen::Index i = 0; i < controller.worth->reach.size(); ++i)
    states += (states.empty() ? "" : ", ") + decimal(controller.worth->reach(i));
  return "proved for |x_i| up to " + states + ", but nearer than " + decimal(iterations.tie_distance) +
         " of that to a tie of two decisions";
}

std::string foreseen_limits(const Controller& controller) {
  if (!controller.has.foresight) return "";
  const design::Limits& limits = *controller.problem.limits;
  const design::Plant& plant = controller.problem.plant;
  return soft_limits(controller::own_state_limits(controller), plant.states, "") +
         soft_limits(controller::own_output_limits(controller), plant.outputs, "") +
         soft_limits(limits.output_rates, plant.outputs, " per second") + "  foreseen for " +
         std::to_string(limits.horizon) + " samples: " + std::to_string(controller.solution.foreseen->G.rows()) +
         " limited quantities, at most " + std::to_string(controller.iterations.most) +
         " changes of the active ones in a sample\n  (" + origin_of_iterations(controller) + ")\n";
}

std::string limits(const Controller& controller) {
  std::string out;
  if (!controller.problem.limits) return out;
  const design::Limits& limits = *controller.problem.limits;
  for (int i = 0; i < controller.size.nu; ++i) {
    const std::string u = "u[" + std::to_string(i) + "]";
    if (limits.u_min.size())
      out += "  " + limit(controller::own_input_limits(controller, +1)(i), " ≤ ", true) + u +
             limit(controller::own_input_limits(controller, -1)(i), " ≤ ", false) + "\n";
    if (controller.has.rate_limit && std::isfinite(limits.u_rate(i)))
      out += "  |change of " + u + "| ≤ " + trace::literal(limits.u_rate(i), true) + " per second\n";
  }
  return out + foreseen_limits(controller);
}

std::string integrals(const Controller& controller) {
  if (!controller.size.nxi) return "";
  std::string outputs;
  for (const int i : controller.integrated)
    outputs += (outputs.empty() ? "" : ", ") + controller.problem.plant.outputs[static_cast<std::size_t>(i)].name;
  return "  " + indented(trace::wrap("ξ⁺ = ξ + T (r − y) of " + outputs, 0, 96)) +
         "\n  anti-windup: ξ ← ξ + H (u − demand), u: what was applied, demand: what the law asked for\n" +
         matrix_lines("H", controller.laws.back()[2], controller.target.is_double);
}

}  // namespace

std::string describe_regulator(const Controller& controller) {
  if (!controller.has.regulator || controller.solution.compensator) return "";
  const design::RegulatorSolution& solution = *controller.solution.regulator;
  const bool is_double = controller.target.is_double;
  std::string out = "\nRegulator  u = " + equation_of_law(controller) + ":\n\n";
  if (controller.laws.size() > 1)
    out += "  one K for each of the first " + std::to_string(controller.laws.size()) + " samples; from then on:\n";
  out += matrix_lines("K", solution.K, is_double);
  if (controller.laws.back()[1].size()) out += matrix_lines("Nbar", controller.laws.back()[1], is_double);
  out += integrals(controller);
  out += poles_line("A − B K", solution.poles);
  return out + limits(controller);
}

// update adds L times the innovation, predict M times it. In predictor form no u is made between the two: together they
// are L_predictor = A L + M, which is M where L = 0.
std::string describe_gains(const Controller& controller) {
  if (!controller.solution.estimator || controller.solution.compensator) return "";
  const design::EstimatorSolution& solution = *controller.solution.estimator;
  const bool is_double = controller.target.is_double, predicts = controller.is_predictor;
  const bool is_in_one = predicts && is_zero(solution.L);
  std::string out;
  if (!is_in_one) out += matrix_lines("L", solution.L, is_double);
  const bool has_M = !is_in_one && !controller.solution.online && !is_zero(solution.M);
  if (has_M) out += matrix_lines("M", solution.M, is_double);
  if (predicts) out += matrix_lines("L_predictor", solution.L_predictor, is_double);
  return out + poles_line("A − L_predictor C", solution.poles);
}

namespace {

std::string gain_in_words(const Controller& controller) {
  if (controller.solution.online)
    return "covariance updated on line as " +
           std::string(controller.filter == step::Filter::ud ? "U diag(d) Uᵀ" : "a lower triangle") +
           (controller.solution.estimator ? "; covariances per sample, gain in the steady state:\n" : ":\n");
  if (controller.filters.size() > 1)
    return "one gain for each of the first " + std::to_string(controller.filters.size()) +
           " samples, then constant; covariances per sample:\n";
  return "constant gain; covariances per sample:\n";
}

template <class Values>
std::string bounds_line(const std::string& what, const Values& values) {
  std::string list;
  for (const double value : values) list += (list.empty() ? "" : ", ") + decimal(value);
  return "  " + indented(trace::wrap(what + list, 0, 96)) + "\n";
}

std::string bounds(const Controller& controller) {
  if (controller.bounds.x.empty()) return "";
  return bounds_line(std::string("limit of |") + (controller.modal ? "z_i" : "x̂_i") + "| (reset when exceeded): ",
                     controller::powers_of_two(controller.bounds.x)) +
         bounds_line("innovation limit: ", controller.bounds.innovation) +
         (controller.bounds.xi.empty()
              ? ""
              : bounds_line("limit of |ξ_i| (reset when exceeded): ", controller::powers_of_two(controller.bounds.xi)));
}

}  // namespace

std::string describe_estimator(const Controller& controller) {
  if (!controller.has.filter || controller.solution.compensator) return "";
  if (controller::is_extended(controller)) return describe_extended_filter(controller) + bounds(controller);
  const bool is_double = controller.target.is_double, is_observer = controller.problem.estimator->poles.has_value();
  std::string out = is_observer ? "\nObserver, " : "\nKalman filter, ";
  out += controller.is_predictor ? "predictor form (u[k] depends on the outputs up to y[k−1])"
                                 : "filter form (u[k] depends on the outputs up to y[k])";
  out += ",\n" + gain_in_words(controller) + "\n";
  if (!controller.solution.estimator || is_observer) return out + describe_gains(controller) + bounds(controller);
  const design::SampledNoise& noise = controller.solution.estimator->noise;
  out += matrix_lines("G", controller.solution.plant.G, is_double);
  out += matrix_lines("W = E[w wᵀ]", noise.W, is_double);
  out += matrix_lines("V = E[v vᵀ]", noise.V, is_double);
  if (!is_zero(noise.Swv)) out += matrix_lines("E[w vᵀ]", noise.Swv, is_double);
  if (controller.solution.loop.recovery)
    out += "  L is that of noise q B Bᵀ at the inputs, too: recovery, q = " +
           number(controller.solution.loop.recovery->q, true) + "\n";
  return out + describe_gains(controller) + bounds(controller);
}

namespace {

// ", up 9.5, down 6.2": how far it may rise and fall.
std::string both_directions(const design::Margins& margins) {
  return (margins.gain_up_dB ? ", up " + decimal(*margins.gain_up_dB) : "") +
         (margins.gain_down_dB ? ", down " + decimal(*margins.gain_down_dB) : "");
}

std::string at_crossover(const design::Margins& margins, double sample_time) {
  return margins.crossover ? " at " + decimal(*margins.crossover / sample_time) + " rad/s" : "";
}

std::string in_seconds(const design::Margins& margins, double sample_time) {
  return margins.delay_samples ? ", " + decimal(*margins.delay_samples * sample_time) + " s" : "";
}

std::string rms_line(const char* what, const std::vector<design::Signal>& signals, const std::vector<double>& values) {
  std::string list;
  for (std::size_t i = 0; i < values.size(); ++i)
    list += (i ? ", " : "") + signals[i].name + " " + decimal(values[i]) +
            (signals[i].unit.empty() ? "" : " " + signals[i].unit);
  return values.empty() ? "" : "  " + indented(trace::wrap(what + list, 0, 96)) + "\n";
}

}  // namespace

std::string describe_rms(const Controller& controller) {
  if (!controller.solution.loop.rms) return "";
  const design::Rms& rms = *controller.solution.loop.rms;
  const std::string alone = controller.solution.white ? " and without white parameters" : "";
  return "\nWith the noises of the design" + alone + ", r = 0 and no limits, root mean squares:\n\n" +
         rms_line("x  ", state_signals(controller), rms.x) + rms_line("u  ", controller.problem.plant.inputs, rms.u) +
         rms_line("y  ", controller.problem.plant.outputs, rms.y);
}

std::string describe_poles(const Controller& controller) {
  const double sample_time = controller.problem.plant.sample_time;
  std::string out;
  for (const std::complex<double>& pole : controller.solution.loop.poles) {
    const std::optional<ContinuousPole> s = continuous_pole(pole, sample_time);
    if (pole.imag() < 0 || !s) continue;
    out += "  z = " + pair(pole) + "   s = " + pair(s->s) + " rad/s, damping " + decimal(s->damping) + "\n";
  }
  return out.empty() ? "" : "\nPoles of the loop, s = ln(z)/T:\n\n" + out;
}

std::string describe_loop(const Controller& controller) {
  const design::LoopSolution& loop = controller.solution.loop;
  const design::Margins& margins = loop.at_input;
  const double sample_time = controller.problem.plant.sample_time;
  std::string out;
  const auto add = [&](const char* what, const std::optional<double>& value, const std::string& unit) {
    if (value) out += "  " + std::string(what) + decimal(*value) + unit + "\n";
  };
  add("gain margin         ", margins.gain_dB, " dB" + both_directions(margins));
  add("phase margin        ", margins.phase_deg, "°" + at_crossover(margins, sample_time));
  add("delay margin        ", margins.delay_samples, " samples" + in_seconds(margins, sample_time));
  add("disk margin         ", margins.disk, "");
  add("cost per sample     ", loop.cost_per_sample, "");
  add("cost per second     ", loop.cost_per_second, "");
  return out.empty() ? "" : "\nClosed loop, opened at the plant's input:\n\n" + out;
}

namespace {

std::string form_cost(const char* name, const FormCost& cost) {
  return std::string("  ") + name + std::to_string(cost.multiply_adds) + " multiply-adds, " +
         decimal(cost.rounding_error) + (cost.share_of_deviation ? ", " + decimal(*cost.share_of_deviation) : "") +
         "\n";
}

}  // namespace

std::string describe_forms(const Controller& controller) {
  if (!controller.forms) return "";
  const FormChoice& forms = *controller.forms;
  const std::string errors =
      forms.physical.share_of_deviation
          ? "the rounding error of x̂ and u\n(rms, relative to them), and of x̂ in parts of its standard deviation:\n\n"
          : "the rounding error of u (rms, relative to u):\n\n";
  std::string out =
      "\nForms of the controller: multiply-adds of a sample, and " + errors + form_cost("physical  ", forms.physical);
  if (forms.folded) out += form_cost("folded    ", *forms.folded);
  if (forms.modal) out += form_cost("modal     ", *forms.modal);
  return out + "  chosen: " + controller::name_of(forms.chosen) + "\n";
}

std::string describe_linear_form(const Controller& controller) {
  if (!controller.linear || controller.solution.compensator) return "";
  const design::LinearForm& form = *controller.linear;
  const bool is_double = controller.target.is_double, predicts = controller.is_predictor;
  std::string out = "\nThe same controller as one linear system; the two agree to " +
                    std::to_string(static_cast<int>(chosen_form(*controller.forms).agreement)) +
                    " digits:\n\n  z⁺ = A z + B y,  u = C z" + (predicts ? "" : " + D y") + ",  x̂ = X z" +
                    (predicts ? "" : " + L y") + "\n\n";
  out += matrix_lines("A", form.A, is_double) + matrix_lines("B", form.B, is_double) +
         matrix_lines("C", form.C, is_double);
  if (!predicts) out += matrix_lines("D", form.D, is_double);
  return out + matrix_lines("X", form.estimate, is_double);
}

std::string describe_modes(const Controller& controller) {
  if (!controller.modal) return "";
  const design::ModalPlant& modal = *controller.modal;
  const bool is_double = controller.target.is_double;
  std::string out = "\nThe filter keeps z, x̂ = T z, and the covariance of its error. In these coordinates:\n\n";
  out += matrix_lines("T", modal.T, is_double) + matrix_lines("A", modal.plant.A, is_double);
  if (controller.size.nu) out += matrix_lines("B", modal.plant.B, is_double);
  out += matrix_lines("C", modal.plant.C, is_double);
  return controller.has.regulator ? out + matrix_lines("K", modal.K, is_double) : out;
}

std::string describe_cost(const Controller& controller) {
  const CodeCost& cost = controller.cost;
  return "\nOne sample takes " + std::to_string(cost.multiply_adds) + " multiply-adds and " + std::to_string(cost.ram) +
         " bytes of RAM. By arm-none-eabi-gcc 12.2 at -O2, for a\nCortex-M4F, at most " + std::to_string(cost.flash) +
         " bytes of flash and " + std::to_string(cost.stack) + " bytes of stack.\nStyle: " + style_of(controller) +
         (controller.sharing == controller::Sharing::nothing    ? ""
          : controller.sharing == controller::Sharing::products ? ", products with dense matrices in loops"
                                                                : ", outputs share the functions over P") +
         ". Arithmetic: " + (controller.target.is_fused ? "fused" : "plain") +
         ". Digits of the design: " + std::to_string(controller.solution.numerics.digits) + ".\n";
}

}  // namespace lqg::emit
