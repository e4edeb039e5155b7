// SPDX-License-Identifier: MIT
// The scalar of this variant of the library, and the way of its numbers in and out of the templates.
#pragma once

#include <vector>

#include "lqg/lqg.h"
#include "random_model.hpp"

namespace lqg_test {

#ifdef LQG_FUSED
using S = Fused<lqg_real>;
#else
using S = lqg_real;
#endif

using Numbers = std::vector<lqg_real>;

inline lqg_real number(const S& value) { return static_cast<lqg_real>(to_double(value)); }

// Row by row; of a vector its entries.
template <class Values>
Numbers row_major(const Values& values) {
  Numbers out;
  for (int i = 0; i < values.rows(); ++i)
    for (int j = 0; j < values.cols(); ++j) out.push_back(number(values(i, j)));
  return out;
}

// NULL for none.
inline const lqg_real* pointer(const Numbers& numbers) { return numbers.empty() ? nullptr : numbers.data(); }
inline lqg_real* pointer(Numbers& numbers) { return numbers.empty() ? nullptr : numbers.data(); }

}  // namespace lqg_test
