// SPDX-License-Identifier: MIT
#include "emit/c/preamble.hpp"

#include "emit/c/contents.hpp"
#include "emit/text/description.hpp"
#include "emit/text/equations.hpp"
#include "emit/text/order_description.hpp"
#include "emit/text/parameter_description.hpp"
#include "emit/text/wording.hpp"

namespace lqg::emit {

namespace {

// Each line of `text` as one of a comment.
std::string comment_lines(const std::string& text) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = text.find('\n', at) + 1;
    out += (end == at + 1 ? " *" : " * ") + text.substr(at, end - at);
    at = end;
  }
  return out;
}

}  // namespace

std::string preamble(const Controller& controller, const std::string& functions) {
  const design::Problem& problem = controller.problem;
  return "/* " + problem.name + (problem.brief.empty() ? "" : ": " + problem.brief) + "\n *\n" +
         provenance(controller) + " *\n" + table_of_contents(controller, functions) +
         comment_lines(describe_parameters(controller) + describe_expressions(controller) + describe_plant(controller) +
                       describe_equations(controller) + describe_regulator(controller) +
                       describe_estimator(controller) + describe_linear_form(controller) +
                       describe_compensator(controller) + describe_white(controller) + describe_modes(controller) +
                       describe_loop(controller) + describe_forms(controller) + describe_cost(controller)) +
         " */\n";
}

}  // namespace lqg::emit
