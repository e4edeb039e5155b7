// SPDX-License-Identifier: MIT
// CPU seconds of whole designs: `bench_design [states …]`, 12 and 50 when none are given.
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <vector>

#include "problems.hpp"

using namespace design_test;

int main(int count, char** arguments) {
  std::vector<int> sizes;
  for (int i = 1; i < count; ++i) sizes.push_back(std::atoi(arguments[i]));
  if (sizes.empty()) sizes = {12, 50};
  for (const int states : sizes) {
    const std::clock_t start = std::clock();
    lqg::design::Findings findings;
    const auto solution = lqg::design::solve(chain_of_masses(states / 2), findings);
    const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    if (!solution) return 1;
    std::printf("%d states: %.3f s, %u digits\n", states, seconds, solution->numerics.digits);
  }
  return 0;
}
