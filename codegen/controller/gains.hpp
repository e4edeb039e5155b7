// SPDX-License-Identifier: MIT
// The gains of a controller, sample by sample, and what a table of them has to hold.
#pragma once

#include "controller/controller.hpp"

namespace lqg::controller {

// {K, Nbar, H, H_input} and {L, M} as Controller keeps them: rows that the target cannot tell from the one that is held
// are cut off.
std::vector<Gains> law_gains(const Controller& controller);
std::vector<Gains> filter_gains(const Controller& controller);

// An entry of one of the matrices of a row.
struct Place {
  std::size_t matrix;
  int i, j;
};

// The entries that are not the same number of the target in all rows, matrix after matrix, row by row.
std::vector<Place> changing_places(const std::vector<Gains>& rows, bool is_double);

}  // namespace lqg::controller
