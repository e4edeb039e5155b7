// SPDX-License-Identifier: MIT
#include "emit/c/linear_functions.hpp"

#include "emit/c/operating_point.hpp"
#include "emit/c/straight_line.hpp"
#include "emit/c/templates.hpp"
#include "emit/recorded/linear_traced.hpp"
#include "emit/recorded/trace_listener.hpp"
#include "trace/print.hpp"

namespace lqg::emit {

namespace {

std::string functions_of_filter_form(const Controller& controller, const TracedLinear& traced) {
  return write_function(templates::linear_filter_form, controller,
                        {{"control_fault", body(controller, traced.control_fault, {"self"})},
                         {"control", body(controller, traced.control, {"self"})},
                         {"advance", body(controller, traced.advance, {"self"})},
                         {"step", body(controller, traced.step, {"self"})}});
}

// sum − sum = 0, beside which a prover reads that each y is finite.
std::string all_finite(const Controller& controller, const std::string& sum) {
  const std::string test = "(" + sum + " - " + sum + ") == " + trace::literal(0, controller.target.is_double);
  if (!controller.target.is_prover) return test;
  std::string facts;
  for (int i = 0; i < controller.size.ny; ++i) facts += (i ? " && FINITE(" : "FINITE(") + element("y", i) + ")";
  return "RESTATED(" + test + ", " + facts + ")";
}

// y_0 + y_1 + …, which is finite where each is: its statements, and the test.
Words sum_of_outputs(const Controller& controller) {
  const std::string declare = controller.target.is_double ? "    const double " : "    const float ";
  const std::vector<design::Signal>& outputs = controller.problem.plant.outputs;
  const std::string first = "y_" + outputs[0].name;
  if (controller.size.ny == 1)
    return {{"sum_of_outputs", declare + first + " = y[0];\n"}, {"all_finite", all_finite(controller, first)}};
  std::string statements, sum = "y[0]";
  for (std::size_t i = 1; i < outputs.size(); ++i) {
    const std::string name = "sum_to_y_" + outputs[i].name;
    statements += declare + name + " = " + sum + " + y[" + std::to_string(i) + "];\n";
    sum = name;
  }
  return {{"sum_of_outputs", statements}, {"all_finite", all_finite(controller, sum)}};
}

std::string functions_of_predictor_form(const Controller& controller, const TracedLinear& traced) {
  Words words = sum_of_outputs(controller);
  words["control_fault"] = body(controller, traced.control_fault, {"self"});
  words["control"] = body(controller, traced.control, {"self"});
  words["advance"] = body(controller, traced.advance, {"self", "y"});
  words["step"] = body(controller, traced.step, {"self"});
  words["hear"] = body(controller, traced.hear, {"self"});
  words["declare_deviations"] = declare_deviations(controller, 'y');
  words["given"] = deviations(controller, 'y');
  words["less_point"] = controller.point.y.size() ? " as deviations from the operating point" : "";
  return write_function(templates::linear_predictor_form, controller, words);
}

std::string head_of_estimate(const Controller& controller) {
  const bool predicts = controller.is_predictor;
  const std::string when =
      predicts ? "; after advance that of the next sample." : ". Call it between control and advance.";
  if (!controller.solution.compensator) return "/* The estimate x̂ of this sample, of which u = −K x̂ is made" + when;
  return std::string("/* x̂, the best linear estimate of the state of this sample that z ") +
         (predicts ? "allows" : "and y allow") + "; u is not made of it.\n * " +
         (predicts ? "After advance it is that of the next sample." : "Call it between control and advance.");
}

std::string head_of_set_state(const Controller& controller) {
  return controller.solution.compensator
             ? "/* z with which the loop costs least where the state is x, set from outside."
             : "/* x̂ ← x, set from outside.";
}

}  // namespace

std::string linear_functions(const Controller& controller) {
  const TracedLinear traced = trace_linear(controller);
  return (controller.is_predictor ? functions_of_predictor_form(controller, traced)
                                  : functions_of_filter_form(controller, traced)) +
         write_function(templates::linear_state, controller,
                        {{"what", head_of_estimate(controller)},
                         {"begin_set_state", head_of_set_state(controller)},
                         {"estimate", body(controller, traced.estimate, {"self"})},
                         {"set_state", body(controller, traced.set_state, {"self"})}});
}

}  // namespace lqg::emit
