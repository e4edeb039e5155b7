// SPDX-License-Identifier: MIT
#include "view/differences.hpp"

#include <algorithm>
#include <cstdio>
#include <map>
#include <set>
#include <variant>

#include "input/document.hpp"
#include "input/edit.hpp"

namespace lqg::view {

namespace {

using input::Kind;
using input::Node;

constexpr std::size_t most_entries = 12;  // of one array, line by line
const char* const absent = "–";

struct Leaf {
  std::string written;  // for people
  std::string meaning;  // for the comparison
};

struct Leaves {
  std::vector<std::string> order;
  std::map<std::string, Leaf> by_key;
};

Leaf leaf_of(const Node& node, const std::string& text) {
  if (node.kind == Kind::text) return {"\"" + node.text + "\"", "t" + node.text};
  const std::string word = input::word_at(text, node.where);
  if (node.kind != Kind::number) return {word, "w" + word};
  char bits[64];
  std::snprintf(bits, sizeof bits, "n%a", node.number);
  return {word, bits};
}

void flatten(const Node& node, const std::string& key, const std::string& text, Leaves& leaves) {
  if (node.kind != Kind::array && node.kind != Kind::table) {
    leaves.order.push_back(key);
    leaves.by_key[key] = leaf_of(node, text);
  }
  for (std::size_t i = 0; i < node.items.size(); ++i)
    flatten(node.items[i],
            node.kind == Kind::array ? key + "[" + std::to_string(i) + "]"
                                     : key + (key.empty() ? "" : ".") + node.keys[i].name,
            text, leaves);
}

Leaves leaves_of(const std::string& text) {
  Leaves leaves;
  const auto document = input::parse_toml(text);
  if (const Node* const tree = std::get_if<Node>(&document)) flatten(*tree, "", text, leaves);
  return leaves;
}

// "lqr.Q" of "lqr.Q[1][1]"; "stage[0].A" of "stage[0].A[1][1]".
std::string array_of(const std::string& key) {
  std::size_t end = key.size();
  while (end > 0 && key[end - 1] == ']') end = key.rfind('[', end - 1);
  return key.substr(0, end);
}

std::vector<std::string> all_keys(const std::vector<Leaves>& files) {
  std::vector<std::string> keys;
  std::set<std::string> seen;
  for (const Leaves& file : files)
    for (const std::string& key : file.order)
      if (seen.insert(key).second) keys.push_back(key);
  return keys;
}

bool differs(const Leaves& a, const Leaves& b, const std::string& key) {
  const auto left = a.by_key.find(key), right = b.by_key.find(key);
  if (left == a.by_key.end() || right == b.by_key.end()) return (left == a.by_key.end()) != (right == b.by_key.end());
  return left->second.meaning != right->second.meaning;
}

Difference line_of(const std::string& key, const std::vector<Leaves>& files) {
  Difference line = {key, {}};
  for (const Leaves& file : files) {
    const auto found = file.by_key.find(key);
    line.values.push_back(found == file.by_key.end() ? absent : found->second.written);
  }
  return line;
}

Difference summary_of(const std::string& array, const std::vector<std::string>& keys,
                      const std::vector<Leaves>& files) {
  Difference line = {array, {}};
  for (const Leaves& file : files) {
    const auto count = std::count_if(keys.begin(), keys.end(),
                                     [&](const std::string& key) { return differs(files.front(), file, key); });
    line.values.push_back(&file == &files.front() ? "its numbers" : std::to_string(count) + " differ");
  }
  return line;
}

}  // namespace

std::vector<Difference> differences(const std::vector<std::string>& texts) {
  std::vector<Leaves> files;
  for (const std::string& text : texts) files.push_back(leaves_of(text));
  std::vector<std::string> arrays;  // or keys alone, in their order
  std::map<std::string, std::vector<std::string>> by_array;
  for (const std::string& key : all_keys(files)) {
    const auto is_other = [&](const Leaves& file) { return differs(files.front(), file, key); };
    if (std::none_of(files.begin(), files.end(), is_other)) continue;
    std::vector<std::string>& keys = by_array[array_of(key)];
    if (keys.empty()) arrays.push_back(array_of(key));
    keys.push_back(key);
  }
  std::vector<Difference> lines;
  for (const std::string& array : arrays) {
    const std::vector<std::string>& keys = by_array[array];
    if (keys.size() > most_entries)
      lines.push_back(summary_of(array, keys, files));
    else
      for (const std::string& key : keys) lines.push_back(line_of(key, files));
  }
  return lines;
}

}  // namespace lqg::view
