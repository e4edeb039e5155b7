// SPDX-License-Identifier: MIT
#include "emit/unit_test/calls_test.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "emit/recorded/trace_listener.hpp"
#include "emit/text/wording.hpp"
#include "trace/print.hpp"
#include "trace/wrap.hpp"

namespace lqg::emit {

namespace {

const char* name_of(Call call) {
  switch (call) {
    case Call::init: return "CALL_INIT";
    case Call::step: return "CALL_STEP";
    case Call::update: return "CALL_UPDATE";
    case Call::update_alone: return "CALL_UPDATE_ALONE";
    case Call::partial_without: return "CALL_PARTIAL_WITHOUT";
    case Call::partial_alone: return "CALL_PARTIAL_ALONE";
    case Call::control: return "CALL_CONTROL";
    case Call::predict: return "CALL_PREDICT";
    case Call::advance: return "CALL_ADVANCE";
    case Call::estimate: return "CALL_ESTIMATE";
    case Call::set_state: return "CALL_SET_STATE";
    case Call::set_input: return "CALL_SET_INPUT";
    case Call::innovation: return "CALL_INNOVATION";
    case Call::covariance: return "CALL_COVARIANCE";
    case Call::write_r: return "WRITE_R";
    case Call::write_x: return "WRITE_X";
    case Call::write_covariance: return "WRITE_COVARIANCE";
    case Call::write_xi: return "WRITE_XI";
    case Call::write_z: return "WRITE_Z";
  }
  return "";
}

constexpr Call every_call[] = {
    Call::init,          Call::step,      Call::update,           Call::update_alone, Call::partial_without,
    Call::partial_alone, Call::control,   Call::predict,          Call::advance,      Call::estimate,
    Call::set_state,     Call::set_input, Call::innovation,       Call::covariance,   Call::write_r,
    Call::write_x,       Call::write_xi,  Call::write_covariance, Call::write_z};

std::string number_of(double value, bool is_double) {
  const std::string cast = is_double ? "(double)" : "(float)";
  if (std::isnan(value)) return cast + "NAN";
  if (std::isinf(value)) return std::string(value < 0 ? "-" : "") + cast + "INFINITY";
  return trace::literal(value, is_double);
}

int triangle(const Controller& controller) { return controller.size.nx * (controller.size.nx + 1) / 2; }

std::string hand_over(const std::string& to, const std::string& row, const std::string& count) {
  return "            hand_over(" + to + ", " + row + ", " + count + ", k);\n";
}

std::string given_outputs() { return hand_over("given", "y_in[row]", "{NAME}_NY"); }
std::string answered(const std::string& call) { return "            status = {name}_" + call + ";\n"; }
std::string found(const std::string& count) { return "            count = " + count + ";\n"; }

std::string step_case(const Controller& controller) {
  if (controller.has.regulator) return given_outputs() + answered("step(&self, given, found)") + found("{NAME}_NU");
  return given_outputs() + answered(controller.size.nu ? "step(&self, given, u_out[row])" : "step(&self, given)");
}

std::string control_case(const Controller& controller) {
  std::string arguments = controller.keeps.any ? "&self, " : "", given;
  if (controller.linear && !controller.is_predictor) given = given_outputs();
  if (!controller.has.filter) given = hand_over("given", "x_in[row]", "{NAME}_NX");
  return given + answered("control(" + arguments + (given.empty() ? "found)" : "given, found)")) + found("{NAME}_NU");
}

std::string advance_case(const Controller& controller) {
  if (!controller.is_predictor) return answered("advance(&self)");
  return given_outputs() + answered("advance(&self, given)");
}

std::string predict_case(const Controller& controller) {
  if (!controller.size.nu) return answered("predict(&self)");
  return hand_over("given", "u_out[row]", "{NAME}_NU") + answered("predict(&self, given)");
}

std::string update_alone_case(const Controller& controller) {
  std::string out;
  for (int i = 0; i < controller.size.ny; ++i)
    if (has_update_alone(controller, i))
      out += "            if (turns[k].entry == " + std::to_string(i) + ")\n    " +
             answered("update_" + controller.problem.plant.outputs[static_cast<std::size_t>(i)].name +
                      "(&self, turns[k].number)");
  return out;
}

std::string innovation_case(const Controller& controller) {
  if (!controller.has.variance)
    return given_outputs() + "            {name}_innovation(&self, given, found);\n" + found("{NAME}_NY");
  return given_outputs() + "            {name}_innovation(&self, given, found, found + {NAME}_NY);\n" +
         found("2 * {NAME}_NY");
}

std::string set_input_case(const Controller& controller) {
  return hand_over("given", "u_out[row]", "{NAME}_NU") +
         answered(controller.has.filter ? "set_input(&self, given)" : "set_input(&self, x_in[row], given)");
}

std::string write_covariance_case(const Controller& controller) {
  if (controller.filter == step::Filter::ud) return hand_over("self.d", "self.d", "{NAME}_NX");
  return hand_over("self.P", "self.P", std::to_string(triangle(controller)));
}

std::string body_of(const Controller& controller, Call call) {
  switch (call) {
    case Call::init: return "            {name}_init(&self);\n";
    case Call::step: return step_case(controller);
    case Call::update: return given_outputs() + answered("update(&self, given)");
    case Call::update_alone: return update_alone_case(controller);
    case Call::partial_without:
      return given_outputs() + answered("partial_update(&self, given, ~(1uL << turns[k].entry))");
    case Call::partial_alone: return given_outputs() + answered("partial_update(&self, given, 1uL << turns[k].entry)");
    case Call::control: return control_case(controller);
    case Call::predict: return predict_case(controller);
    case Call::advance: return advance_case(controller);
    case Call::estimate: return "            {name}_estimate(&self, found);\n" + found("{NAME}_NX");
    case Call::set_state: return hand_over("given", "x_out[row]", "{NAME}_NX") + answered("set_state(&self, given)");
    case Call::set_input: return set_input_case(controller);
    case Call::innovation: return innovation_case(controller);
    case Call::covariance:
      return "            {name}_covariance(&self, found);\n" + found(std::to_string(triangle(controller)));
    case Call::write_r: return hand_over("self.r", "r_in[row]", "{NAME}_NR");
    case Call::write_x:
      return hand_over(std::string("self.") + controller::kept_name(controller), "x_out[row]", "{NAME}_NX");
    case Call::write_covariance: return write_covariance_case(controller);
    case Call::write_xi: return hand_over("self.xi", "self.xi", std::to_string(controller.size.nxi));
    case Call::write_z: return hand_over("self.z", "self.z", "{NAME}_NZ");
  }
  return "";
}

// In the order in which the host hashes them.
std::string state_in_hash(const Controller& controller) {
  std::string reals, counts;
  for (const Field& field : state_fields(controller)) {
    const std::string size = std::to_string(field.count);
    if (field.kind == controller::Kind::reals)
      reals += "        hash = hash_of(hash, self." + field.name + ", " + size + ");\n";
    if (field.kind == controller::Kind::total)
      counts += "        hash = hash_of_count(hash, self." + field.name + ");\n";
    if (field.kind == controller::Kind::counters)
      counts += "        for (int i = 0; i < " + size + "; i++)\n            hash = hash_of_count(hash, self." +
                field.name + "[i]);\n";
  }
  return reals + counts;
}

std::string told() {
  std::string names;
  for (const step::Event event : told_events) names += std::string(names.empty() ? "" : ", ") + status_name(event);
  return trace::wrap("    static const lqg_status_t told[] = {" + names + "};", 8);
}

}  // namespace

std::string turns_as_data(const Controller& controller, const Calls& calls) {
  const bool is_double = controller.target.is_double;
  std::string names, data;
  for (const Call call : every_call)
    if (has_call(controller, call)) names += std::string(names.empty() ? "" : ", ") + name_of(call);
  for (const Turn& turn : calls.turns)
    data += "    {" + std::string(name_of(turn.call)) + ", " + std::to_string(turn.row) + ", " +
            std::to_string(turn.entry) + ", " + number_of(turn.number, is_double) + "},\n";
  data.erase(data.size() - 2, 1);
  return "\n" + trace::wrap("enum {" + names + "};", 4) +
         "\n\n/* What is called, turn by turn: with that row of the tables, times `number`, "
         "or with `number` in place of one entry,\n"
         " * which is then not -1. A write is what a fault of the memory may leave. */\n"
         "static const struct {\n    unsigned char call, row;\n    short entry;\n    {real} number;\n"
         "} turns[TURNS] = {\n" +
         data + "};\n";
}

std::string calls_test(const Controller& controller) {
  std::string cases;
  for (const Call call : every_call)
    if (has_call(controller, call))
      cases +=
          std::string("        case ") + name_of(call) + ":\n" + body_of(controller, call) + "            break;\n";
  const auto& size = controller.size;
  const int largest = std::max({size.nx, size.ny, size.nu, 1});
  const int results = std::max({largest, 2 * size.ny, triangle(controller)});
  const Words words = {{"told", told()},
                       {"cases", cases},
                       {"given", std::to_string(largest)},
                       {"found", std::to_string(results)},
                       {"self", controller.keeps.any ? "    {name}_t self;\n" : ""},
                       {"init", controller.keeps.any ? "    {name}_init(&self);\n" : ""},
                       {"state", state_in_hash(controller)}};
  return fill(R"(
static void hand_over({real} to[], const {real} row[], int count, int turn)
{
    const int entry = turns[turn].entry;

    for (int i = 0; i < count; i++)
        to[i] = entry < 0 ? row[i] * turns[turn].number : i == entry ? turns[turn].number : row[i];
}

static uint32_t hash_of_count(uint32_t hash, unsigned long count)
{
    for (unsigned shift = 0; shift < 32; shift += 8)
        hash = (hash ^ (uint32_t)((count >> shift) & 0xff)) * 16777619u;
    return hash;
}

static uint32_t hash_of_status(uint32_t hash, lqg_status_t status)
{
{told}
    unsigned long bits = 0;

    for (unsigned i = 0; i < sizeof told / sizeof told[0]; i++)
        bits |= status & told[i] ? 1ul << i : 0ul;
    return hash_of_count(hash, bits | (status & LQG_OUTPUT_REJECTED_BITS));
}

static void test_{name}_answers_every_call_as_the_host_does(void)
{
    uint32_t hash = 2166136261u;
    {real} given[{given}], found[{found}];
{self}
{init}    for (int k = 0; k < TURNS; k++) {
        const int row = turns[k].row;
        lqg_status_t status = LQG_OK;
        int count = 0;

        switch (turns[k].call) {
{cases}        default:
            break;
        }
        hash = hash_of_status(hash, status);
        hash = hash_of(hash, found, count);
{state}    }
    TEST_ASSERT_EQUAL_HEX32(HASH_OF_TURNS, hash);
}
)",
              words);
}

}  // namespace lqg::emit
