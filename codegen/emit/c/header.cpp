// SPDX-License-Identifier: MIT
#include "emit/c/header.hpp"

#include "emit/c/functions.hpp"
#include "emit/c/preamble.hpp"
#include "controller/state_fields.hpp"
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

std::string handshake(const Controller& controller) {
  return fill(R"(
#if LQG_HEADER_FORMAT != {format}
#error "{name}.h was made by lqgen {version}, which this TinyLQG does not know: run the lqgen of this TinyLQG on {file} again."
#endif
)",
              {{"format", header_format()},
               {"name", controller.problem.name},
               {"version", version()},
               {"file", controller.source.file}});
}

// Some compilers' double is float, avr-gcc's by default.
std::string width_of_double(const Controller& controller) {
  if (!controller.target.is_double) return "";
  return fill(R"(
#if defined __SIZEOF_DOUBLE__ && __SIZEOF_DOUBLE__ < 8
#error "{name}.h computes in double, which has less than 64 bits here: run lqgen with --real float."
#endif
)",
              {{"name", controller.problem.name}});
}

// A macro, because it is a list that any array may begin with.
std::string bounds(const Controller& controller) {
  std::string values;
  for (const double bound : controller::powers_of_two(controller.bounds.x))
    values += (values.empty() ? "" : ", ") + trace::literal(bound, controller.target.is_double);
  std::string out;
  for (const char c : trace::wrap(fill("#define {NAME}_X_BOUNDS {", common_words(controller)) + values + "}", 4, 98))
    out += c == '\n' ? std::string(" \\\n") : std::string(1, c);
  return out + "  /* x̂ stays below them in size, or begins anew */\n";
}

// How long a fault lasts, and where it stays.
std::string recovery(const Controller& controller) {
  const controller::Recovery& recovery = controller.recovery;
  std::string lasting;
  for (const int state : recovery.lasting)
    lasting += (lasting.empty() ? "" : ", ") + controller.problem.plant.states[static_cast<std::size_t>(state)].name;
  std::string out;
  if (recovery.samples)
    out =
        fill("#define {NAME}_RECOVERY_SAMPLES {samples}  /* after a fault has ended its effect is below the noise */\n",
             {{"NAME", upper(controller.problem.name)}, {"samples", std::to_string(recovery.samples)}});
  else if (controller.has.filter)
    out = "/* For no number of samples is it certain that a fault is forgotten: not every error dies out. */\n";
  if (!lasting.empty())
    out += "/* No noise reaches " + lasting + ": a fault's effect stays there, and in what is estimated by it. */\n";
  return out;
}

std::string dimensions(const Controller& controller) {
  const Words words = common_words(controller);
  std::string out = fill("\n#define {NAME}_NX {nx}  /* states */\n", words);
  if (controller.size.nu) out += fill("#define {NAME}_NU {nu}  /* inputs */\n", words);
  if (controller.has.filter) out += fill("#define {NAME}_NY {ny}  /* outputs */\n", words);
  if (controller.linear) out += fill("#define {NAME}_NZ {nz}  /* numbers that stand for them */\n", words);
  if (controller.size.nr) out += fill("#define {NAME}_NR {nr}  /* references */\n", words);
  if (!controller.bounds.x.empty()) out += bounds(controller);
  out += recovery(controller);
  return out + fill("#define {NAME}_SAMPLE_TIME ", words) +
         trace::literal(controller.problem.plant.sample_time, controller.target.is_double) +
         "  /* s between two samples */\n";
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
      "\n/* The whole state of the controller: no pointers inside, may be copied. Begin it with {name}_init. */\n"
      "typedef struct {\n" +
          fill(fields, common_words(controller)) + "} {name}_t;\n",
      common_words(controller));
}

}  // namespace

std::string header(const Controller& controller) {
  const FunctionBodies bodies = controller.linear                            ? straight_line_bodies(controller)
                                : controller.style == design::Style::compact ? compact_bodies(controller)
                                                                             : unrolled_bodies(controller);
  const design::Plant& plant = controller.problem.plant;
  const std::string guard = upper(controller.problem.name) + "_H";
  std::string out = preamble(controller) + "#ifndef " + guard + "\n#define " + guard + "\n\n" + bodies.includes;
  out += handshake(controller) + width_of_double(controller) + dimensions(controller);
  out += index_enum(controller, "X", state_signals(controller)) + index_enum(controller, "U", plant.inputs);
  if (controller.has.filter) out += index_enum(controller, "Y", plant.outputs);
  out += index_enum(controller, "R", reference_signals(controller)) + state_type(controller);
  if (!bodies.constants.empty()) out += "\n" + bodies.constants;
  out += "\nLQG_STRICT_BEGIN\n" + bodies.options + functions(controller, bodies);
  return out + "\nLQG_STRICT_END\n\n#endif\n";
}

}  // namespace lqg::emit
