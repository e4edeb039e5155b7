// SPDX-License-Identifier: MIT
#include "emit/unit_test/unit_test.hpp"

#include <cmath>

#include "controller/operating_point.hpp"
#include "emit/c/operating_point.hpp"
#include "emit/text/columns.hpp"
#include "emit/text/wording.hpp"
#include "emit/unit_test/calls_test.hpp"
#include "emit/unit_test/linear_unit_test.hpp"
#include "emit/vectors/vectors.hpp"
#include "trace/print.hpp"
#include "trace/wrap.hpp"

namespace lqg::emit {

namespace {

constexpr std::size_t samples_per_covariance = 20;  // P is compared in every 20th sample only: it is long

std::string row(const std::vector<double>& values, bool is_double) {
  std::string out = "    {";
  for (std::size_t i = 0; i < values.size(); ++i) out += (i ? ", " : "") + trace::literal(values[i], is_double);
  return trace::wrap(out + "}", 5);
}

// static const <real> name[samples][width] = { … };
template <class Values>
std::string table(const char* name, const std::vector<Sample>& samples, std::size_t every, bool is_double,
                  Values values) {
  const std::size_t rows = (samples.size() + every - 1) / every;
  std::string out = "static const " + std::string(is_double ? "double " : "float ") + name + "[" +
                    std::to_string(rows) + "][" + std::to_string(values(samples.front()).size()) + "] = {\n";
  for (std::size_t k = 0; k < samples.size(); k += every)
    out += row(values(samples[k]), is_double) + (k + every < samples.size() ? ",\n" : "\n");
  return out + "};\n";
}

std::string data(const Controller& controller, const Vectors& vectors) {
  const bool is_double = controller.target.is_double;
  const auto tolerances = [&](const char* name, const std::vector<double>& values) {
    std::string values_row = row(values, is_double);
    values_row = "    " + values_row.substr(5, values_row.size() - 6);  // without its braces
    return "static const " + std::string(is_double ? "double " : "float ") + name + "[" +
           std::to_string(values.size()) + "] = {\n" + values_row + "\n};\n";
  };
  std::string out;
  if (controller.has.filter) {
    out += "/* Outputs of the plant. */\n" +
           table("y_in", vectors.samples, 1, is_double, [](const Sample& sample) { return sample.y; });
    out += std::string("\n/* What the reference says: the estimate ") +
           (controller.solution.compensator ? "that z and y allow"
            : controller.linear             ? "of which u is made"
                                            : "after update") +
           " … */\n" + table("x_out", vectors.samples, 1, is_double, [](const Sample& sample) { return sample.x; });
  } else {
    out +=
        "/* States. */\n" + table("x_in", vectors.samples, 1, is_double, [](const Sample& sample) { return sample.y; });
  }
  if (controller.size.nr)
    out += "\n/* References. */\n" +
           table("r_in", vectors.samples, 1, is_double, [](const Sample& sample) { return sample.r; });
  if (controller.size.nu)
    out +=
        std::string("\n/* … ") +
        (controller.has.regulator ? "the inputs, which are applied as they are … */\n" : "the inputs that act … */\n") +
        table("u_out", vectors.samples, 1, is_double, [](const Sample& sample) { return sample.u; });
  if (!vectors.tolerance.P.empty())
    out += "\n/* … and the covariance after update, lower triangle, in every " +
           std::to_string(samples_per_covariance) + "th sample. */\n" +
           table("P_out", vectors.samples, samples_per_covariance, is_double,
                 [](const Sample& sample) { return sample.P; });
  out += "\n/* Tolerance: " + decimal(Tolerances::margin) + " times the error of the host's run in " +
         (is_double ? "double" : "float") + ",\n * which is the precision times the conditioning of this filter. */\n";
  if (controller.has.filter) out += tolerances("x_tolerance", vectors.tolerance.x);
  if (controller.has.regulator) out += tolerances("u_tolerance", vectors.tolerance.u);
  if (!vectors.tolerance.P.empty()) out += tolerances("P_tolerance", vectors.tolerance.P);
  return out;
}

std::string hash_of_state(const Controller& controller) {
  if (controller.linear) return "        hash = hash_of(hash, self.z, {NAME}_NZ);\n";
  const std::string kept = controller::kept_name(controller);
  std::string out = controller.has.filter ? "        hash = hash_of(hash, self." + kept + ", {NAME}_NX);\n" : "";
  if (controller.filter == step::Filter::plain)
    out += "        hash = hash_of(hash, self.P, (int)(sizeof self.P / sizeof self.P[0]));\n";
  if (controller.filter == step::Filter::ud) {
    if (controller.size.nx > 1)
      out += "        hash = hash_of(hash, self.U, (int)(sizeof self.U / sizeof self.U[0]));\n";
    out += "        hash = hash_of(hash, self.d, {NAME}_NX);\n";
  }
  if (controller.size.nxi)
    out += "        hash = hash_of(hash, self.xi, " + std::to_string(controller.size.nxi) + ");\n";
  return out;
}

std::string covariance_check(const Controller& controller) {
  const bool is_ud = controller.filter == step::Filter::ud;
  if (!is_ud && controller.filter != step::Filter::plain) return "";
  return std::string("        if (k % ") + std::to_string(samples_per_covariance) + " == 0) {\n" +
         (is_ud || controller.modal
              ? "            {real} P[sizeof P_tolerance / sizeof P_tolerance[0]];\n\n"
                "            {name}_covariance(&self, P);\n"
                "            assert_near(P_tolerance, P_out[k / {every}], P, (int)(sizeof P / sizeof P[0]));\n"
              : "            assert_near(P_tolerance, P_out[k / {every}], self.P, "
                "(int)(sizeof self.P / sizeof self.P[0]));\n") +
         "        }\n";
}

// In predictor form with a D update needs the input that acted on the recorded outputs, not the one that control has
// made.
bool is_told_what_acts(const Controller& controller) {
  return controller.is_predictor && controller.has.feedthrough && controller.has.regulator;
}

// What the controller keeps of the recorded input: its deviation from the operating point.
std::string set_applied(const Controller& controller, const std::string& blanks, const std::string& comment) {
  if (controller.point.u.size() == 0)
    return blanks + "memcpy(self.u_applied, u_out[k], sizeof self.u_applied);" + comment + "\n";
  std::string out;
  for (int i = 0; i < controller.size.nu; ++i) {
    const std::string entry = "[" + std::to_string(i) + "]";
    out += blanks + "self.u_applied" + entry + " = " + deviation(controller, 'u', i, "u_out[k]" + entry) + ";" +
           comment + "\n";
  }
  return out;
}

// The calls of one sample in the order of the form; {after_update} and {after_control} are what a test looks at.
std::string sample(const Controller& controller, const std::string& after_update, const std::string& after_control,
                   bool counts_limited = false) {
  if (controller.linear) return linear_sample(controller, after_update + after_control);
  const std::string reference = controller.size.nr ? "        memcpy(self.r, r_in[k], sizeof self.r);\n" : "";
  const auto call = [&](const std::string& arguments) {
    const std::string called = "{name}_control(" + arguments + ")";
    return counts_limited ? "        status = " + called +
                                ";\n        TEST_ASSERT_EQUAL_HEX(LQG_OK, status{limited});\n"
                                "        limited += status != LQG_OK;\n"
                          : "        TEST_ASSERT_EQUAL_HEX(LQG_OK, " + called + "{limited});\n";
  };
  if (!controller.has.filter)
    return reference + call(std::string(controller.keeps.any ? "&self, " : "") + "x_in[k], u") + after_update +
           after_control;
  const std::string update = "        TEST_ASSERT_EQUAL_HEX(LQG_OK, {name}_update(&self, y_in[k]){gated});\n";
  const std::string control = controller.has.regulator ? call("&self, u") : "";
  const std::string predict = controller.size.nu
                                  ? "        TEST_ASSERT_EQUAL_HEX(LQG_OK, {name}_predict(&self, u_out[k]));\n"
                                  : "        TEST_ASSERT_EQUAL_HEX(LQG_OK, {name}_predict(&self));\n";
  const std::string recorded =
      is_told_what_acts(controller) ? set_applied(controller, "        ", "  /* what acts on these outputs */") : "";
  return reference + (controller.is_predictor ? control + recorded + update : update + control) + after_update +
         after_control + predict;
}

std::string begin(const Controller& controller) {
  return std::string(controller.keeps.any ? "    {name}_t self;\n" : "") +
         (controller.has.regulator ? "    {real} u[{NAME}_NU];\n" : "") + "\n" +
         (controller.keeps.any ? "    {name}_init(&self);\n" : "");
}

std::string reference_test(const Controller& controller) {
  const std::string update =
      controller.linear          ? linear_estimate_check()
      : has_estimate(controller) ? linear_estimate_check() + covariance_check(controller)
      : controller.has.filter
          ? "        assert_near(x_tolerance, x_out[k], self.x, {NAME}_NX);\n" + covariance_check(controller)
          : "";
  const std::string control =
      controller.has.regulator ? "        assert_near(u_tolerance, u_out[k], u, {NAME}_NU);\n" : "";
  return "\nstatic void test_{name}_follows_the_reference_of_the_host(void)\n{\n" + begin(controller) +
         "    for (int k = 0; k < SAMPLES; k++) {\n" + sample(controller, update, control) + "    }\n}\n";
}

std::string bits_test(const Controller& controller) {
  const std::string control = controller.has.regulator ? "        hash = hash_of(hash, u, {NAME}_NU);\n" : "";
  const bool counts_limited = controller.has.regulator && controller.problem.limits.has_value();
  return std::string(
             "\nstatic void test_{name}_has_every_bit_of_the_host(void)\n{\n"
             "    uint32_t hash = 2166136261u;\n") +
         (counts_limited ? "    lqg_status_t status;\n    int limited = 0;\n" : "") + begin(controller) +
         "    for (int k = 0; k < SAMPLES; k++) {\n" +
         sample(controller, hash_of_state(controller), control, counts_limited) +
         "    }\n    TEST_ASSERT_EQUAL_HEX32(HASH, hash);\n" +
         (counts_limited ? "    TEST_ASSERT_EQUAL_INT({samples_at_limits}, limited);\n" : "") + "}\n";
}

// What one sample with a hostile number calls and looks at. The outputs are recorded, and so is the input that acts:
// with its own the estimate would run away from them wherever a controller is unstable without its plant.
std::string hostile_sample(const Controller& controller) {
  if (controller.linear) return linear_hostile_sample(controller);
  const std::string act = controller.has.regulator ? R"(                (void){name}_control(&self, u);
                for (int i = 0; i < {NAME}_NU; i++)
                    TEST_ASSERT_TRUE(u[i] - u[i] == {zero}{within});
)"
                                                   : "";
  const std::string recorded = is_told_what_acts(controller) ? set_applied(controller, "                ", "") : "";
  const std::string update = R"(                status = {name}_update(&self, y);
                if (k % 3 == 1 && what < 5)
                    TEST_ASSERT_TRUE(status & LQG_OUTPUT_REJECTED);
)";
  return (controller.is_predictor ? act + recorded + update : update + act) +
         "                (void){name}_predict(&self" + (controller.size.nu ? ", u_out[k]" : "") + R"();
                for (int i = 0; i < {NAME}_NX; i++)
                    TEST_ASSERT_TRUE(self.{kept}[i] > -bound[i] && self.{kept}[i] < bound[i]);
)";
}

// A hostile number in each output in turn: finite and within its limits, and no reset.
std::string fault_test(const Controller& controller) {
  if (!controller.has.filter) return "";
  const bool has_bounds = !controller.linear;
  const Words words = {
      {"stays", has_bounds ? "within_its_bounds" : "finite"},
      {"bound", has_bounds ? "    static const {real} bound[{NAME}_NX] = {NAME}_{KEPT}_BOUNDS;\n" : ""},
      {"u", controller.has.regulator ? "            {real} u[{NAME}_NU];\n" : ""},
      {"sample", hostile_sample(controller)},
      {"end", has_bounds ? "            TEST_ASSERT_EQUAL_UINT(0, self.resets);\n" : ""}};
  return fill(R"(
static void test_{name}_stays_{stays}_whatever_a_sensor_says(void)
{
{bound}    const {real} hostile[] = {({real})NAN, ({real})INFINITY, -({real})INFINITY, {huge}, -{huge}, {tiny}};

    for (int bad = 0; bad < {NAME}_NY; bad++) {
        for (int what = 0; what < (int)(sizeof hostile / sizeof hostile[0]); what++) {
            {name}_t self;
{u}            {real} y[{NAME}_NY];

            {name}_init(&self);
            for (int k = 0; k < SAMPLES; k++) {
                lqg_status_t status;

                memcpy(y, y_in[k], sizeof y);
                y[bad] = k % 3 == 1 ? hostile[what] : y[bad];
{sample}            }
{end}        }
    }
}
)",
              words);
}

std::string main_function(const Controller& controller) {
  return std::string(
             "\nint main(void)\n{\n    UNITY_BEGIN();\n"
             "    RUN_TEST(test_{name}_follows_the_reference_of_the_host);\n"
             "{bits}") +
         (controller.linear       ? "    RUN_TEST(test_{name}_stays_finite_whatever_a_sensor_says);\n"
          : controller.has.filter ? "    RUN_TEST(test_{name}_stays_within_its_bounds_whatever_a_sensor_says);\n"
                                  : "") +
         "    return UNITY_END();\n}\n";
}

std::string helpers() {
  return R"(
void setUp(void)
{
}

void tearDown(void)
{
}

static void assert_near(const {real} tolerance[], const {real} expected[], const {real} found[], int count)
{
    for (int i = 0; i < count; i++)
        TEST_ASSERT_{REAL}_WITHIN(tolerance[i], expected[i], found[i]);
}

/* FNV-1a over the bits of the values, least significant byte first; −0 counts as 0, each NaN as the same. */
static uint32_t hash_of(uint32_t hash, const {real} values[], int count)
{
    for (int i = 0; i < count; i++) {
        const {real} value = values[i] + {zero};
        {bits_type} bits;

        memcpy(&bits, &value, sizeof bits);
        if ((bits & {magnitude}) > {infinity})
            bits = {nan};
        for (unsigned shift = 0; shift < 8 * sizeof bits; shift += 8)
            hash = (hash ^ (uint32_t)((bits >> shift) & 0xff)) * 16777619u;
    }
    return hash;
}
)";
}

// None where every number of the target is within the limit.
std::string bound(const char* comparison, double limit, const Controller& controller) {
  const bool is_double = controller.target.is_double;
  return std::isinf(is_double ? limit : static_cast<double>(static_cast<float>(limit)))
             ? ""
             : comparison + trace::literal(limit, is_double);
}

std::string hexadecimal(std::uint32_t value) {
  std::string out = "0x00000000";
  for (std::size_t i = 0; i < 8; ++i) out[9 - i] = "0123456789abcdef"[value >> (4 * i) & 15];
  return out;
}

// An output that is left out takes with it those whose noise only it makes independent.
bool mixes_outputs(const Controller& controller) {
  for (int i = 0; i < controller.size.ny; ++i)
    if (!can_update_alone(controller, i)) return true;
  return false;
}

Words test_words(const Controller& controller, const Vectors& vectors) {
  Words words = common_words(controller);
  words["hash"] = hexadecimal(vectors.hash);
  words["REAL"] = upper(words["real"]);
  words["kept"] = controller::kept_name(controller);
  words["KEPT"] = upper(words["kept"]);
  words["bits_type"] = controller.target.is_double ? "uint64_t" : "uint32_t";
  words["magnitude"] = controller.target.is_double ? "0x7fffffffffffffffu" : "0x7fffffffu";
  words["infinity"] = controller.target.is_double ? "0x7ff0000000000000u" : "0x7f800000u";
  words["nan"] = controller.target.is_double ? "0x7ff8000000000000u" : "0x7fc00000u";
  words["turns"] = std::to_string(vectors.calls.turns.size());
  words["hash_of_turns"] = hexadecimal(vectors.calls.hash);
  words["samples"] = std::to_string(vectors.samples.size());
  words["every"] = std::to_string(samples_per_covariance);
  words["samples_at_limits"] = std::to_string(vectors.limited);
  words["limited"] = controller.has.foresight    ? " & ~(LQG_INPUT_LIMITED | LQG_NOT_OPTIMAL)"
                     : controller.problem.limits ? " & ~LQG_INPUT_LIMITED"
                                                 : "";
  words["gated"] = !controller.has.gate ? ""
                   : mixes_outputs(controller)
                       ? " & ~(LQG_OUTPUT_GATED | LQG_OUTPUT_REJECTED | LQG_OUTPUT_REJECTED_BITS)"
                       : " & ~LQG_OUTPUT_GATED";
  words["huge"] = controller.target.is_double ? "1e308" : "3e38f";
  words["tiny"] = controller.target.is_double ? "5e-324" : "1e-45f";
  words["within"] = "";
  if (const auto& limits = controller.problem.limits; limits && limits->u_min.size() && controller.size.nu == 1)
    words["within"] = bound(" && u[i] >= ", controller::own_input_limits(controller, +1)(0), controller) +
                      bound(" && u[i] <= ", controller::own_input_limits(controller, -1)(0), controller);
  // A fused multiply-add is the same everywhere if it is one instruction, or a library's that rounds correctly.
  words["bits"] =
      "    RUN_TEST(test_{name}_has_every_bit_of_the_host);\n"
      "    RUN_TEST(test_{name}_answers_every_call_as_the_host_does);\n";
  if (controller.target.is_fused)
    words["bits"] = fill("#if defined FP_FAST_{FMA} || defined __FP_FAST_{FMA} || defined __GLIBC__\n",
                         {{"FMA", controller.target.is_double ? "FMA" : "FMAF"}}) +
                    words["bits"] + "#endif\n";  // newlib's math.h lacks the first, GCC has the second built in
  words["bits"] = fill(words["bits"], words);
  return words;
}

}  // namespace

std::string unit_test(const Controller& controller) {
  const Vectors vectors = make_vectors(controller);
  const std::string text =
      "\n#include <math.h>\n#include <stdint.h>\n#include <string.h>\n\n"
      "#include \"unity.h\"\n\n#include \"{name}.h\"\n\n"
      "#define SAMPLES {samples}\n#define HASH {hash}u  /* over every bit of all results, on the host */\n"
      "#define TURNS {turns}\n#define HASH_OF_TURNS {hash_of_turns}u\n\n" +
      data(controller, vectors) + turns_as_data(controller, vectors.calls) + helpers() + reference_test(controller) +
      bits_test(controller) + calls_test(controller) + fault_test(controller) + main_function(controller);
  return fit_columns("/* Test of " + controller.problem.name +
                     ".h, to be run with Unity on the PC, under emulation or on the board.\n *\n" +
                     provenance(controller) + " */\n" + fill(text, test_words(controller, vectors)));
}

}  // namespace lqg::emit
