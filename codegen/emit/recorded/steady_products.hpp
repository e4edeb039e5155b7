// SPDX-License-Identifier: MIT
// The steps of a filter with a constant gain, recorded without the products of its dense matrices: loops over tables
// have added these before.
#pragma once

#include "emit/recorded/traced.hpp"

namespace lqg::emit {

// One sum for each row: sums += matrix vector.
struct Product {
  const char* name;           // of the table in C: "MINUS_C"
  const char* meaning;        // "−C"
  design::RealMatrix matrix;  // empty: the product is left to the straight-line code
};

// What is mostly not zero. Subtracting C x̂ is adding −C x̂, to the last bit.
struct SteadyProducts {
  Product C, L, K, A, B;
};
SteadyProducts steady_products(const Controller& controller);
inline bool is_in_loop(const Product& product) { return product.matrix.size() > 0; }

// The filter has this form: constant gains and laws, one plant, and a product that is worth a loop.
bool can_loop_products(const Controller& controller);

// Rows of `product` that are added at a time, block after block.
std::vector<int> heights_of_blocks(const Product& product);

// One row: the entries of the matrix in the order in which the loops read them. In each block column after column.
design::RealMatrix in_blocks(const Product& product);

// innovation[] of y[], 0 of an output that is not used. With C in a loop innovation[] begins as y − C x̂.
TracedFunction trace_innovate(const Controller& controller, const SteadyProducts& products);

// x̂ is within its bounds; with L in straight lines x̂ ← x̂ + L innovation[] before.
TracedFunction trace_end_of_steady_update(const Controller& controller, const SteadyProducts& products);

// u[], with K in a loop of sums[], which are the law's so far as x̂.
TracedFunction trace_law(const Controller& controller, const SteadyProducts& products);

// x̂ ← A x̂ + B u, with A in a loop of sums[], which are A x̂, or with B, too, A x̂ + B u.
TracedFunction trace_steady_predict(const Controller& controller, const SteadyProducts& products);

}  // namespace lqg::emit
