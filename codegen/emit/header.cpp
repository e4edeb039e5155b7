#include "emit/header.hpp"

#include "emit/bodies.hpp"
#include "emit/preamble.hpp"
#include "emit/text.hpp"

namespace lqg::emit {

namespace {

std::string handshake(const Controller& controller) {
  return fill(R"(
#if LQG_HEADER_FORMAT != {format}
#error "{name}.h was made by lqgen {version}, which this TinyLQG does not know: run the lqgen of this TinyLQG on {file} again."
#endif
)", {{"format", header_format()}, {"name", controller.problem.name}, {"version", version()},
     {"file", controller.source.file}});
}

std::string dimensions(const Controller& controller) {
  const Words words = common_words(controller);
  std::string out = fill("\n#define {NAME}_NX {nx}  /* states */\n", words);
  if (controller.nu()) out += fill("#define {NAME}_NU {nu}  /* inputs */\n", words);
  if (controller.has_filter()) out += fill("#define {NAME}_NY {ny}  /* outputs */\n", words);
  return out + fill("#define {NAME}_SAMPLE_TIME ", words) +
         trace::literal(controller.problem.plant.sample_time, controller.is_double()) + "  /* s between two samples */\n";
}

std::string index_enum(const Controller& controller, const char* kind, const std::vector<design::Signal>& signals) {
  if (signals.empty()) return "";
  std::string out = "\nenum {\n";
  for (std::size_t i = 0; i < signals.size(); ++i) {
    out += "    " + upper(controller.problem.name) + "_" + kind + "_" + upper(signals[i].name) + " = " +
           std::to_string(i) + (i + 1 < signals.size() ? "," : "");
    out += signals[i].unit.empty() ? "\n" : "  /* [" + signals[i].unit + "] */\n";
  }
  return out + "};\n";
}

std::string state_type(const Controller& controller) {
  if (!controller.has_filter()) return "";
  const int nx = controller.nx();
  Words words = common_words(controller);
  words["triangle"] = std::to_string(nx * (nx + 1) / 2);
  words["strict"] = std::to_string(nx * (nx - 1) / 2);
  std::string fields = "    {real} x[{NAME}_NX];  /* x̂, the estimate: of this sample after update, of the next after predict */\n";
  if (controller.filter() == step::Filter::plain)
    fields += "    {real} P[{triangle}];  /* covariance of its error: lower triangle, row by row, P_ij at [i*(i+1)/2 + j] */\n";
  if (controller.filter() == step::Filter::ud) {
    if (nx > 1) fields += "    {real} U[{strict}];  /* P = U diag(d) Uᵀ: strict upper triangle, column by column, U_ij at [j*(j-1)/2 + i] */\n";
    fields += "    {real} d[{NAME}_NX];\n";
  }
  if (controller.keeps_input()) fields += "    {real} u_applied[{NAME}_NU];  /* the input that acts: of the last predict or control */\n";
  if (controller.keeps_innovation()) fields += "    {real} innovation[{NAME}_NY];  /* what predict has yet to hear of the last outputs */\n";
  return fill("\n/* The whole state of the controller: no pointers inside, may be copied. Begin it with {name}_init. */\n"
              "typedef struct {\n" + fields + "} {name}_t;\n", words);
}

std::string init_function(const Controller& controller, const Bodies& bodies) {
  Words words = common_words(controller);
  words["covariance"] = controller.filter() == step::Filter::steady ? "" : ", its covariance P0";
  words["body"] = bodies.init;
  return fill(R"(
/* x̂ = x0{covariance}; nothing applied yet. */
static inline void {name}_init({name}_t *self)
{
{body}}
)", words);
}

std::string update_function(const Controller& controller, const Bodies& bodies) {
  Words words = common_words(controller);
  words["law"] = controller.keeps_input() ? "x̂ ← x̂ + L (y − C x̂ − D u),  u the input that acts" : "x̂ ← x̂ + L (y − C x̂)";
  words["covariance"] = controller.filter() == step::Filter::steady ? "" : ",  L = P Cᵀ S⁻¹,  P ← P − L C P";
  words["left_out"] = controller.filter() == step::Filter::steady
                          ? "An output that is not finite is taken as having come as expected."
                          : "An output that is not finite is left out of this sample.";
  words["not_positive"] = controller.filter() == step::Filter::plain ? " LQG_INNOVATION_NOT_POSITIVE," : "";
  words["body"] = bodies.update;
  return fill(R"(
/* {law}{covariance}
 *
 * y  in: the outputs, in their units. {left_out}
 *
 * Status: LQG_OUTPUT_NOT_FINITE,{not_positive} LQG_STATE_RESET. */
static inline lqg_status {name}_update({name}_t *self, const {real} y[{NAME}_NY])
{
{body}}
)", words);
}

std::string predict_function(const Controller& controller, const Bodies& bodies) {
  Words words = common_words(controller);
  words["input"] = controller.nu() ? " + B u" : "";
  words["covariance"] = controller.filter() == step::Filter::steady ? "" : ",  P ← A P Aᵀ + G W Gᵀ";
  words["parameter"] = controller.nu() ? fill(", const {real} u[{NAME}_NU]", words) : "";
  words["u"] = controller.nu() ? " *\n * u  in: what was applied, in its units; not what was asked for, where the two differ\n" : "";
  words["body"] = bodies.predict;
  return fill(R"(
/* x̂ ← A x̂{input}{covariance}: from this sample to the next.
{u} *
 * Status: LQG_STATE_RESET. */
static inline lqg_status {name}_predict({name}_t *self{parameter})
{
{body}}
)", words);
}

std::string control_function(const Controller& controller, const Bodies& bodies) {
  Words words = common_words(controller);
  words["x"] = controller.has_filter() ? "x̂" : "x";
  words["parameter"] = controller.has_filter() ? (controller.keeps_input() ? "{name}_t *self" : "const {name}_t *self")
                                               : "const {real} x[{NAME}_NX]";
  words["parameter"] = fill(words["parameter"], words);
  words["in"] = controller.has_filter() ? "" : " * x  in: the state, in its units\n";
  words["body"] = bodies.control;
  return fill(R"(
/* u = −K {x}, within its limits
 *
{in} * u  out: the inputs, in their units: finite{limits}, whatever came in
 *
 * Status: LQG_INPUT_LIMITED. */
static inline lqg_status {name}_control({parameter}, {real} u[{NAME}_NU])
{
{body}}
)", [&] {
    words["limits"] = controller.problem.limits ? " and within the limits" : "";
    return words;
  }());
}

std::string step_function(const Controller& controller) {
  Words words = common_words(controller);
  const bool acts = controller.has_regulator();
  const std::string control = "{name}_control(self, u)", update = "{name}_update(self, y)";
  const std::string predict = controller.nu() ? "{name}_predict(self, u)" : "{name}_predict(self)";
  const std::vector<std::string> calls = !acts                       ? std::vector<std::string>{update, predict}
                                         : controller.is_predictor() ? std::vector<std::string>{control, update, predict}
                                                                     : std::vector<std::string>{update, control, predict};
  std::string body = "    lqg_status status = " + calls.front() + ";\n\n";
  for (std::size_t i = 1; i < calls.size(); ++i) body += "    status |= " + calls[i] + ";\n";
  words["body"] = fill(body, words);
  words["parameter"] = controller.nu() ? fill(acts ? ", {real} u[{NAME}_NU]" : ", const {real} u[{NAME}_NU]", words) : "";
  words["order"] = !acts ? "update and predict" : controller.is_predictor() ? "control, update and predict"
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

std::string covariance_function(const Controller& controller) {
  if (controller.filter() != step::Filter::ud) return "";
  Words words = common_words(controller);
  words["triangle"] = std::to_string(controller.nx() * (controller.nx() + 1) / 2);
  words["product"] = controller.nx() > 1 ? R"(            {real} sum = i == j ? self->d[i] : self->U[i * (i - 1) / 2 + j] * self->d[i];
            for (int k = i + 1; k < {NAME}_NX; k++) {
                const {real} weighted = self->U[k * (k - 1) / 2 + j] * self->d[k];
                const {real} term = weighted * self->U[k * (k - 1) / 2 + i];
                sum = sum + term;
            }
            P[i * (i + 1) / 2 + j] = sum;
)" : "            P[i + j] = self->d[i];\n";
  words["product"] = fill(words["product"], words);
  return fill(R"(
/* P = U diag(d) Uᵀ, the covariance of the estimate's error: lower triangle, row by row. */
static inline void {name}_covariance(const {name}_t *self, {real} P[{triangle}])
{
    LQG_STRICT_BODY
    for (int i = 0; i < {NAME}_NX; i++) {
        for (int j = 0; j <= i; j++) {
{product}        }
    }
}
)", words);
}

}  // namespace

std::string header(const Controller& controller) {
  const Bodies bodies =
      controller.style == design::Style::compact ? compact_bodies(controller) : unrolled_bodies(controller);
  const design::Plant& plant = controller.problem.plant;
  const std::string guard = upper(controller.problem.name) + "_H";
  std::string out = preamble(controller) + "#ifndef " + guard + "\n#define " + guard + "\n\n" + bodies.includes;
  out += handshake(controller) + dimensions(controller);
  out += index_enum(controller, "X", plant.states) + index_enum(controller, "U", plant.inputs);
  if (controller.has_filter()) out += index_enum(controller, "Y", plant.outputs) + state_type(controller);
  if (!bodies.constants.empty()) out += "\n" + bodies.constants;
  out += "\nLQG_STRICT_BEGIN\n" + bodies.options;
  if (controller.has_filter()) out += init_function(controller, bodies) + bodies.reset + update_function(controller, bodies);
  if (controller.has_regulator()) out += control_function(controller, bodies);
  if (controller.has_filter())
    out += predict_function(controller, bodies) + step_function(controller) + covariance_function(controller);
  return out + "\nLQG_STRICT_END\n\n#endif\n";
}

}  // namespace lqg::emit
