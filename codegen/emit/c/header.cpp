// SPDX-License-Identifier: MIT
#include "emit/c/header.hpp"

#include <algorithm>

#include "emit/c/foresight.hpp"
#include "emit/c/functions.hpp"
#include "emit/c/preamble.hpp"
#include "controller/state_fields.hpp"
#include "emit/recorded/constants.hpp"
#include "emit/text/columns.hpp"
#include "emit/text/wording.hpp"
#include "trace/print.hpp"

namespace lqg::emit {

namespace {

// "{real} x[{NAME}_NX]"
std::string declaration(const Field& field) {
  switch (field.kind) {
    case controller::Kind::counter: return "unsigned " + field.name;
    case controller::Kind::total: return "unsigned long " + field.name;
    case controller::Kind::counters: return "unsigned long " + field.name + "[" + field.dimension + "]";
    default: return "{real} " + field.name + "[" + field.dimension + "]";
  }
}

std::string handshake() {
  return fill(R"(
#if LQG_HEADER_FORMAT != {format}
#error "This file needs header format {format}, the library has another one: regenerate it with the library's lqgen."
#endif
)",
              {{"format", header_format()}});
}

// Some compilers' double is float, avr-gcc's by default.
std::string width_of_double(const Controller& controller) {
  if (!controller.target.is_double) return "";
  return R"(
#if defined __SIZEOF_DOUBLE__ && __SIZEOF_DOUBLE__ < 8
#error "This file computes in double, which has less than 64 bits here: run lqgen with --real float."
#endif
)";
}

// It is right without the instruction, too, but nobody would guess how slow.
std::string speed_of_fused(const Controller& controller) {
  if (!controller.target.is_fused) return "";
  return fill(
      R"(
#if !{has_it} && !defined LQG_SLOW_FUSED
#pragma message("{name}: fused multiply-adds are slow here. Compile for a processor that has them (x86: -mfma), \
run lqgen with arithmetic = \"plain\", or define LQG_SLOW_FUSED.")
#endif
)",
      {{"has_it", controller.target.is_double ? "LQG_HAS_FMA" : "LQG_HAS_FMAF"}, {"name", controller.problem.name}});
}

// A macro, because it is a list that any array may begin with.
std::string bounds(const Controller& controller) {
  Words words = common_words(controller);
  words["of"] = controller.modal ? "z" : "x̂";
  words["KEPT"] = upper(controller::kept_name(controller));
  std::string out = fill(
      "/* Limit of |{of}_i|: the state is reset when it is reached. */\n"
      "#define {NAME}_{KEPT}_BOUNDS { \\\n",
      words);
  const std::vector<design::Signal> states = kept_signals(controller);
  const std::vector<double> values = controller::powers_of_two(controller.bounds.x);
  for (std::size_t i = 0; i < values.size(); ++i)
    out += "    " + trace::literal(values[i], controller.target.is_double) + (i + 1 < values.size() ? "," : "") +
           "  /* 2^" + std::to_string(controller.bounds.x[i]) + ": " + name_with_unit(states[i]) + " */ \\\n";
  return out + "}\n";
}

// Where a table of gains, or the time, ends.
std::string last_rows(const Controller& controller) {
  const auto define = [&](const std::string& what, std::size_t value, const char* origin) {
    return fill("#define {NAME}_", common_words(controller)) + what + " " + std::to_string(value) + "u  /* " + origin +
           " */\n";
  };
  std::string out;
  if (controller.keeps.sample)
    out += define("LAST_SAMPLE", controller.last_sample, "`sample` stops there: nothing changes any more");
  int stage = 0;
  for (const std::size_t start : controller.stage_starts)
    if (start > 0) out += define("STAGE_" + std::to_string(++stage), start, "the sample from which on it is in force");
  if (controller.laws.size() > 1)
    out += define("LAST_LAW_ROW", controller.laws.size() - 1, "rows of the law's gains, less 1");
  if (controller.keeps.gain_row)
    out += define("LAST_GAIN_ROW", controller.filters.size() - 1, "rows of the filter's gains, less 1");
  return out;
}

// Columns aligned where there is room; the origin above it where it does not fit behind.
std::string define(const Constant& constant, std::size_t name, std::size_t value) {
  const std::string comment = "/* " + constant.origin + " */";
  const auto line = [&](std::size_t name_width, std::size_t value_width) {
    const auto fill_up = [](const std::string& text, std::size_t to) {
      return std::string(std::max(text.size(), to) - text.size(), ' ');
    };
    return "#define " + constant.name + fill_up(constant.name, name_width) + " " + constant.value +
           fill_up(constant.value, value_width);
  };
  for (const std::string& text : {line(name, value), line(name, 0), line(0, 0)})
    if (columns(text + "  " + comment) <= widest_line) return text + "  " + comment + "\n";
  return comment + "\n" + line(0, 0) + "\n";
}

// Numbers that are no gains.
std::string constants(const Controller& controller, const std::string& code) {
  const std::vector<Constant> all = constants_of(controller, code);
  std::string out = last_rows(controller);
  std::size_t name = 0, value = 0;
  for (const Constant& constant : all) {
    name = std::max(name, constant.name.size());
    value = std::max(value, constant.value.size());
  }
  for (const Constant& constant : all) out += define(constant, name, value);
  if (out.empty()) return "";
  return "\n/* Limits, bounds and thresholds of the code below, each with its unit and origin. */\n" + out;
}

// How long a fault lasts, and where it stays.
std::string recovery(const Controller& controller) {
  const controller::Recovery& recovery = controller.recovery;
  std::string lasting;
  for (const int state : recovery.lasting)
    lasting += (lasting.empty() ? "" : ", ") + controller.problem.plant.states[static_cast<std::size_t>(state)].name;
  std::string out;
  if (recovery.samples)
    out = fill(
        "#define {NAME}_RECOVERY_SAMPLES {samples}  /* samples after a fault until its effect is below the noise */\n",
        {{"NAME", upper(controller.problem.name)}, {"samples", std::to_string(recovery.samples)}});
  else if (controller::is_extended(controller))
    out = "/* No number of samples until recovery can be stated: it depends on where the estimate is. */\n";
  else if (controller.has.filter)
    out = "/* No number of samples until recovery can be stated: not every error decays. */\n";
  if (!lasting.empty())
    out += "/* No noise reaches " + lasting +
           ": the effect of a fault stays there, and in estimates that depend on it. */\n";
  return out;
}

std::string dimensions(const Controller& controller) {
  const Words words = common_words(controller);
  std::string out = fill("\n#define {NAME}_NX {nx}  /* states */\n", words);
  if (controller.size.nu) out += fill("#define {NAME}_NU {nu}  /* inputs */\n", words);
  if (controller.has.filter) out += fill("#define {NAME}_NY {ny}  /* outputs */\n", words);
  if (controller.linear) out += fill("#define {NAME}_NZ {nz}  /* numbers z that represent them */\n", words);
  if (controller.size.nr) out += fill("#define {NAME}_NR {nr}  /* references */\n", words);
  if (!controller.bounds.x.empty()) out += bounds(controller);
  out += recovery(controller);
  return out + fill("#define {NAME}_SAMPLE_TIME ", words) +
         trace::literal(controller.problem.plant.sample_time, controller.target.is_double) +
         "  /* s, plant.sample_time */\n";
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
  if (!controller.keeps.any) return "";
  std::string fields;
  for (const Field& field : state_fields(controller)) {
    fields += "    " + declaration(field);
    fields += field.comment.empty() ? ";\n" : ";  /* " + field.comment + " */\n";
  }
  return fill(
      "\n/* The whole state of the controller. It has no pointers and may be copied. "
      "Initialise it with {name}_init. */\n"
      "typedef struct {\n" +
          fill(fields, common_words(controller)) + "} {name}_t;\n",
      common_words(controller));
}

}  // namespace

std::string header(const Controller& controller) {
  FunctionBodies bodies = controller.linear                                     ? straight_line_bodies(controller)
                          : controller.style == design::Style::compact          ? compact_bodies(controller)
                          : controller.sharing == controller::Sharing::products ? products_bodies(controller)
                          : controller.sharing != controller::Sharing::nothing  ? shared_bodies(controller)
                                                                                : unrolled_bodies(controller);
  if (controller.has.foresight) add_foresight(controller, bodies);
  const design::Plant& plant = controller.problem.plant;
  const std::string guard = upper(controller.problem.name) + "_H", code = functions(controller, bodies);
  std::string out = preamble(controller, code) + "#ifndef " + guard + "\n#define " + guard + "\n\n" + bodies.includes;
  out += handshake() + width_of_double(controller) + speed_of_fused(controller) + dimensions(controller);
  out += constants(controller, bodies.constants + code);
  out += index_enum(controller, "X", state_signals(controller)) + index_enum(controller, "U", plant.inputs);
  if (controller.has.filter) out += index_enum(controller, "Y", plant.outputs);
  out += index_enum(controller, "R", reference_signals(controller)) + state_type(controller);
  if (!bodies.constants.empty()) out += "\n" + bodies.constants;
  out += "\nLQG_STRICT_BEGIN\n" + bodies.options + code;
  out += "\nLQG_STRICT_END\n\n#endif\n";
  return controller.target.is_prover ? out : fit_columns(out);
}

}  // namespace lqg::emit
