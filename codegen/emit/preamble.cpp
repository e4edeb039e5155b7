// The top of the header: what it is, the design in words and numbers, what it costs.
#include "emit/preamble.hpp"

#include <cmath>

#include "emit/model_of.hpp"
#include "emit/realisation.hpp"
#include "emit/summary.hpp"
#include "emit/text.hpp"
#include "lqg/version.h"

namespace lqg::emit {

namespace {

std::string signals(const char* what, const std::string& array, const std::vector<design::Signal>& signals) {
  if (signals.empty()) return "";
  std::string line;
  for (std::size_t i = 0; i < signals.size(); ++i) {
    if (i) line += ", ";
    line += array + "[" + std::to_string(i) + "] " + name_with_unit(signals[i]);
  }
  return " *   " + trace::wrap(what + line, 0, 96) + "\n";
}

// A wrapped line must go on as a comment.
std::string as_comment(const std::string& text) {
  std::string out;
  for (const char& c : text) {
    out += c;
    if (c == '\n' && &c != &text.back()) out += " *       ";
  }
  return out;
}

std::string poles(const design::Poles& poles) {
  std::string out;
  for (const std::complex<double>& pole : poles) {
    if (pole.imag() < 0) continue;  // stands with its conjugate
    if (!out.empty()) out += ", ";
    out += rounded(pole.real());
    if (pole.imag() > 0) out += " ± " + rounded(pole.imag()) + "i";
  }
  return out;
}

std::string plant(const Controller& controller) {
  const design::SampledPlant& plant = controller.solution.plant;
  const bool is_double = controller.is_double();
  std::string out = " *\n * Plant, sampled every " + number(design::Real(controller.problem.plant.sample_time), true) +
                    " s:  x⁺ = A x + B u + G w,  y = C x + D u + v\n *\n";
  out += as_comment(signals("states   ", "x", state_signals(controller)));
  out += as_comment(signals("inputs   ", "u", controller.problem.plant.inputs));
  if (controller.has_filter()) out += as_comment(signals("outputs  ", "y", controller.problem.plant.outputs));
  out += " *\n" + matrix_comment("A", plant.A, is_double);
  if (controller.nu()) out += matrix_comment("B", plant.B, is_double);
  if (!controller.has_filter()) return out;
  out += matrix_comment("C", plant.C, is_double);
  if (controller.nu()) out += matrix_comment("D", plant.D, is_double);
  for (const std::size_t start : controller.stage_starts())
    if (start > 0) out += " *   from sample " + std::to_string(start) + " on another plant, whose numbers stand below\n";
  return out;
}

std::string limit(double value, const std::string& sign, bool before) {
  if (std::isinf(value)) return "";
  const std::string number = trace::literal(value, true);
  return before ? number + sign : sign + number;
}

std::string limits(const Controller& controller) {
  std::string out;
  if (!controller.problem.limits) return out;
  const design::Limits& limits = *controller.problem.limits;
  for (int i = 0; i < controller.nu(); ++i) {
    const std::string u = "u[" + std::to_string(i) + "]";
    if (limits.u_min.size())
      out += " *   " + limit(limits.u_min(i), " ≤ ", true) + u + limit(limits.u_max(i), " ≤ ", false) + "\n";
    if (controller.has_rate_limit())
      out += " *   |change of " + u + "| ≤ " + trace::literal(limits.u_rate(i), true) + " per second\n";
  }
  return out;
}

std::string integrals(const Controller& controller) {
  if (!controller.nxi()) return "";
  std::string outputs;
  for (const int i : controller.integral())
    outputs += (outputs.empty() ? "" : ", ") + controller.problem.plant.outputs[static_cast<std::size_t>(i)].name;
  return " *   ξ⁺ = ξ + T (r − y) of " + outputs + "; ξ ← ξ + H (u − what the law asked for) with the u that was applied\n" +
         matrix_comment("H", controller.laws.back()[2], controller.is_double());
}

std::string regulator(const Controller& controller) {
  if (!controller.has_regulator()) return "";
  const design::RegulatorSolution& solution = *controller.solution.regulator;
  const bool is_double = controller.is_double();
  std::string out = " *\n * Regulator  u = " + equation_of_law(controller) + ":\n *\n";
  if (controller.laws.size() > 1)
    out += " *   K of " + std::to_string(controller.laws.size()) + " samples from init on; the last one is held:\n";
  out += matrix_comment("K", solution.K, is_double);
  if (controller.laws.back()[1].size()) out += matrix_comment("Nbar", controller.laws.back()[1], is_double);
  out += integrals(controller);
  out += " *   poles of A − B K: " + poles(solution.poles) + "\n";
  return out + limits(controller);
}

std::string gains(const Controller& controller) {
  if (!controller.solution.estimator) return "";
  const design::EstimatorSolution& solution = *controller.solution.estimator;
  return matrix_comment("L", solution.L, controller.is_double()) + " *   poles of A − L_predictor C: " +
         poles(solution.poles) + "\n";
}

std::string gain_in_words(const Controller& controller) {
  if (controller.solution.online)
    return "its covariance carried on line as " +
           std::string(controller.filter() == step::Filter::ud ? "U diag(d) Uᵀ" : "a lower triangle") +
           (controller.solution.estimator ? "; in the steady state, of samples:\n" : ":\n");
  if (controller.filters.size() > 1)
    return "with the gains of " + std::to_string(controller.filters.size()) +
           " samples from init on; the last one is held; of samples:\n";
  return "with its constant gain; of samples:\n";
}

template <class Values>
std::string bounds_line(const std::string& what, const Values& values) {
  std::string list;
  for (const double value : values) list += (list.empty() ? "" : ", ") + rounded(value);
  return " *   " + as_comment(trace::wrap(what + list, 0, 96)) + "\n";
}

std::string bounds(const Controller& controller) {
  if (controller.bounds.x.empty()) return "";
  return bounds_line("x̂ begins anew when it reaches, in size: ", powers_of_two(controller.bounds.x)) +
         bounds_line("an innovation is not believed from, in size: ", controller.bounds.innovation);
}

std::string estimator(const Controller& controller) {
  if (!controller.has_filter()) return "";
  const bool is_double = controller.is_double(), is_observer = controller.problem.estimator->poles.has_value();
  std::string out = is_observer ? " *\n * Observer, " : " *\n * Kalman filter, ";
  out += controller.is_predictor() ? "predictor form (u[k] is made of the outputs up to y[k−1])"
                                   : "filter form (u[k] is made of the outputs up to y[k])";
  out += ",\n * " + gain_in_words(controller) + " *\n";
  if (!controller.solution.estimator || is_observer) return out + gains(controller) + bounds(controller);
  const design::SampledNoise& noise = controller.solution.estimator->noise;
  out += matrix_comment("G", controller.solution.plant.G, is_double);
  out += matrix_comment("W = E[w wᵀ]", noise.W, is_double);
  out += matrix_comment("V = E[v vᵀ]", noise.V, is_double);
  if (!is_zero(noise.Swv)) out += matrix_comment("E[w vᵀ]", noise.Swv, is_double);
  return out + gains(controller) + bounds(controller);
}

std::string loop(const Controller& controller) {
  const design::LoopSolution& loop = controller.solution.loop;
  std::string out;
  const auto add = [&](const char* what, const std::optional<double>& value, const char* unit) {
    if (value) out += " *   " + std::string(what) + rounded(*value) + unit + "\n";
  };
  add("gain margin         ", loop.at_input.gain_dB, " dB");
  add("phase margin        ", loop.at_input.phase_deg, "°");
  add("disk margin         ", loop.at_input.disk, "");
  add("cost per sample     ", loop.cost_per_sample, "");
  add("cost per second     ", loop.cost_per_second, "");
  return out.empty() ? "" : " *\n * Closed loop, opened at the plant's input:\n *\n" + out;
}

std::string form_figures(const char* name, const FormFigures& figures) {
  return std::string(" *   ") + name + std::to_string(figures.multiply_adds) + " multiply-adds, " +
         rounded(figures.rounding_error) + "\n";
}

std::string realisations(const Controller& controller) {
  if (!controller.realisations) return "";
  const Realisations& forms = *controller.realisations;
  std::string out = " *\n * Forms of the controller, what a sample costs, and the error of u that rounding makes (rms, beside u):\n *\n" +
                    form_figures("physical  ", forms.physical);
  if (forms.folded) out += form_figures("folded    ", *forms.folded);
  if (forms.modal) out += form_figures("modal     ", *forms.modal);
  return out + " *   of these it is the " + name_of(forms.chosen) + " one\n";
}

std::string linear_form(const Controller& controller) {
  if (!controller.linear) return "";
  const design::LinearForm& form = *controller.linear;
  const bool is_double = controller.is_double(), predicts = controller.is_predictor();
  std::string out = " *\n * The same as one linear system, equal to it in " + std::to_string(static_cast<int>(form.agreement)) +
                    " digits:\n *\n *   z⁺ = A z + B y,  u = C z" + (predicts ? "" : " + D y") + ",  x̂ = X z" +
                    (predicts ? "" : " + L y") + "\n *\n";
  out += matrix_comment("A", form.A, is_double) + matrix_comment("B", form.B, is_double) +
         matrix_comment("C", form.C, is_double);
  if (!predicts) out += matrix_comment("D", form.D, is_double);
  return out + matrix_comment("X", form.estimate, is_double);
}

std::string figures(const Controller& controller) {
  const Figures& figures = controller.figures;
  return " *\n * One sample takes " + std::to_string(figures.multiply_adds) + " multiply-adds and " +
         std::to_string(figures.ram) + " bytes of RAM; on a Cortex-M4F at -O2 about " + std::to_string(figures.flash) +
         " bytes of\n * flash and " + std::to_string(figures.stack) + " bytes of stack. Style: " +
         (controller.style == design::Style::compact ? "compact" : "unrolled") + ". Arithmetic: " +
         (controller.is_fused() ? "fused" : "plain") + ". Digits of the design: " +
         std::to_string(controller.solution.numerics.digits) + ".\n";
}

}  // namespace

std::string version() {
  return std::to_string(LQG_VERSION_MAJOR) + "." + std::to_string(LQG_VERSION_MINOR) + "." +
         std::to_string(LQG_VERSION_PATCH);
}

std::string header_format() { return std::to_string(LQG_HEADER_FORMAT); }

std::string provenance(const Controller& controller) {
  return " * Made by lqgen " + version() + " from " + controller.source.file + " with the SHA-256\n * " +
         controller.source.sha256 +
         ".\n * Do not edit: change the design and run lqgen again. This file is yours: use it under any licence.\n";
}

std::string preamble(const Controller& controller) {
  const design::Problem& problem = controller.problem;
  return "/* " + problem.name + (problem.brief.empty() ? "" : ": " + problem.brief) + "\n *\n" + provenance(controller) +
         plant(controller) + regulator(controller) + estimator(controller) + linear_form(controller) + loop(controller) +
         realisations(controller) + figures(controller) +
         " */\n";
}

std::string summary(const Controller& controller) {
  std::string comment = controller.problem.name + "\n" + regulator(controller) + gains(controller) + loop(controller) +
                        realisations(controller) + figures(controller), out;
  for (std::size_t at = 0; at < comment.size();) {
    const std::size_t end = comment.find('\n', at) + 1;
    const std::string line = comment.substr(at, end - at);
    out += line.rfind(" * ", 0) == 0 ? line.substr(3) : line.rfind(" *", 0) == 0 ? line.substr(2) : line;
    at = end;
  }
  return out;
}

}  // namespace lqg::emit
