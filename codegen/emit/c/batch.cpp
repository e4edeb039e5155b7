// SPDX-License-Identifier: MIT
// The traced sample as a loop over lanes. Its text is that of NAME_step, from the same record: a question to NAME_weigh
// and a recovery are branches, and stay as the conditions under which a lane has none of them. A lane whose conditions
// do not all hold takes NAME_step itself, so that its bits are those of NAME_step whatever the record says.
//
// What the sample overwrites is saved at its start. That is one store for each number; to choose at the end between
// the old and the new state would take as many stores, and keep all of the old state in registers until then.
#include "emit/c/batch.hpp"

#include <algorithm>
#include <map>

#include "controller/gains.hpp"
#include "emit/c/templates.hpp"
#include "emit/recorded/linear_traced.hpp"
#include "emit/recorded/traced.hpp"
#include "emit/text/columns.hpp"
#include "emit/text/wording.hpp"
#include "trace/print.hpp"
#include "trace/wrap.hpp"

namespace lqg::emit {

namespace {

bool is_array(const Field& field) {
  return field.kind == controller::Kind::reals || field.kind == controller::Kind::counters;
}

// "{real} x[{NAME}_NX][{NAME}_BATCH_LANES]", commented as in NAME_t.
std::string fields_of_lanes(const Controller& controller) {
  std::string out;
  for (const Field& field : state_fields(controller)) {
    const char* const type = field.kind == controller::Kind::reals     ? "{real}"
                             : field.kind == controller::Kind::counter ? "unsigned"
                                                                       : "unsigned long";
    out += std::string("    ") + type + " " + field.name + (is_array(field) ? "[" + field.dimension + "]" : "") +
           "[{NAME}_BATCH_LANES];" + (field.comment.empty() ? "" : "  /* " + field.comment + " */") + "\n";
  }
  return fill(out, common_words(controller));
}

// For each field, and each of its numbers: `to` = `from`. "[i]" is the number of an array.
std::string copied(const std::vector<Field>& fields, const std::string& to, const std::string& to_lane,
                   const std::string& from, const std::string& from_lane) {
  std::string out;
  for (const Field& field : fields) {
    const std::string i = is_array(field) ? "[i]" : "";
    const std::string line = to + field.name + i + to_lane + " = " + from + field.name + i + from_lane + ";\n";
    out += is_array(field) ? "    for (int i = 0; i < " + field.dimension + "; i++) {\n        " + line + "    }\n"
                           : "    " + line;
  }
  return out;
}

class Batch {
 public:
  explicit Batch(const Controller& controller)
      : controller_(controller), function_(traced(controller)), printer_(*function_.graph, results()) {}

  std::string header() const {
    const std::vector<Field> fields = state_fields(controller_);
    const design::Problem& problem = controller_.problem;
    return write_body(templates::batch, controller_,
                      {{"brief", problem.brief.empty() ? "" : "; " + problem.brief},
                       {"provenance", provenance(controller_)},
                       {"file_h", problem.name + ".h"},
                       {"unusual_when", unusual_when()},
                       {"needs", needs()},
                       {"fields", fields_of_lanes(controller_)},
                       {"get", filled(copied(fields, "one->", "", "self->", "[lane]"))},
                       {"set", filled(copied(fields, "self->", "[lane]", "one->", ""))},
                       {"restored", restored()},
                       {"law", law()},
                       {"index_y", index("Y", problem.plant.outputs)},
                       {"index_u", index("U", problem.plant.inputs)},
                       {"rows", row("law", controller_.laws, "{NAME}_LAW", "{law_row}", "sample") +
                                    row("gains", controller_.filters, "{NAME}_GAINS", "{filter_row}", "gain_row")},
                       {"saved", saved()},
                       {"statements", further_in(statements())}},
                      {{"is_told_u", !controller_.has.regulator && controller_.size.nu > 0}});
  }

 private:
  static TracedFunction traced(Controller controller) {
    controller.target.is_lane = true;
    return controller.linear ? trace_linear(controller).step : trace_sample(controller, covariance_pattern(controller));
  }

  std::string filled(const std::string& text) const { return fill(text, common_words(controller_)); }

  static std::string further_in(const std::string& text) {
    std::string out;
    for (std::size_t at = 0; at < text.size();) {
      const std::size_t end = text.find('\n', at) + 1;
      out += (end == at + 1 || text[at] == '#' ? "" : "    ") + text.substr(at, end - at);
      at = end;
    }
    return out;
  }

  // "TWO_MASS_Y_DY1"
  std::string index(const std::string& kind, const std::vector<design::Signal>& signals) const {
    return signals.empty() ? "" : filled("{NAME}_" + kind + "_") + upper(signals.front().name);
  }

  // Of the processor: without comparisons of 64 bits, or the instruction, GCC makes no vectors at all.
  std::string needs() const {
    if (controller_.target.is_fused) return " Fused multiply-adds need -mfma.";
    return controller_.target.is_double ? " Doubles need -msse4.2 or more." : "";
  }

  std::string unusual_when() const {
    std::string out;
    const auto add = [&](const std::string& line) { out += " *   " + line + "\n"; };
    if (controller_.linear) {
      add("an output, an input or z is not finite");
      return out;
    }
    if (controller_.has.gate) add("an output is further from its expected value than usual, or was so shortly before");
    add(std::string("the state leaves its bounds") +
        (carries_covariance(controller_) ? ", or P could not be a covariance" : ""));
    return out;
  }

  std::string law() const {
    if (controller_.linear)
      return controller_.is_predictor ? "u = C z,  z ← A z + B y" : "u = C z + D y,  z ← A z + B y";
    if (controller::is_extended(controller_))
      return "an update, " +
             std::string(controller_.has.regulator ? "u = " + equation_of_law(controller_) + ", " : "") +
             "a prediction";
    const std::string update = controller_.has.feedthrough ? "x̂ ← x̂ + L (y − C x̂ − D u)" : "x̂ ← x̂ + L (y − C x̂)";
    const std::string act = controller_.has.regulator ? "u = " + equation_of_law(controller_) + ",  " : "";
    const std::string predict = controller_.size.nu ? "x̂ ← A x̂ + B u" : "x̂ ← A x̂";
    return controller_.is_predictor ? act + update + ",  " + predict : update + ",  " + act + predict;
  }

  // What is printed, and nothing else is.
  std::vector<int> results() const {
    std::vector<int> nodes = function_.asked;
    for (const trace::Store& store : stores()) nodes.push_back(store.node);
    const auto add = [&](const std::vector<int>& statuses, int finite) {
      nodes.insert(nodes.end(), statuses.begin(), statuses.end());
      if (finite >= 0) nodes.push_back(finite);
    };
    if (function_.before) add(function_.before->statuses, function_.before->finite);
    add(function_.statuses, function_.finite);
    return nodes;
  }

  std::vector<trace::Store> stores() const {
    std::vector<trace::Store> all;
    if (function_.before) all = function_.before->stores;
    all.insert(all.end(), function_.stores.begin(), function_.stores.end());
    all.insert(all.end(), function_.stores_if_sound.begin(), function_.stores_if_sound.end());
    return last_of_each(all);
  }

  // Without a recovery between them, only the last store to a place is of use.
  static std::vector<trace::Store> last_of_each(const std::vector<trace::Store>& all) {
    std::map<std::string, std::size_t> last;
    for (std::size_t i = 0; i < all.size(); ++i) last[all[i].target] = i;
    std::vector<trace::Store> out;
    for (std::size_t i = 0; i < all.size(); ++i)
      if (last[all[i].target] == i) out.push_back(all[i]);
    return out;
  }

  // Places of the state that the sample overwrites, "x[0]", and the counters that it advances.
  std::vector<std::string> overwritten() const {
    const std::string self = "self->";
    std::vector<std::string> out;
    for (const trace::Store& store : stores())
      if (store.target.compare(0, self.size(), self) == 0) out.push_back(store.target.substr(self.size()));
    if (controller_.keeps.sample) out.push_back("sample");
    if (controller_.keeps.gain_row) out.push_back("gain_row");
    return out;
  }

  std::string saved() const {
    std::string out = "        /* the state before the sample */\n";
    for (const std::string& place : overwritten())
      out += "        before." + place + "[lane] = self->" + place + "[lane];\n";
    return out;
  }

  // A loop where all of an array is overwritten.
  std::string restored() const {
    const std::vector<std::string> places = overwritten();
    std::string out;
    for (const Field& field : state_fields(controller_)) {
      std::vector<std::string> of_field;
      for (const std::string& place : places)
        if (place.substr(0, place.find('[')) == field.name) of_field.push_back(place);
      if (static_cast<int>(of_field.size()) == field.count) {
        out += copied({field}, "self->", "[lane]", "before->", "[lane]");
        continue;
      }
      for (const std::string& place : of_field) out += "    self->" + place + "[lane] = before->" + place + "[lane];\n";
    }
    return filled(out);
  }

  // The gains that change from sample to sample, collected before the loop: each lane may be in another row.
  std::string row(const std::string& array, const std::vector<Gains>& gains, const std::string& table,
                  const std::string& index, const std::string& counter) const {
    const std::size_t count = controller::changing_places(gains, controller_.target.is_double).size();
    if (count == 0) return "";
    std::string of_lane = filled(index);
    const std::string self = "self->" + counter;
    for (std::size_t at = 0; (at = of_lane.find(self, at)) != std::string::npos; at += self.size())
      of_lane.insert(at + self.size(), "[lane]");
    const std::string size = std::to_string(count);
    return filled("    {real} " + array + "[" + size +
                  "][{NAME}_BATCH_LANES];  /* gains of the sample of each lane */\n"
                  "\n    for (int lane = 0; lane < {NAME}_BATCH_LANES; lane++) {\n"
                  "        const {real} *const row = " +
                  table + "[" + of_lane +
                  "];\n\n"
                  "        for (int i = 0; i < " +
                  size + "; i++) {\n            " + array + "[i][lane] = row[i];\n        }\n    }\n");
  }

  std::string condition(int node) const { return printer_.test_by_names(node); }

  // In a lane in which nothing is unusual all of these hold.
  std::vector<std::string> conditions() const {
    std::vector<std::string> all;
    const auto add_faults = [&](const std::string& faults) {
      if (!faults.empty() && finds_status()) all.push_back("(status_of_lane & " + faults + ") == LQG_OK");
    };
    for (const int asked : function_.asked) all.push_back(printer_.expression(asked));
    if (function_.before) {
      all.push_back(condition(function_.before->finite));
      add_faults(function_.before->faults);
    }
    if (function_.finite >= 0) all.push_back(condition(function_.finite));
    add_faults(function_.faults);
    return all;
  }

  // Without NAME_weigh, whose lanes are computed again.
  bool finds_status() const {
    return !function_.statuses.empty() || (function_.before && !function_.before->statuses.empty());
  }

  std::string raised() const {
    if (!finds_status()) return "    status[lane] = LQG_OK;\n";
    std::string out = "    lqg_status_t status_of_lane = LQG_OK;\n";
    const auto add = [&](const std::vector<int>& statuses) {
      for (const int status : statuses)
        out += trace::wrap("    status_of_lane |= " + printer_.operand(status) + ";", 8) + "\n";
    };
    if (function_.before) add(function_.before->statuses);
    add(function_.statuses);
    return out + "    status[lane] = status_of_lane;\n";
  }

  // The counters that choose the gains of the next sample.
  std::string advanced() const {
    std::string out;
    const auto add = [&](const std::string& counter, const std::string& last) {
      const std::string place = "self->" + counter + "[lane]", limit = "{NAME}_LAST_" + last;
      out += "    " + place + " = (" + place + " < " + limit + ") ? (" + place + " + 1u) : " + limit + ";\n";
    };
    if (controller_.keeps.sample) add("sample", "SAMPLE");
    if (controller_.keeps.gain_row) add("gain_row", "GAIN_ROW");
    return filled(out);
  }

  std::string statements() const {
    std::string usual;
    for (const std::string& condition : conditions()) {
      const bool is_name = condition.find(' ') == std::string::npos;
      usual += (usual.empty() ? "" : " & ") + (is_name ? condition : "(" + condition + ")");
    }
    return printer_.statements(stores()) + "\n" + advanced() + raised() +
           "\n    /* nothing is unusual: no output is weighed, and the state is within its bounds all the time */\n" +
           trace::wrap("    const bool usual = " + usual + ";", 8) +
           "\n    unusual[lane] = usual ? 0u : 1u;\n    unusual_lanes |= unusual[lane];\n";
  }

  const Controller& controller_;
  const TracedFunction function_;
  const trace::Printer printer_;
};

}  // namespace

std::optional<std::string> why_no_batch(const Controller& controller) {
  if (!controller.has.filter)
    return "a batch needs a filter: a regulator alone has no " + controller.problem.name + "_step";
  const bool has_loops =
      controller.style == design::Style::compact || controller.sharing != controller::Sharing::nothing;
  if (!controller.linear && has_loops)
    return "a batch is straight-line code, whose zeros may have other signs than those of compact loops: expected "
           "style unrolled; run lqgen with --style unrolled";
  if (controller.has.foresight)
    return "limits that are foreseen take as long as each instance needs, one after the other: expected no "
           "limits.horizon";
  return std::nullopt;
}

std::string batch_header(const Controller& controller) { return fit_columns(Batch(controller).header()); }

}  // namespace lqg::emit
