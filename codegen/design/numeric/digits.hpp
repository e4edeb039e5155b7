// SPDX-License-Identifier: MIT
// How many digits the design computes with, at present.
#pragma once

#include "design/real.hpp"

namespace lqg::design {

// Every Real made during its life has `digits` decimal digits; the digits before come back at its end.
class Digits {
 public:
  explicit Digits(unsigned digits) : before_(Real::default_precision()) { Real::default_precision(digits); }
  ~Digits() { Real::default_precision(before_); }
  Digits(const Digits&) = delete;
  Digits& operator=(const Digits&) = delete;

 private:
  unsigned before_;
};

}  // namespace lqg::design
