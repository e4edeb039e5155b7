// SPDX-License-Identifier: MIT
#include "emit/recorded/place_names.hpp"

#include "emit/text/wording.hpp"

namespace lqg::emit {

namespace {

using Kind = step::Place::Kind;

design::Signal signal_at(const Controller& controller, const step::Place& place) {
  const design::Plant& plant = controller.problem.plant;
  const auto i = static_cast<std::size_t>(place.i);
  switch (place.kind) {
    case Kind::state: return kept_signals(controller)[i];
    case Kind::input: return plant.inputs[i];
    case Kind::output: return plant.outputs[i];
    case Kind::reference: return reference_signals(controller)[i];
    default: return plant.outputs[static_cast<std::size_t>(controller.integrated[i])];
  }
}

}  // namespace

std::string index_suffix(int i, int j, int size) {
  if (i < 0) return "";
  if (j < 0) return "_" + std::to_string(i);
  return "_" + std::to_string(i) + (size > 10 ? "_" : "") + std::to_string(j);
}

std::string suffix_of(const Controller& controller, const step::Place& place) {
  if (place.kind == Kind::single) return "";
  const std::string of = *place.of ? std::string("_") + place.of : "";
  if (place.kind != Kind::entry) return of + "_" + signal_at(controller, place).name;
  return of + index_suffix(place.i, place.j, controller.size.nx) +
         (place.without < 0 ? "" : "_without_" + std::to_string(place.without));
}

std::set<std::string> reserved_names(const Controller& controller) {
  std::set<std::string> names = {"self",    "status", "x",      "u",          "y",      "r",    "P",
                                 "S",       "i",      "heard",  "there",      "lost",   "law",  "gains",
                                 "limits",  "widen",  "narrow", "innovation", "reason", "sums", "u_char",
                                 "u_short", "u_int",  "u_long"};  // the last are types of POSIX
  const std::string& name = controller.problem.name;
  for (const char* what : {"t",         "init",      "reset",         "recover",    "weigh",      "update",
                           "control",   "predict",   "step",          "covariance", "innovation", "partial_update",
                           "set_state", "set_input", "control_fault", "step_fault", "advance",    "advance_fault",
                           "move",      "hear",      "estimate"})
    names.insert(name + "_" + what);
  for (const design::Signal& output : controller.problem.plant.outputs) names.insert(name + "_update_" + output.name);
  if (!controller.target.is_lane) return names;
  names.insert({"lane", "usual", "unusual", "unusual_lanes", "before"});
  for (const char* what : {"t", "init", "get", "set", "redo", "step"}) names.insert(name + "_batch_" + what);
  return names;
}

}  // namespace lqg::emit
