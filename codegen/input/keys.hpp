// The keys of a design file, one row each: the page of the contract as a table.
#pragma once

#include <string>
#include <vector>

namespace lqg::input {

enum class Type {
  table,       // its keys have rows of their own
  identifier,  // the design's name
  line,        // text of one line
  word,        // one of `words`
  positive,    // a number > 0
  whole,       // a whole number ≥ 1
  matrix,      // an array of rows
  weight,      // a square symmetric matrix, or the array of its diagonal
  vector,      // an array of numbers
  bounds,      // the same, infinite ones too
  signals,     // an array of "name [unit]"
  later        // on the page, not in the program yet
};

// The dimensions that shapes are given in: states, inputs, outputs, process noises.
enum class Size { none, nx, nu, ny, nw };

enum class Need { optional, required };  // of a table's key: required where the table is there

struct KeyRule {
  std::string path;  // "lqr.Q"
  Type type = Type::later;
  Size rows = Size::none;
  Size columns = Size::none;
  Need need = Need::optional;
  std::vector<std::string> words = {};        // the first is the default, unless the domain decides
  std::vector<std::string> later_words = {};  // on the page, not in the program yet
};

const std::vector<KeyRule>& key_rules();

// nullptr for a path that is not on the page.
const KeyRule* find_rule(const std::string& path);

// "lqr" of "lqr.Q", "" of "lqr".
std::string parent_of(const std::string& path);

// What the writer of an unknown key may have meant.
struct Suggestion {
  std::string path;     // of a known key; empty: no idea
  std::string message;  // "unknown key, did you mean `sample_time`?"
};

// For the key `name`, unknown in the table `parent` ("" is the top).
Suggestion suggest(const std::string& parent, const std::string& name);

}  // namespace lqg::input
