// SPDX-License-Identifier: MIT
// The keys of a design file, one row each. The reader of files checks by this table, and the reference, the schema and
// the manual page are made from it.
#pragma once

#include <string>
#include <vector>

namespace lqg::input {

enum class Type {
  table,       // its keys have rows of their own
  tables,      // an array of such tables: [[stage]]
  identifier,  // the design's name
  line,        // text of one line
  word,        // one of `words`
  positive,    // a number > 0
  not_negative,
  real,       // a finite number
  flag,       // true or false
  threshold,  // a number > 0, or inf
  amount,     // a number ≥ 0, or one of `words`
  whole,      // a whole number ≥ 1
  steps,      // a number of samples that have gains of their own, 0 to most_steps
  step,       // the number of such a sample, ≥ 1
  matrix,     // an array of rows
  weight,     // a square symmetric matrix, or the array of its diagonal
  mask,       // a matrix of 0 and 1
  vector,     // an array of numbers
  positives,  // the same, all > 0
  bounds,     // the same, infinite ones too
  counts,     // an array of whole numbers ≥ 1
  ranges,     // a table: of names of the signals that `rows` counts each a largest size, or [low, high]
  prices,     // a number > 0, or a table: of names of states, inputs and outputs each such a number
  indices,    // an array of different whole numbers from 0 to below `rows`
  walks,      // some of the signals that `rows` counts, as indices, or a table of a size > 0 of each
  signal,     // one of the signals that `rows` counts: its name, or its number from 0
  entry,      // the same of a row or column whose signals another key tells
  poles,      // an array of numbers and of [re, im], conjugates in pairs
  formulas,   // an array of formulas in quotes, one for each of `rows`
  point,      // an array of numbers, formulas, "?" and "? start"
  states,     // an array of names of states
  signals,    // an array of "name [unit]"
  parameters  // a table: of names each a number, a formula, or { value, unit }
};

// The dimensions that shapes are given in: states, inputs, outputs, process noises, integrated outputs.
enum class Size { none, nx, nu, ny, nw, integrals };

enum class Need { optional, required };  // of a table's key: required where the table is there

struct KeyRule {
  std::string path;  // "lqr.Q"
  Type type;
  Size rows = Size::none;
  Size columns = Size::none;
  Need need = Need::optional;
  std::vector<std::string> words = {};  // the first is the default, unless `otherwise` says more
  std::string text = {};                // one to three sentences: what it is, its unit; `…` around what is typed
  std::string otherwise = {};           // what holds without the key
  std::string more = {};                // where more of it is said: a link of a page in codegen/
};

// Of these keys of a table only one may be there; where `need` is required, one has to be.
struct Alternatives {
  std::string table;
  std::vector<std::string> keys;
  Need need;
};

const std::vector<KeyRule>& key_rules();
const std::vector<Alternatives>& alternatives();

// "stage.A" of "stage[3].A": tables of one array share their rows.
std::string rule_path(const std::string& path);

// "lqr.Q" of the key "Q" in "lqr"; in quotes, and cut, what is no bare key.
std::string path_of(const std::string& parent, const std::string& name);

// nullptr for a path that is not on the page.
const KeyRule* find_rule(const std::string& path);

// "lqr" of "lqr.Q", "" of "lqr".
std::string parent_of(const std::string& path);

// What the writer of an unknown key may have meant.
struct Suggestion {
  std::string path;     // of a known key; empty: no idea
  std::string message;  // "unknown key, did you mean `sample_time`?"
};

// The one of `words` that is nearest to `name` in spelling, capitals aside; "" if none is near.
std::string nearest_word(const std::vector<std::string>& words, const std::string& name);

// For the key `name`, unknown in the table `parent` ("" is the top).
Suggestion suggest(const std::string& parent, const std::string& name);

}  // namespace lqg::input
