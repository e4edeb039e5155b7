#include "input/keys.hpp"

#include <algorithm>
#include <cstddef>

#include "input/foreign_words.hpp"
#include "input/text.hpp"

namespace lqg::input {
namespace {

constexpr auto no = Size::none;
constexpr auto nx = Size::nx;
constexpr auto nu = Size::nu;
constexpr auto ny = Size::ny;
constexpr auto nw = Size::nw;
constexpr auto integrals = Size::integrals;
constexpr auto required = Need::required;
constexpr auto optional = Need::optional;

const std::vector<KeyRule> rules = {
    {"name", Type::identifier, no, no, required},
    {"brief", Type::line},

    {"plant", Type::table, no, no, required},
    {"plant.domain", Type::word, no, no, optional, {"continuous", "discrete"}},
    {"plant.sample_time", Type::positive, no, no, required},
    {"plant.A", Type::matrix, nx, nx, required},
    {"plant.B", Type::matrix, nx, nu},
    {"plant.C", Type::matrix, ny, nx},
    {"plant.D", Type::matrix, ny, nu},
    {"plant.G", Type::matrix, nx, nw},
    {"plant.H", Type::matrix, ny, nw},
    {"plant.delay", Type::not_negative},
    {"plant.states", Type::signals, nx},
    {"plant.inputs", Type::signals, nu},
    {"plant.outputs", Type::signals, ny},

    {"lqr", Type::table},
    {"lqr.Q", Type::weight, nx, nx},
    {"lqr.Q_output", Type::weight, ny, ny},
    {"lqr.R", Type::weight, nu, nu},
    {"lqr.N", Type::matrix, nx, nu},
    {"lqr.bryson", Type::table},
    {"lqr.bryson.states", Type::positives, nx},
    {"lqr.bryson.outputs", Type::positives, ny},
    {"lqr.bryson.inputs", Type::positives, nu, no, required},
    {"lqr.bryson.rho", Type::positive},
    {"lqr.cost", Type::word, no, no, optional, {"sampled", "discrete", "continuous"}},
    {"lqr.decay", Type::not_negative},
    {"lqr.settling_time", Type::positive},
    {"lqr.horizon", Type::steps},
    {"lqr.Q_final", Type::weight, nx, nx},
    {"lqr.structure", Type::mask, nu, nx},
    {"lqr.integral", Type::table},
    {"lqr.integral.outputs", Type::indices, ny, no, required},
    {"lqr.integral.Q", Type::weight, integrals, integrals, required},
    {"lqr.track", Type::indices, ny},
    {"lqr.anti_windup", Type::word, no, no, optional, {"model", "conditioning"}},
    {"lqr.input_rate", Type::weight, nu, nu},

    {"kalman", Type::table},
    {"kalman.process_noise", Type::weight, nw, nw, required},
    {"kalman.measurement_noise", Type::weight, ny, ny, required},
    {"kalman.cross_noise", Type::matrix, nw, ny},
    {"kalman.noise", Type::word, no, no, optional, {"discrete", "continuous"}},
    {"kalman.gain", Type::word, no, no, optional, {"steady", "schedule", "online"}},
    {"kalman.form", Type::word, no, no, optional, {"filter", "predictor"}},
    {"kalman.covariance", Type::word, no, no, optional, {"ud", "plain"}},
    {"kalman.initial_state", Type::vector, nx},
    {"kalman.initial_covariance", Type::weight, nx, nx},
    {"kalman.process_correlation_time", Type::positives, nw},
    {"kalman.measurement_correlation_time", Type::positives, ny},
    {"kalman.horizon", Type::steps},
    {"kalman.structure", Type::mask, nx, ny},
    {"kalman.gate", Type::not_negative},
    {"kalman.spike", Type::threshold},
    {"kalman.output_min", Type::bounds, ny},
    {"kalman.output_max", Type::bounds, ny},

    {"observer", Type::table},
    {"observer.poles", Type::poles},
    {"observer.continuous_poles", Type::poles},
    {"observer.form", Type::word, no, no, optional, {"predictor", "filter"}},

    {"pole_placement", Type::table},
    {"pole_placement.poles", Type::poles},
    {"pole_placement.continuous_poles", Type::poles},

    {"limits", Type::table},
    {"limits.u_min", Type::bounds, nu},
    {"limits.u_max", Type::bounds, nu},
    {"limits.u_rate", Type::bounds, nu},

    {"stage", Type::tables},
    {"stage.from", Type::step, no, no, required},
    {"stage.A", Type::matrix, nx, nx},
    {"stage.B", Type::matrix, nx, nu},
    {"stage.C", Type::matrix, ny, nx},
    {"stage.D", Type::matrix, ny, nu},
    {"stage.G", Type::matrix, nx, nw},
    {"stage.Q", Type::weight, nx, nx},
    {"stage.R", Type::weight, nu, nu},
    {"stage.N", Type::matrix, nx, nu},
    {"stage.process_noise", Type::weight, nw, nw},
    {"stage.measurement_noise", Type::weight, ny, ny},

    {"require", Type::table},
    {"require.gain_margin_dB", Type::positive},
    {"require.phase_margin_deg", Type::positive},
    {"require.disk_margin", Type::positive},
    {"require.max_pole", Type::positive},

    {"code", Type::table},
    {"code.real", Type::word, no, no, optional, {"float", "double"}},
    {"code.arithmetic", Type::word, no, no, optional, {"plain", "fused"}},
    {"code.style", Type::word, no, no, optional, {"auto", "unrolled", "compact"}},
    {"code.realisation", Type::word, no, no, optional, {"physical", "folded", "modal", "cheapest"}},
    {"code.flash", Type::whole},
};

std::string name_of(const std::string& path) {
  const std::size_t dot = path.rfind('.');
  return dot == path.npos ? path : path.substr(dot + 1);
}

// Insertions, deletions, exchanges of one letter and swaps of two neighbours that turn a into b.
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::vector<std::size_t>> cost(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) {
    for (std::size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        cost[i][j] = i + j;
        continue;
      }
      const bool same = a[i - 1] == b[j - 1];
      cost[i][j] = std::min({cost[i - 1][j] + 1, cost[i][j - 1] + 1, cost[i - 1][j - 1] + (same ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        cost[i][j] = std::min(cost[i][j], cost[i - 2][j - 2] + 1);
    }
  }
  return cost[a.size()][b.size()];
}

// How far apart two names of this length may be and still be meant alike.
std::size_t near_distance(std::size_t length) {
  return length <= 2 ? 0 : length <= 4 ? 1 : length <= 8 ? 2 : 3;
}

constexpr std::size_t longest_word = 32;

// The key of the table `parent` that is nearest to `name` in spelling, capitals aside; nullptr if none is
// near.
const KeyRule* nearest(const std::string& parent, const std::string& name) {
  const KeyRule* best = nullptr;
  std::size_t best_distance = 0;
  for (const KeyRule& rule : rules) {
    if (parent_of(rule.path) != parent || name.size() > longest_word) continue;
    const std::string known = in_lower_case(name_of(rule.path));
    const std::size_t distance = edit_distance(in_lower_case(name), known);
    if (distance > near_distance(std::max(known.size(), name.size()))) continue;
    if (best == nullptr || distance < best_distance) best = &rule, best_distance = distance;
  }
  return best;
}

// The same name in another table.
const KeyRule* elsewhere(const std::string& name) {
  for (const KeyRule& rule : rules)
    if (name_of(rule.path) == name) return &rule;
  return nullptr;
}

std::string home_of(const KeyRule& rule) {
  const std::string table = parent_of(rule.path);
  if (!table.empty()) return "belongs to [" + table + "]";
  const bool plain = rule.type == Type::identifier || rule.type == Type::line;
  return plain ? "belongs at the top, before the first table" : "is a table of its own";
}

}  // namespace

std::string nearest_word(const std::vector<std::string>& words, const std::string& name) {
  std::string best;
  std::size_t best_distance = 0;
  for (const std::string& word : words) {
    if (name.size() > longest_word) continue;
    const std::size_t distance = edit_distance(in_lower_case(name), in_lower_case(word));
    if (distance > near_distance(std::max(word.size(), name.size()))) continue;
    if (best.empty() || distance < best_distance) best = word, best_distance = distance;
  }
  return best;
}

const std::vector<KeyRule>& key_rules() { return rules; }

std::string rule_path(const std::string& path) {
  std::string out;
  bool inside = false;
  for (const char c : path) {
    inside = inside || c == '[';
    if (!inside) out += c;
    inside = inside && c != ']';
  }
  return out;
}

const KeyRule* find_rule(const std::string& path) {
  for (const KeyRule& rule : rules)
    if (rule.path == path) return &rule;
  return nullptr;
}

std::string parent_of(const std::string& path) {
  const std::size_t dot = path.rfind('.');
  return dot == path.npos ? "" : path.substr(0, dot);
}

Suggestion suggest(const std::string& parent, const std::string& name) {
  const ForeignWord foreign = foreign_word(parent, name);
  if (!foreign.sentence.empty()) return {"", "unknown key, " + foreign.sentence};
  if (!foreign.path.empty()) {
    const std::string home = parent_of(foreign.path);
    return {foreign.path, "unknown key, did you mean `" + name_of(foreign.path) + "`" + (home == parent ? "" : " in [" + home + "]") + "?"};
  }
  const KeyRule* near = nearest(parent, name);
  const KeyRule* other = elsewhere(name);
  if (near != nullptr && (other == nullptr || in_lower_case(name_of(near->path)) == in_lower_case(name)))
    return {near->path, "unknown key, did you mean `" + name_of(near->path) + "`?"};
  if (other == nullptr) return {"", "unknown key"};
  return {other->path, "unknown key here; `" + name + "` " + home_of(*other)};
}

}  // namespace lqg::input
