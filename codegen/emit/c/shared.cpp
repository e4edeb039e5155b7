// SPDX-License-Identifier: MIT
// Straight-line code whose outputs share what runs over P, and which predicts P column by column.
#include "emit/c/function_bodies.hpp"
#include "emit/c/straight_line.hpp"
#include "emit/c/templates.hpp"
#include "emit/recorded/constants.hpp"
#include "emit/recorded/shared_covariance.hpp"
#include "emit/text/wording.hpp"
#include "trace/print.hpp"

namespace lqg::emit {

namespace {

const std::string& name_of_output(const Controller& controller, int i) {
  return controller.problem.plant.outputs[static_cast<std::size_t>(i)].name;
}

// "static const {real} {NAME}_W[size] = {…};"
std::string table_of(const Controller& controller, const std::string& suffix, const std::string& size,
                     const design::RealMatrix& values) {
  return fill("static const {real} {NAME}_" + suffix + size + " = {\n", common_words(controller)) +
         array_values(values, controller.target.is_double) + "};\n";
}

bool loops_over_entries(const Controller& controller) { return controller.sharing == controller::Sharing::entries; }

// c + a b, or c − a b, as the trace rounds them.
std::string multiply_add(const Controller& controller, const std::string& a, const std::string& b, const std::string& c,
                         bool subtracts) {
  if (!controller.target.is_fused) return c + (subtracts ? " - (" : " + (") + a + " * " + b + ")";
  return std::string(controller.target.is_double ? "fma(" : "fmaf(") + (subtracts ? "-" : "") + a + ", " + b + ", " +
         c + ")";
}

design::RealMatrix lower_row_by_row(const design::RealMatrix& matrix) {
  const auto n = static_cast<int>(matrix.rows());
  design::RealMatrix row(1, n * (n + 1) / 2);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j <= i; ++j) row(0, step::triangle(i, j)) = matrix(i, j);
  return row;
}

// The constants of the functions below: W, and C of the outputs that are projected.
std::string tables(const Controller& controller) {
  const design::OnlineSolution& online = *controller.solution.online;
  const std::string triangle = std::to_string(controller.size.nx * (controller.size.nx + 1) / 2);
  return gain_tables(controller) +
         (loops_over_columns(controller) ? table_of(controller, "W", "[" + triangle + "]", lower_row_by_row(online.W))
                                         : "") +
         (projects(controller) ? table_of(controller, "C", "[" + std::to_string(online.C.size()) + "]", online.C) : "");
}

// A body that begins with a call.
std::string begun_by(const std::string& call, std::string body) {
  const std::string strict = "    LQG_STRICT_BODY\n";
  return body.replace(0, strict.size(), strict + call);
}

std::string use_function(const Controller& controller, int i) {
  std::string call;
  if (is_projected(controller, i))
    call = "    {name}_project(self, &{NAME}_C[" + std::to_string(i) + " * {NAME}_NX], cov);\n";
  if (is_column(controller, i))
    call = "    {name}_column(self, " + std::to_string(*measured_state(controller, i)) + ", cov);\n";
  call = fill(call, common_words(controller));
  const TracedFunction traced = trace_use(controller, i);
  return write_function(
      templates::shared_use, controller,
      {{"output", name_of_output(controller, i)}, {"body", begun_by(call, body(controller, traced, {"self"}))}});
}

// For the rows of each block: the call, guarded where not all rows of P need it.
std::string calls_of_rows(const Controller& controller, const std::string& arguments, bool is_guarded) {
  std::string out;
  for (const auto& [first, end] : blocks_of_rows(controller)) {
    const std::string call =
        fill("{name}_multiply_" + std::to_string(first) + "(" + arguments + ");\n", common_words(controller));
    out += is_guarded && first > 0
               ? "        if (i >= " + std::to_string(first) + ") {\n            " + call + "        }\n"
               : "        " + call;
  }
  return out;
}

// What outputs need of P.
std::string output_functions(const Controller& controller) {
  std::string out;
  if (loops_over_entries(controller)) {
    if (takes_columns(controller)) out += write_function(templates::shared_column, controller, {});
    if (projects(controller))
      out += write_function(templates::shared_project_in_loops, controller,
                            {{"sum_of_row", multiply_add(controller, "self->P[first + k]", "c[k]", "sum", false)},
                             {"sum_of_column", multiply_add(controller, "self->P[at]", "c[k]", "sum", false)}});
    return out + write_function(templates::shared_correct_in_loops, controller,
                                {{"corrected_x", multiply_add(controller, "gain", "innovation", "self->x[j]", false)},
                                 {"corrected_P", multiply_add(controller, "gain", "cov[k]", "self->P[at]", true)}});
  }
  if (projects(controller))
    out += write_function(templates::shared_project, controller,
                          {{"body", body(controller, trace_projection(controller), {"self", "c"})}});
  return out + write_function(templates::shared_correct, controller,
                              {{"body", body(controller, trace_correction(controller), {"self"})}});
}

std::string covariance_functions(const Controller& controller) {
  std::string out = output_functions(controller);
  if (!loops_over_columns(controller)) return out;
  for (const auto& [first, end] : blocks_of_rows(controller))
    out += write_function(templates::shared_rows, controller,
                          {{"first", std::to_string(first)},
                           {"last", std::to_string(end - 1)},
                           {"body", body(controller, trace_rows(controller, first, end), {})}});
  return out +
         write_function(
             templates::shared_predict_covariance, controller,
             {{"columns", calls_of_rows(controller, "zero, v, &AP[j], {NAME}_NX", false)},
              {"rows", calls_of_rows(controller, "&{NAME}_W[first], &AP[i * {NAME}_NX], &self->P[first], 1", true)}});
}

// Output i in an update, of its value `given`.
std::string use(const Controller& controller, int i, const std::string& given) {
  const TracedFunction observation = trace_observation(controller, i);
  Words words = {{"output", name_of_output(controller, i)}, {"given", given}, {"observation", statements(observation)}};
  if (!observation.stores.empty()) return write_body(templates::shared_observation, controller, words);
  words.merge(common_words(controller));
  return fill(
      "    status |= {name}_use_{output}(self, {given}, cov, &reciprocal, &innovation);\n"
      "    {name}_correct(self, cov, reciprocal, innovation);\n",
      words);
}

std::string update_of(const Controller& controller, const std::string& outputs) {
  return write_body(templates::shared_update, controller,
                    {{"outputs", outputs}, {"end", end_of_body(controller, trace_end_of_update(controller))}});
}

std::string predict_of(const Controller& controller, const TracedFunction& traced) {
  const std::string advance = advance_counters(controller);
  return controller.size.nu ? body(controller, traced, {"self", "u"}, advance)
                            : body(controller, traced, {"self"}, advance);
}

std::string shared_predict_body(const Controller& controller) {
  if (!loops_over_columns(controller)) return predict_of(controller, trace_prediction(controller));
  return begun_by(fill("    {name}_predict_covariance(self);\n", common_words(controller)),
                  predict_of(controller, trace_end_of_predict(controller)));
}

}  // namespace

FunctionBodies shared_bodies(const Controller& controller) {
  FunctionBodies bodies = straight_line_bodies(controller);
  bodies.constants = tables(controller);
  bodies.resets = true;
  bodies.recover = recover_body(controller);
  if (controller.has.gate) bodies.weigh = weigh_body(controller);
  bodies.helpers = covariance_functions(controller);
  std::string outputs;
  for (int i = 0; i < controller.size.ny; ++i) {
    bodies.helpers += use_function(controller, i);
    outputs += use(controller, i, "y[" + std::to_string(i) + "]");
    if (controller.size.ny > 1 && has_update_alone(controller, i))
      bodies.updates_alone.push_back(update_of(controller, use(controller, i, "y_" + name_of_output(controller, i))));
  }
  if (controller.size.ny == 1) bodies.updates_alone = {only_update_body(controller)};
  bodies.update = update_of(controller, outputs);
  bodies.predict = shared_predict_body(controller);
  if (controller.has.regulator) bodies.control = body(controller, trace_regulator(controller), {"self"});
  return bodies;
}

}  // namespace lqg::emit
