#include "emit/c/linear_functions.hpp"

#include "emit/c/straight_line.hpp"
#include "emit/recorded/linear_traced.hpp"
#include "emit/text/wording.hpp"

namespace lqg::emit {

namespace {

Words with_body(const Controller& controller, const TracedFunction& function,
                std::initializer_list<const char*> parameters) {
  Words words = common_words(controller);
  words["body"] = body(controller, function, parameters);
  return words;
}

// A function out of line, for the sample that is not as the others.
std::string aside(const std::string& text, const Words& words) {
  const std::size_t contract = text.find("*/\n") + 3;
  return fill(text.substr(0, contract) + "#ifdef __GNUC__\n__attribute__((noinline))\n#endif\n" + text.substr(contract), words);
}

const char* const applied = R"( * u  out: the inputs, in their units: finite, whatever came in. They have to be applied as they are: where an
 *    actuator may limit them, choose realisation = "physical".
)";

std::string control_of_filter_form(const Controller& controller, const TracedLinear& traced) {
  return aside(R"(
/* The same for any y, which self holds, and any z: an output that is not finite is what was expected, u is 0. */
static lqg_status {name}_control_fault({name}_t *self, {real} u[{NAME}_NU])
{
{body}}
)", with_body(controller, traced.control_fault, {"self"})) +
         fill(std::string(R"(
/* u = C z + D y, which is u = −K x̂ of this sample.
 *
 * y  in: the outputs, in their units. An output that is not finite is taken as having come as expected.
)") + applied + R"( *
 * Status: LQG_OUTPUT_NOT_FINITE, LQG_INPUT_LIMITED (it was not finite). */
static inline lqg_status {name}_control({name}_t *self, const {real} y[{NAME}_NY], {real} u[{NAME}_NU])
{
{body}}
)", with_body(controller, traced.control, {"self"}));
}

std::string control_of_predictor_form(const Controller& controller, const TracedLinear& traced) {
  return aside(R"(
/* The same for any z: u is 0 where it is not finite. */
static lqg_status {name}_control_fault(const {name}_t *self, {real} u[{NAME}_NU])
{
{body}}
)", with_body(controller, traced.control_fault, {"self"})) +
         fill(std::string(R"(
/* u = C z, which is u = −K x̂ of this sample: made before its outputs are there.
 *
)") + applied + R"( *
 * Status: LQG_INPUT_LIMITED (it was not finite). */
static inline lqg_status {name}_control(const {name}_t *self, {real} u[{NAME}_NU])
{
{body}}
)", with_body(controller, traced.control, {"self"}));
}

std::string advance_of_filter_form(const Controller& controller, const TracedLinear& traced) {
  return fill(R"(
/* z ← A z + B y with the outputs that control has heard: from this sample to the next, once after each control.
 *
 * Status: LQG_STATE_RESET. */
static inline lqg_status {name}_advance({name}_t *self)
{
{body}}
)", with_body(controller, traced.advance, {"self"}));
}

// y_0 + y_1 + … is finite: each is.
std::string all_outputs_are_finite(const Controller& controller) {
  std::string out, last = "y[0]";
  for (int i = 1; i < controller.size.ny; ++i) {
    const std::string sum = "others_" + std::to_string(i);
    out += fill("    const {real} " + sum + " = " + last + " + y[" + std::to_string(i) + "];\n", common_words(controller));
    last = sum;
  }
  if (controller.size.ny == 1) {
    out = fill("    const {real} y_0 = y[0];\n", common_words(controller));
    last = "y_0";
  }
  return out + "\n    if (!(" + last + " - " + last + fill(" == {zero}))\n", common_words(controller));
}

std::string advance_of_predictor_form(const Controller& controller, const TracedLinear& traced) {
  Words words = common_words(controller);
  words["check"] = all_outputs_are_finite(controller);
  return fill(R"(
/* z ← A z + B y with outputs that are finite. */
static lqg_status {name}_move({name}_t *self, const {real} y[{NAME}_NY])
{
{body}}
)", with_body(controller, traced.advance, {"self", "y"})) +
         aside(R"(
/* y, and what is expected where that is not finite. */
static lqg_status {name}_hear(const {name}_t *self, const {real} y[{NAME}_NY], {real} heard[{NAME}_NY])
{
{body}}
)", with_body(controller, traced.hear, {"self"})) +
         aside(R"(
/* The same as {name}_advance for any y. */
static lqg_status {name}_advance_fault({name}_t *self, const {real} y[{NAME}_NY])
{
    {real} heard[{NAME}_NY];
    const lqg_status status = {name}_hear(self, y, heard);

    return status | {name}_move(self, heard);
}
)", words) + fill(R"(
/* z ← A z + B y: from this sample to the next.
 *
 * y  in: the outputs of this sample, in their units. An output that is not finite is taken as having come as expected.
 *
 * Status: LQG_OUTPUT_NOT_FINITE, LQG_STATE_RESET. */
static inline lqg_status {name}_advance({name}_t *self, const {real} y[{NAME}_NY])
{
    LQG_STRICT_BODY
{check}        return {name}_advance_fault(self, y);
    return {name}_move(self, y);
}
)", words);
}

std::string step_function(const Controller& controller) {
  Words words = common_words(controller);
  words["control"] = controller.is_predictor ? "(self, u)" : "(self, y, u)";
  words["advance"] = controller.is_predictor ? "(self, y)" : "(self)";
  return fill(R"(
/* One sample: control and advance. */
static inline lqg_status {name}_step({name}_t *self, const {real} y[{NAME}_NY], {real} u[{NAME}_NU])
{
    lqg_status status = {name}_control{control};

    status |= {name}_advance{advance};
    return status;
}
)", words);
}

std::string estimate_function(const Controller& controller, const TracedLinear& traced) {
  Words words = with_body(controller, traced.estimate, {"self"});
  words["which"] = controller.is_predictor
                       ? "x̂ of this sample from the outputs before it; after advance: of the next sample."
                       : "x̂ of this sample, its outputs heard: to be called between control and advance.";
  return fill(R"(
/* {which} u = −K x̂ is made of it.
 *
 * x  out: the estimate, in the units of the states */
static inline void {name}_estimate(const {name}_t *self, {real} x[{NAME}_NX])
{
{body}}
)", words);
}

std::string set_state_function(const Controller& controller, const TracedLinear& traced) {
  return fill(R"(
/* x̂ ← x, by hand, between advance and control: x of the sample to come, its outputs not heard.
 *
 * x  in: the state, in its units
 *
 * Status: LQG_STATE_RESET, when x is not finite. */
static inline lqg_status {name}_set_state({name}_t *self, const {real} x[{NAME}_NX])
{
{body}}
)", with_body(controller, traced.set_state, {"self"}));
}

}  // namespace

std::string linear_functions(const Controller& controller) {
  const TracedLinear traced = trace_linear(controller);
  return (controller.is_predictor
              ? control_of_predictor_form(controller, traced) + advance_of_predictor_form(controller, traced)
              : control_of_filter_form(controller, traced) + advance_of_filter_form(controller, traced)) +
         step_function(controller) + estimate_function(controller, traced) + set_state_function(controller, traced);
}

}  // namespace lqg::emit
