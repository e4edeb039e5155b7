#include "input/keys.hpp"

#include <algorithm>
#include <cstddef>

namespace lqg::input {
namespace {

constexpr auto no = Size::none;
constexpr auto nx = Size::nx;
constexpr auto nu = Size::nu;
constexpr auto ny = Size::ny;
constexpr auto nw = Size::nw;
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
    {"plant.H"},
    {"plant.delay"},
    {"plant.states", Type::signals, nx},
    {"plant.inputs", Type::signals, nu},
    {"plant.outputs", Type::signals, ny},

    {"lqr", Type::table},
    {"lqr.Q", Type::weight, nx, nx, required},
    {"lqr.R", Type::weight, nu, nu, required},
    {"lqr.N", Type::matrix, nx, nu},
    {"lqr.cost", Type::word, no, no, optional, {"sampled", "discrete", "continuous"}},
    {"lqr.Q_output"},
    {"lqr.bryson"}, {"lqr.bryson.states"}, {"lqr.bryson.outputs"}, {"lqr.bryson.inputs"}, {"lqr.bryson.rho"},
    {"lqr.decay"},
    {"lqr.settling_time"},
    {"lqr.horizon"},
    {"lqr.Q_final"},
    {"lqr.structure"},
    {"lqr.integral"}, {"lqr.integral.outputs"}, {"lqr.integral.Q"},
    {"lqr.track"},
    {"lqr.input_rate"},

    {"kalman", Type::table},
    {"kalman.process_noise", Type::weight, nw, nw, required},
    {"kalman.measurement_noise", Type::weight, ny, ny, required},
    {"kalman.cross_noise", Type::matrix, nw, ny},
    {"kalman.noise", Type::word, no, no, optional, {"discrete", "continuous"}},
    {"kalman.gain", Type::word, no, no, optional, {"steady", "online"}, {"schedule"}},
    {"kalman.form", Type::word, no, no, optional, {"filter", "predictor"}},
    {"kalman.covariance", Type::word, no, no, optional, {"ud", "plain"}},
    {"kalman.initial_state", Type::vector, nx},
    {"kalman.initial_covariance", Type::weight, nx, nx},
    {"kalman.process_correlation_time"},
    {"kalman.measurement_correlation_time"},
    {"kalman.horizon"},
    {"kalman.structure"},
    {"kalman.gate"},

    {"limits", Type::table},
    {"limits.u_min", Type::bounds, nu},
    {"limits.u_max", Type::bounds, nu},
    {"limits.u_rate"},

    {"code", Type::table},
    {"code.real", Type::word, no, no, optional, {"float", "double"}},
    {"code.arithmetic", Type::word, no, no, optional, {"plain", "fused"}},
    {"code.style", Type::word, no, no, optional, {"auto", "unrolled", "compact"}},
    {"code.flash", Type::whole},

    {"observer"}, {"observer.poles"}, {"observer.continuous_poles"}, {"observer.form"},
    {"pole_placement"}, {"pole_placement.poles"}, {"pole_placement.continuous_poles"},
    {"stage"}, {"stage.from"}, {"stage.A"}, {"stage.B"}, {"stage.C"}, {"stage.D"}, {"stage.G"}, {"stage.Q"},
    {"stage.R"}, {"stage.N"}, {"stage.process_noise"}, {"stage.measurement_noise"},
    {"require"}, {"require.gain_margin_dB"}, {"require.phase_margin_deg"}, {"require.disk_margin"},
    {"require.max_pole"},
};

std::string name_of(const std::string& path) {
  const std::size_t dot = path.rfind('.');
  return dot == path.npos ? path : path.substr(dot + 1);
}

std::string lower_case(std::string text) {
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return text;
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

constexpr std::size_t longest_name = 32;

// The key of the table `parent` that is nearest to `name` in spelling, capitals aside; nullptr if none is
// near.
const KeyRule* nearest(const std::string& parent, const std::string& name) {
  const KeyRule* best = nullptr;
  std::size_t best_distance = 0;
  for (const KeyRule& rule : rules) {
    if (parent_of(rule.path) != parent || name.size() > longest_name) continue;
    const std::string known = lower_case(name_of(rule.path));
    const std::size_t distance = edit_distance(lower_case(name), known);
    if (distance > near_distance(std::max(known.size(), name.size()))) continue;
    if (best == nullptr || distance < best_distance) best = &rule, best_distance = distance;
  }
  return best;
}

// The same name in another table; one that works already rather than one that comes later.
const KeyRule* elsewhere(const std::string& name) {
  const KeyRule* found = nullptr;
  for (const KeyRule& rule : rules)
    if (name_of(rule.path) == name &&
        (found == nullptr || (found->type == Type::later && rule.type != Type::later)))
      found = &rule;
  return found;
}

std::string home_of(const KeyRule& rule) {
  const std::string table = parent_of(rule.path);
  if (!table.empty()) return "belongs to [" + table + "]";
  const bool plain = rule.type == Type::identifier || rule.type == Type::line;
  return plain ? "belongs at the top, before the first table" : "is a table of its own";
}

}  // namespace

const std::vector<KeyRule>& key_rules() { return rules; }

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
  const KeyRule* near = nearest(parent, name);
  const KeyRule* other = elsewhere(name);
  if (near != nullptr && (other == nullptr || lower_case(name_of(near->path)) == lower_case(name)))
    return {near->path, "unknown key, did you mean `" + name_of(near->path) + "`?"};
  if (other == nullptr) return {"", "unknown key"};
  return {other->path, "unknown key here; `" + name + "` " + home_of(*other)};
}

}  // namespace lqg::input
