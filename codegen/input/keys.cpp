// SPDX-License-Identifier: MIT
#include "input/keys.hpp"

#include <algorithm>
#include <cstddef>

#include "input/foreign_words.hpp"
#include "input/text.hpp"

namespace lqg::input {
namespace {

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
std::size_t near_distance(std::size_t length) { return length <= 2 ? 0 : length <= 4 ? 1 : length <= 8 ? 2 : 3; }

constexpr std::size_t longest_word = 32;

// The key of the table `parent` that is nearest to `name` in spelling, capitals aside; nullptr if none is near.
const KeyRule* nearest(const std::string& parent, const std::string& name) {
  const KeyRule* best = nullptr;
  std::size_t best_distance = 0;
  for (const KeyRule& rule : key_rules()) {
    if (parent_of(rule.path) != parent || name.size() > longest_word) continue;
    const std::string known = in_lower_case(name_of(rule.path));
    const std::size_t distance = edit_distance(in_lower_case(name), known);
    if (distance > near_distance(std::max(known.size(), name.size()))) continue;
    if (best == nullptr || distance < best_distance) best = &rule, best_distance = distance;
  }
  return best;
}

bool is_of_many_tables(const KeyRule& rule) {
  const KeyRule* table = find_rule(parent_of(rule.path));
  return table != nullptr && table->type == Type::tables;
}

// The same name in another table; those of which there may be many have names that belong to no one table.
const KeyRule* elsewhere(const std::string& name) {
  for (const KeyRule& rule : key_rules())
    if (name_of(rule.path) == name && !is_of_many_tables(rule)) return &rule;
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

std::string path_of(const std::string& parent, const std::string& name) {
  constexpr std::size_t longest = 60;
  const bool is_bare = !name.empty() && std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  });
  const std::string segment = is_bare && name.size() <= longest ? name : in_quotes(name);
  return parent.empty() ? segment : parent + "." + segment;
}

const KeyRule* find_rule(const std::string& path) {
  for (const KeyRule& rule : key_rules())
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
    const std::string where = home == parent ? "" : " in [" + home + "]";
    return {foreign.path, "unknown key, did you mean `" + name_of(foreign.path) + "`" + where + "?"};
  }
  const KeyRule* near = nearest(parent, name);
  const KeyRule* other = elsewhere(name);
  if (near != nullptr && (other == nullptr || in_lower_case(name_of(near->path)) == in_lower_case(name)))
    return {near->path, "unknown key, did you mean `" + name_of(near->path) + "`?"};
  if (other == nullptr) return {"", "unknown key"};
  return {other->path, "unknown key here; `" + name + "` " + home_of(*other)};
}

}  // namespace lqg::input
