// SPDX-License-Identifier: MIT
// Prints a design file by chance, of 1 to 6 states, for random.sh: random_design SEED.
#include <cstdlib>
#include <iostream>

#include <unity.h>

#include "../codegen/emit/design_text.hpp"

using namespace lqg_test;

namespace {

// One more key of a table, at its beginning.
void add_key(std::string& text, const std::string& table, const std::string& line) {
  const std::size_t at = text.find(table);
  if (at != std::string::npos) text.insert(at + table.size(), line);
}

std::string random_text(Random& random) {
  DesignText design = random_design(random, random.between(1, 6));
  if (random.one_in(4)) design.Q.resize(0, 0);
  const bool is_form = random.one_in(5);
  if (is_form) design.u_min = design.u_max = Eigen::VectorXd();
  if (is_form || random.one_in(4))
    design.gain = "steady", design.covariance.clear();
  else if (random.one_in(4))
    design.gain = "schedule", design.covariance.clear();
  std::string text = toml(design);
  if (is_form) return text + "realisation = \"" + (random.one_in(2) ? "folded" : "modal") + "\"\n";
  if (random.one_in(3)) add_key(text, "[kalman]\n", "gate = 4\n");
  if (random.one_in(3))
    add_key(text, "[lqr]\n", "integral = { outputs = [0], Q = [0.1] }\n");
  else if (random.one_in(4))
    add_key(text, "[lqr]\n", "track = [0]\n");
  if (random.one_in(4)) add_key(text, "[plant]\n", "delay = " + std::to_string(design.sample_time) + "\n");
  if (random.one_in(3)) add_key(text, "[limits]\n", "u_rate = 3\n");
  return text;
}

}  // namespace

void setUp() {}
void tearDown() {}

int main(int, char** argv) {
  Random random(std::strtoull(argv[1], nullptr, 10));
  std::cout << random_text(random);
}
