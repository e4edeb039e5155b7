// SPDX-License-Identifier: MIT
#include "controller/state_fields.hpp"

#include "controller/model_of.hpp"
#include "controller/rounding.hpp"

namespace lqg::controller {

namespace {

using Fields = std::vector<Field>;

void add_reals(Fields& fields, const std::string& name, int count, const std::string& dimension,
               const std::string& comment, std::vector<double> initial = {}) {
  if (count > 0) fields.push_back({name, Kind::reals, count, dimension, comment, std::move(initial)});
}

// What is said of a field whose numbers are not those of the caller.
std::string deviation_of(const Eigen::VectorXd& point) {
  return point.size() ? "; deviations from the operating point" : "";
}

void add_estimate(const Controller& controller, Fields& fields) {
  const bool is_double = controller.target.is_double;
  const auto model =
      model_of<double>(controller, [&](const design::Real& value) { return rounded_to_target(value, is_double); });
  const auto size = [](const std::vector<double>& values) { return static_cast<int>(values.size()); };
  const std::string estimate = controller.modal ? "z of the estimate x̂ = T z" : "estimate x̂";
  const std::string error = controller.modal ? "z" : "x̂";
  add_reals(
      fields, controller::kept_name(controller), model.nx, "{NAME}_NX",
      estimate + ": of this sample after update, of the next one after predict" + deviation_of(controller.point.x),
      {model.x0.data(), model.x0.data() + model.nx});
  add_reals(fields, "P", size(model.P0), std::to_string(model.P0.size()),
            "covariance of the error of " + error + ": lower triangle, P_ij at [i*(i+1)/2 + j]", model.P0);
  add_reals(fields, "U", size(model.U0), std::to_string(model.U0.size()),
            "P = U diag(d) Uᵀ: strict upper triangle, U_ij at [j*(j-1)/2 + i]", model.U0);
  add_reals(fields, "d", size(model.D0), "{NAME}_NX", "diagonal of P = U diag(d) Uᵀ", model.D0);
}

// Of an extended filter: that of the operating point.
std::vector<double> input_at_start(const Controller& controller) {
  const auto u = start_of_input<double>(
      controller, [&](const design::Real& value) { return rounded_to_target(value, controller.target.is_double); });
  return {u.data(), u.data() + u.size()};
}

// The gate at the start.
std::vector<double> start_of_gate(const Controller& controller) {
  const Eigen::VectorXd& start = controller.gate.start;
  return {start.data(), start.data() + start.size()};
}

void add_law(const Controller& controller, Fields& fields) {
  const int nxi = controller.size.nxi;
  const Eigen::VectorXd& r = controller.point.r;
  add_reals(fields, "r", controller.size.nr, "{NAME}_NR",
            std::string("references") + (r.size() ? " in the units of the outputs" : "") +
                ": write them at any time between two calls",
            {r.data(), r.data() + r.size()});
  add_reals(fields, "xi", nxi, std::to_string(nxi), "ξ, integral of r − y");
  add_reals(fields, "error", nxi, std::to_string(nxi), "r − y of this sample; predict integrates it");
  add_reals(fields, "demand", nxi ? controller.size.nu : 0, "{NAME}_NU",
            "u of the law, before the limits" + deviation_of(controller.point.u));
}

void add_linear_state(const Controller& controller, Fields& fields) {
  std::vector<double> z0;
  for (int i = 0; i < controller.size.nz; ++i)
    z0.push_back(rounded_to_target(controller.linear->z0(i), controller.target.is_double));
  add_reals(fields, "z", controller.size.nz, "{NAME}_NZ", "the state of the linear system, see above", z0);
  if (!controller.is_predictor)
    add_reals(fields, "y", controller.size.ny, "{NAME}_NY",
              "outputs of this sample, for advance" + deviation_of(controller.point.y));
}

}  // namespace

std::vector<Field> state_fields(const Controller& controller) {
  Fields fields;
  const Field resets = {"resets", Kind::total, 1, "", "resets of the state since init; wraps to 0", {}};
  if (controller.linear) {
    add_linear_state(controller, fields);
    fields.push_back(resets);
    return fields;
  }
  if (controller.has.filter) add_estimate(controller, fields);
  if (controller.keeps.input)
    add_reals(fields, "u_applied", controller.size.nu, "{NAME}_NU",
              "input that acts: of the last predict or control" + deviation_of(controller.point.u),
              is_extended(controller) ? input_at_start(controller) : std::vector<double>());
  if (controller.has.gate)
    add_reals(fields, "widening", controller.size.ny, "{NAME}_NY",
              "w ≥ 1, widening of the gate: it grows while the output is rejected", start_of_gate(controller));
  if (controller.keeps.innovation)
    add_reals(fields, "innovation", controller.size.ny, "{NAME}_NY", "of the last outputs, for predict");
  if (controller.has.servo) add_law(controller, fields);
  if (controller.keeps.sample)
    fields.push_back(
        {"sample", Kind::counter, 1, "", "number of the sample; stops at the last that has gains of its own", {}});
  if (controller.keeps.gain_row)
    fields.push_back({"gain_row", Kind::counter, 1, "", "row of the filter's gains; 0 after a reset", {}});
  if (controller.has.filter) fields.push_back(resets);
  if (controller.solution.online)
    fields.push_back({"covariance_resets", Kind::total, 1, "", "resets of P alone since init; wraps to 0", {}});
  if (controller.has.gate)
    fields.push_back({"gated",
                      Kind::counters,
                      controller.size.ny,
                      "{NAME}_NY",
                      "how often the gate has rejected an output; wraps to 0",
                      {}});
  return fields;
}

// Counters have four bytes on the targets.
long state_bytes(const Controller& controller) {
  const long real = controller.target.is_double ? 8 : 4;
  long bytes = 0;
  for (const Field& field : state_fields(controller)) bytes += (field.kind == Kind::reals ? real : 4) * field.count;
  return (bytes + real - 1) / real * real;
}

}  // namespace lqg::controller
