// SPDX-License-Identifier: MIT
#include "emit/proof/proof.hpp"

#include <algorithm>
#include <limits>

#include "controller/operating_point.hpp"
#include "controller/state_fields.hpp"
#include "emit/c/header.hpp"
#include "emit/text/wording.hpp"
#include "trace/print.hpp"

namespace lqg::emit {

namespace {

std::string define(const std::string& what, const std::string& value = "") {
  return "#define PROOF_" + what + (value.empty() ? "" : " " + value) + "\n";
}

// In double, as they were designed; where there is none, the largest number.
std::string limits(const std::string& what, const Eigen::VectorXd& values) {
  constexpr double largest = std::numeric_limits<double>::max();
  std::string out;
  for (const double value : values)
    out += (out.empty() ? "" : ", ") + trace::literal(std::clamp(value, -largest, largest), true);
  return define(what, "{" + out + "}");
}

// Where the counters stop.
std::string last_rows(const Controller& controller) {
  std::string out;
  if (controller.keeps.sample) out = std::to_string(controller.last_sample);
  if (controller.keeps.gain_row) out += (out.empty() ? "" : ", ") + std::to_string(controller.filters.size() - 1);
  return out.empty() ? "" : define("LAST_ROWS", out);
}

std::string words_of(const Controller& controller) {
  const std::string& name = controller.problem.name;
  std::string out = define("NAME", name) + define("UPPER_NAME", upper(name));
  out += define(controller.style == design::Style::compact ? "COMPACT" : "UNROLLED");
  if (controller.target.is_double) out += define("DOUBLE");
  if (controller.target.is_fused) out += define("FUSED");
  if (controller.has.foresight) out += define("FORESIGHT", std::to_string(controller.solution.foreseen->F.cols()));
  if (controller.has.regulator) out += define("GIVES_INPUT");
  if (!controller.bounds.x.empty()) out += define("BOUNDS");
  const std::vector<Field> fields = controller::state_fields(controller);
  if (!fields.empty()) out += define("HAS_LOOP");
  for (const Field& field : fields) out += define("KEEPS_" + field.name);
  if (const auto& given = controller.problem.limits; given && given->u_min.size())
    out += limits("U_MIN", controller::own_input_limits(controller, +1)) +
           limits("U_MAX", controller::own_input_limits(controller, -1));
  return out + last_rows(controller);
}

}  // namespace

std::string proof(const Controller& controller) {
  Controller read = controller;
  read.target.is_prover = true;
  return "/* For test/proof/prove.sh, which says what it proves. Beside each test stands what follows from it. */\n" +
         words_of(controller) + "\n" + header(read);
}

}  // namespace lqg::emit
