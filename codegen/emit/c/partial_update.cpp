#include "emit/c/partial_update.hpp"

#include "emit/text/wording.hpp"
#include "trace/print.hpp"

namespace lqg::emit {

namespace {

constexpr int bits_of_long = 32;  // at least

std::string bit(int i) { return "1ul << " + std::to_string(i); }

// Bit i of `lost`: update leaves output i out, since its innovation is not believable, or since the outputs that make its
// noise independent are not all there.
std::string look_at_output(const Controller& controller, int i) {
  const bool is_double = controller.target.is_double;
  std::string nu = "nu[" + std::to_string(i) + "]", company;
  for (int j = 0; j < i && controller.solution.online; ++j) {
    const design::Real& weight = controller.solution.online->E(i, j);
    if (weight == 0) continue;
    nu += " + " + trace::literal(rounded_to_target(weight, is_double), is_double) + " * nu[" + std::to_string(j) + "]";
    company += (company.empty() ? "" : " | ") + bit(j);
  }
  const Words words = {{"real", is_double ? "double" : "float"}, {"abs", is_double ? "fabs" : "fabsf"}, {"i", std::to_string(i)},
                       {"nu", nu}, {"limit", trace::literal(controller.bounds.innovation(i), is_double)}, {"bit", bit(i)},
                       {"company", company}};
  return fill("    const {real} nu_{i} = {nu};\n    lost |= {abs}(nu_{i}) < {limit} ? 0ul : {bit};\n", words) +
         (company.empty() ? "" : fill("    lost |= (~used & ({company})) ? {bit} : 0ul;\n", words));
}

}  // namespace

std::string partial_update_function(const Controller& controller) {
  if (controller.size.ny < 2 || controller.size.ny > bits_of_long || controller.has.stages) return "";
  Words words = common_words(controller);
  words["exact"] = controller.filter == step::Filter::steady
                       ? "An approximation: the gains are the best in the company of all outputs."
                   : controller.keeps.innovation
                       ? "An approximation, and to be called once between two predictions: w and v are correlated."
                       : "Exact: as if the others were not there in this sample.";
  words["bit"] = "1ul << {NAME}_Y_" + upper(controller.problem.plant.outputs.front().name);
  words["bit"] = fill(words["bit"], words);
  words["S"] = fill(controller.has.variance ? ", S[{NAME}_NY]" : "", words);
  words["variances"] = controller.has.variance ? ", S" : "";
  for (int i = 0; i < controller.size.ny; ++i) words["look"] += look_at_output(controller, i);
  words["gated"] = controller.has.gate ? " LQG_OUTPUT_GATED," : "";
  words["not_positive"] = controller.filter == step::Filter::plain ? " LQG_INNOVATION_NOT_POSITIVE," : "";
  return fill(R"(
/* The update by some of the outputs, for sensors with rates of their own; any number of predictions may lie between two.
 * {exact}
 *
 * y     in: the outputs, in their units; those that are not used are not looked at
 * used  in: which of them are there, a bit each: {bit}
 *
 * Status: LQG_OUTPUT_NOT_FINITE, of those that are used,{gated}{not_positive} LQG_STATE_RESET. */
static inline lqg_status {name}_partial_update({name}_t *self, const {real} y[{NAME}_NY], unsigned long used)
{
    LQG_STRICT_BODY
    {real} there[{NAME}_NY], nu[{NAME}_NY]{S};
    unsigned long lost = 0;

    for (int i = 0; i < {NAME}_NY; i++)
        there[i] = used >> i & 1ul ? y[i] : {zero};
    {name}_innovation(self, there, nu{variances});
{look}    for (int i = 0; i < {NAME}_NY; i++)
        there[i] = used >> i & 1ul ? y[i] : ({real})INFINITY;  /* left out */

    const lqg_status status = {name}_update(self, there) & ~LQG_OUTPUT_NOT_FINITE;
    return used & lost ? status | LQG_OUTPUT_NOT_FINITE : status;
}
)", words);
}

}  // namespace lqg::emit
