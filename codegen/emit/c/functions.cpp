#include "emit/c/functions.hpp"

#include "emit/c/linear_functions.hpp"
#include "emit/c/partial_update.hpp"
#include "emit/c/straight_line.hpp"
#include "emit/text/wording.hpp"

namespace lqg::emit {

namespace {

std::string init_function(const Controller& controller, const FunctionBodies& bodies) {
  Words words = common_words(controller);
  words["begin"] = !controller.has.filter                          ? "As at the start"
                   : controller.filter == step::Filter::steady ? "x̂ = x0"
                                                                 : "x̂ = x0, its covariance P0";
  if (controller.size.nxi) words["begin"] += ", ξ = 0";
  if (controller.size.nr) words["begin"] += ", r = 0";
  words["body"] = bodies.init;
  return fill(R"(
/* {begin}; nothing applied yet. */
static inline void {name}_init({name}_t *self)
{
{body}}
)", words);
}

// What happens to an output that cannot be used, and what an update may say.
Words update_words(const Controller& controller) {
  Words words = common_words(controller);
  const std::string gate = controller.has.gate ? ", or is further than " + decimal(controller.problem.estimator->gate) +
                                                    " σ from what is expected," : "";
  words["unusable"] = "that is not believable (not finite, or absurd)" + gate;
  words["gated"] = controller.has.gate ? " LQG_OUTPUT_GATED," : "";
  words["not_positive"] = controller.filter == step::Filter::plain ? " LQG_INNOVATION_NOT_POSITIVE," : "";
  words["gain"] = controller.filter == step::Filter::steady ? "" : ",  L = P Cᵀ S⁻¹,  P ← P − L C P";
  words["law"] = controller.has.feedthrough ? "x̂ ← x̂ + L (y − C x̂ − D u),  u the input that acts" : "x̂ ← x̂ + L (y − C x̂)";
  return words;
}

std::string update_function(const Controller& controller, const FunctionBodies& bodies) {
  Words words = update_words(controller);
  words["left_out"] = controller.filter == step::Filter::steady ? "is taken as having come as expected"
                                                                   : "is left out of this sample";
  words["body"] = bodies.update;
  return fill(R"(
/* {law}{gain}
 *
 * y  in: the outputs, in their units. An output {unusable} {left_out}.
 *
 * Status: LQG_OUTPUT_NOT_FINITE,{gated}{not_positive} LQG_STATE_RESET. */
static inline lqg_status {name}_update({name}_t *self, const {real} y[{NAME}_NY])
{
{body}}
)", words);
}

// Why an update by one output alone is what it is.
std::string company(const Controller& controller) {
  if (controller.size.ny == 1) return " There is no other: it is the update.";
  if (controller.filter == step::Filter::steady)
    return " An approximation: its gain is the best in the company of the other outputs only.";
  if (controller.keeps.innovation) return " At most one such call between two predictions: w and v are correlated.";
  return " Exact, in any order, as often as there is something to hear.";
}

std::string update_alone_functions(const Controller& controller, const FunctionBodies& bodies) {
  std::string out;
  std::size_t at = 0;
  for (int i = 0; i < controller.size.ny; ++i) {
    if (!can_update_alone(controller, i)) continue;
    const design::Signal& signal = controller.problem.plant.outputs[static_cast<std::size_t>(i)];
    Words words = update_words(controller);
    words["output"] = signal.name;
    words["unit"] = signal.unit.empty() ? "in its unit" : "in " + signal.unit;
    words["company"] = company(controller);
    words["body"] = bodies.updates_alone[at++];
    out += fill(R"(
/* The update by {output} alone, for a sensor with a rate of its own; any number of predictions may lie between two.
 *{company}
 *
 * y_{output}  in: the output, {unit}. One {unusable} is left out.
 *
 * Status: LQG_OUTPUT_NOT_FINITE,{gated}{not_positive} LQG_STATE_RESET. */
static inline lqg_status {name}_update_{output}({name}_t *self, const {real} y_{output})
{
{body}}
)", words);
  }
  return out;
}

std::string innovation_function(const Controller& controller) {
  Words words = common_words(controller);
  words["law"] = controller.has.feedthrough ? "y − C x̂ − D u" : "y − C x̂";
  words["and"] = !controller.has.variance ? "" : controller.filter == step::Filter::steady ? " and the steady variance of each"
                                                                                             : " and the variance of each, C P Cᵀ + V";
  words["S"] = controller.has.variance ? " * S   out: the variances; nu²/S is 1 in the mean as long as the model holds\n " : " ";
  words["parameter"] = fill(controller.has.variance ? ", {real} S[{NAME}_NY]" : "", words);
  words["body"] = body(controller, trace_innovation(controller), {"self", "y"});
  return fill(R"(
/* How far the outputs are from what is expected, {law}{and}:
 * to be called before update by those who watch the health of sensors and model.
 *
 * y   in: the outputs, in their units
 * nu  out: the innovations
{S}*/
static inline void {name}_innovation(const {name}_t *self, const {real} y[{NAME}_NY],
    {real} nu[{NAME}_NY]{parameter})
{
{body}}
)", words);
}

std::string predict_function(const Controller& controller, const FunctionBodies& bodies) {
  Words words = common_words(controller);
  words["input"] = controller.size.nu ? " + B u" : "";
  words["covariance"] = controller.filter == step::Filter::steady ? "" : ",  P ← A P Aᵀ + G W Gᵀ";
  words["parameter"] = controller.size.nu ? fill(", const {real} u[{NAME}_NU]", words) : "";
  words["integral"] = controller.size.nxi ? ",  ξ ← ξ + H (u − what control asked for) + T (r − y)" : "";
  words["u"] = controller.size.nu ? " *\n * u  in: what was applied, in its units; not what was asked for, where the two differ\n" : "";
  words["body"] = bodies.predict;
  return fill(R"(
/* x̂ ← A x̂{input}{covariance}{integral}: from this sample to the next.
{u} *
 * Status: LQG_STATE_RESET. */
static inline lqg_status {name}_predict({name}_t *self{parameter})
{
{body}}
)", words);
}

std::string control_contract(const Controller& controller) {
  Words words = common_words(controller);
  words["law"] = equation_of_law(controller);
  words["in"] = controller.has.filter ? "" : " * x  in: the state, in its units{on_their_way}\n";
  words["on_their_way"] = controller.size.delayed ? "; behind it the inputs on their way, the oldest first" : "";
  words["in"] = fill(words["in"], words);
  words["limits"] = controller.problem.limits ? " and within the limits" : "";
  words["reference"] = controller.size.nr ? "LQG_REFERENCE_NOT_FINITE (such an r counts as 0), " : "";
  words["reset"] = controller.has.filter || !controller.has.servo ? "" : ", LQG_STATE_RESET";
  words["more"] = controller.has.filter || !controller.keeps.any ? "" :
      " * Once a sample: it remembers what the next one needs, for an actuator that applies u as it is.\n *\n";
  return fill(R"(/* u = {law}, within its limits
 *
{more}{in} * u  out: the inputs, in their units: finite{limits}, whatever came in
 *
 * Status: {reference}LQG_INPUT_LIMITED{reset}. */
)", words);
}

std::string control_function(const Controller& controller, const FunctionBodies& bodies) {
  const bool writes = !controller.has.filter || control_changes_state(controller);
  std::string parameters = !controller.keeps.any ? "" : writes ? "{name}_t *self, " : "const {name}_t *self, ";
  if (!controller.has.filter) parameters += "const {real} x[{NAME}_NX], ";
  return "\n" + control_contract(controller) +
         fill("static inline lqg_status {name}_control(" + parameters + "{real} u[{NAME}_NU])\n{\n", common_words(controller)) +
         bodies.control + "}\n";
}

std::string step_function(const Controller& controller) {
  Words words = common_words(controller);
  const bool acts = controller.has.regulator;
  const std::string control = "{name}_control(self, u)", update = "{name}_update(self, y)";
  const std::string predict = controller.size.nu ? "{name}_predict(self, u)" : "{name}_predict(self)";
  const std::vector<std::string> calls = !acts                       ? std::vector<std::string>{update, predict}
                                         : controller.is_predictor ? std::vector<std::string>{control, update, predict}
                                                                     : std::vector<std::string>{update, control, predict};
  std::string body = "    lqg_status status = " + calls.front() + ";\n\n";
  for (std::size_t i = 1; i < calls.size(); ++i) body += "    status |= " + calls[i] + ";\n";
  words["body"] = fill(body, words);
  words["parameter"] = controller.size.nu ? fill(acts ? ", {real} u[{NAME}_NU]" : ", const {real} u[{NAME}_NU]", words) : "";
  words["order"] = !acts ? "update and predict" : controller.is_predictor ? "control, update and predict"
                                                                            : "update, control and predict";
  words["when"] = acts ? ", for an actuator that applies u as it is" : "";
  return fill(R"(
/* One sample: {order}{when}. */
static inline lqg_status {name}_step({name}_t *self, const {real} y[{NAME}_NY]{parameter})
{
{body}    return status;
}
)", words);
}

// P[] of U and d, in a loop.
std::string multiply_out(const Controller& controller) {
  return fill(R"(    LQG_STRICT_BODY
    for (int i = 0; i < {NAME}_NX; i++) {
        for (int j = 0; j <= i; j++) {
            {real} sum = i == j ? self->d[i] : self->U[i * (i - 1) / 2 + j] * self->d[i];
            for (int k = i + 1; k < {NAME}_NX; k++) {
                const {real} weighted = self->U[k * (k - 1) / 2 + j] * self->d[k];
                const {real} term = weighted * self->U[k * (k - 1) / 2 + i];
                sum = sum + term;
            }
            P[i * (i + 1) / 2 + j] = sum;
        }
    }
)", common_words(controller));
}

std::string covariance_function(const Controller& controller) {
  if (controller.filter != step::Filter::ud) return "";
  const bool loops = controller.style == design::Style::compact && controller.size.nx > 1;
  Words words = common_words(controller);
  words["triangle"] = std::to_string(controller.size.nx * (controller.size.nx + 1) / 2);
  words["body"] = loops ? multiply_out(controller) : body(controller, trace_covariance(controller), {});
  return fill(R"(
/* P = U diag(d) Uᵀ, the covariance of the estimate's error: lower triangle, row by row. */
static inline void {name}_covariance(const {name}_t *self, {real} P[{triangle}])
{
{body}}
)", words);
}

// Outside of the functions that call it, where it would cost every sample registers.
std::string reset_function(const Controller& controller) {
  Words words = common_words(controller);
  std::string keep, restore;
  if (controller.size.nr) {
    keep += "    {real} r[{NAME}_NR];\n";
    restore += "    for (int i = 0; i < {NAME}_NR; i++)\n        self->r[i] = r[i];\n";
  }
  if (controller.keeps.sample) {
    keep += "    const unsigned sample = self->sample;\n";
    restore += "    self->sample = sample;\n";
  }
  if (controller.has.filter) {
    keep += "    const unsigned long resets = self->resets + 1;\n";
    restore += "    self->resets = resets;\n";
  }
  if (controller.has.gate) {
    keep += "    unsigned long gated[{NAME}_NY];\n";
    restore += "    for (int i = 0; i < {NAME}_NY; i++)\n        self->gated[i] = gated[i];\n";
  }
  const std::string copies = std::string(controller.size.nr ? "    for (int i = 0; i < {NAME}_NR; i++)\n        r[i] = self->r[i];\n" : "") +
                             (controller.has.gate ? "    for (int i = 0; i < {NAME}_NY; i++)\n        gated[i] = self->gated[i];\n" : "");
  if (!copies.empty()) keep += "\n" + copies;
  else if (!keep.empty()) keep += "\n";
  words["keep"] = fill(keep, words);
  words["restore"] = fill(restore, words);
  std::string kept;
  for (const auto& [is_kept, what] : {std::pair(controller.size.nr > 0, "r"), std::pair(controller.keeps.sample, "the time"),
                                      std::pair(controller.has.filter, "what was counted")})
    if (is_kept) kept += std::string(kept.empty() ? ", but for " : " and ") + what;
  words["but"] = kept;
  words["counts"] = controller.has.filter ? ", and counts it" : "";
  words["within"] = controller.bounds.x.empty() ? "finite" : "within its bounds";
  return fill(R"(
/* Begins anew{but}{counts}: the state was not {within}. */
#ifdef __GNUC__
__attribute__((noinline))
#endif
static lqg_status {name}_reset({name}_t *self, lqg_status status)
{
{keep}    {name}_init(self);
{restore}    return status | LQG_STATE_RESET;
}
)", words);
}

std::string set_state_function(const Controller& controller) {
  Words words = common_words(controller);
  words["covariance"] = controller.filter == step::Filter::steady ? "" : "; its covariance stays";
  words["then"] = fill(can_set_input(controller) ? " {name}_set_input may follow." : "", words);
  words["body"] = body(controller, trace_set_state(controller), {"self", "x"});
  return fill(R"(
/* x̂ ← x, by hand{covariance}.{then}
 *
 * x  in: the state, in its units
 *
 * Status: LQG_STATE_RESET, when x is not within {NAME}_X_BOUNDS. */
static inline lqg_status {name}_set_state({name}_t *self, const {real} x[{NAME}_NX])
{
{body}}
)", words);
}

std::string set_input_function(const Controller& controller) {
  Words words = common_words(controller);
  words["follow"] = std::string(controller.size.delayed ? ", and so are those on their way" : "") +
                    (controller.size.nxi ? ".\n * ξ becomes such that control goes on there" : "");
  words["when"] = controller.size.nxi && controller.has.filter ? ": to be called before control" : "";
  words["parameters"] = fill(controller.has.filter ? "{name}_t *self, const {real} u[{NAME}_NU]"
                                                     : "{name}_t *self, const {real} x[{NAME}_NX], const {real} u[{NAME}_NU]", words);
  words["x"] = controller.has.filter ? "" : " * x  in: the state, in its units\n";
  words["reference"] = controller.size.nxi ? "LQG_REFERENCE_NOT_FINITE, " : "";
  words["body"] = controller.has.filter ? body(controller, trace_set_input(controller), {"self", "u"})
                                        : body(controller, trace_set_input(controller), {"self", "x", "u"});
  return fill(R"(
/* The input was u, set by hand{follow}{when}.
 *
{x} * u  in: what was applied, in its units
 *
 * Status: {reference}LQG_STATE_RESET, when that is not finite. */
static inline lqg_status {name}_set_input({parameters})
{
{body}}
)", words);
}

}  // namespace

std::string functions(const Controller& controller, const FunctionBodies& bodies) {
  if (controller.linear)
    return init_function(controller, bodies) + reset_function(controller) + linear_functions(controller);
  std::string out;
  if (controller.keeps.any) out += init_function(controller, bodies);
  if (bodies.resets) out += reset_function(controller);
  if (controller.has.filter) out += update_function(controller, bodies);
  if (controller.has.regulator) out += control_function(controller, bodies);
  if (controller.has.filter)
    out += predict_function(controller, bodies) + step_function(controller) + covariance_function(controller) +
           update_alone_functions(controller, bodies) + (controller.has.stages ? "" : innovation_function(controller)) +
           partial_update_function(controller) + set_state_function(controller);
  if (can_set_input(controller)) out += set_input_function(controller);
  return out;
}

}  // namespace lqg::emit
