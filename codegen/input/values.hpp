// SPDX-License-Identifier: MIT
// From the tree of a TOML text to the values of the known keys, each of the right type and shape.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "design/exact_matrix.hpp"
#include "design/linearise.hpp"
#include "design/problem.hpp"
#include "input/document.hpp"
#include "input/keys.hpp"
#include "input/report.hpp"

namespace lqg::input {

// Each map holds what could be read, by its key: "lqr.Q", "stage[0].Q". Vectors are n × 1, weights given as a diagonal
// are full matrices.
struct Values {
  std::map<std::string, design::ExactMatrix> matrices;
  std::map<std::string, std::string> texts;
  std::map<std::string, double> numbers;
  std::map<std::string, std::vector<design::Signal>> signals;
  std::map<std::string, std::vector<int>> indices;                 // and counts
  std::map<std::string, std::map<std::string, double>> named;      // prices by name
  std::map<std::string, std::vector<std::complex<double>>> poles;  // conjugates side by side, +j first
  std::shared_ptr<const design::Equations> equations;
  std::optional<design::Linearisation> linearisation;
  std::map<Size, int> sizes;      // 0: there are none; −1: not known, because what tells them is wrong
  std::set<std::string> present;  // keys in the file, right or wrong, and those that an unknown key seems to mean
  std::set<std::string> tables;   // those of them that are tables, and "", the file's top
  std::map<std::string, std::vector<std::string>>
      instances;  // the same by their rules: "stage": "stage[0]", "stage[1]"

  bool has(const std::string& key) const { return present.count(key) != 0; }
  const design::ExactMatrix* matrix(const std::string& key) const;  // nullptr: absent or wrong
  std::string text(const std::string& key) const;                   // "": absent or wrong
  double number(const std::string& key, double absent) const;
  bool has_inputs() const;                                                     // by what the file has of the plant
  bool has_outputs() const;                                                    // likewise
  std::vector<std::string> tables_of(const std::string& key) const;            // "stage[0]", "stage[1]", …
  const std::vector<std::string>& tables_like(const std::string& rule) const;  // of a rule's path: all there are
};

// Reads all that can be read and reports all that is wrong with single keys. Those of `wrong` are left out: what is
// wrong with them has been said.
Values read_values(const Node& document, const std::set<std::string>& wrong, Report& report);

// Of the states, inputs or outputs: as the file has them, else "x0", "x1", …
std::vector<std::string> signal_names(const Values& values, Size size);

// "3 rows", "1 row".
std::string counted(long count, const std::string& noun);

// The shortest decimal that reads back as `number`; with `digits`, that many significant ones.
std::string shown(double number);
std::string shown(double number, int digits);
// The same of a number of the file, with so many digits that it is not taken for its double where it is none.
std::string shown(const Node& number);

}  // namespace lqg::input
