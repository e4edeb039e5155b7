#include "emit/c/partial_update.hpp"

#include "emit/c/straight_line.hpp"
#include "emit/text/wording.hpp"

namespace lqg::emit {

namespace {

constexpr int bits_of_long = 32;  // at least

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
  words["lost"] = collect_lost(trace_lost_outputs(controller));
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
        there[i] = used >> i & 1ul ? y[i] : ({real})INFINITY;  /* left out */
    {name}_innovation(self, there, nu{variances});
{lost}
    const lqg_status status = {name}_update(self, there) & ~LQG_OUTPUT_NOT_FINITE;
    return used & lost ? status | LQG_OUTPUT_NOT_FINITE : status;
}
)", words);
}

}  // namespace lqg::emit
