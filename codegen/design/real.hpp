// The scalar of the design: as many decimal digits as asked for, at run time (MPFR).
#pragma once

#include <Eigen/Core>
#include <boost/multiprecision/eigen.hpp>
#include <boost/multiprecision/mpfr.hpp>

namespace lqg::design {

using Real = boost::multiprecision::number<boost::multiprecision::mpfr_float_backend<0>,
                                           boost::multiprecision::et_off>;
using RealMatrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;
using RealVector = Eigen::Matrix<Real, Eigen::Dynamic, 1>;

// Every Real made during its life has `digits` decimal digits; the digits before come back at its end.
class Digits {
 public:
  explicit Digits(unsigned digits) : before_(Real::default_precision()) {
    Real::default_precision(digits);
  }
  ~Digits() { Real::default_precision(before_); }
  Digits(const Digits&) = delete;
  Digits& operator=(const Digits&) = delete;

 private:
  unsigned before_;
};

}  // namespace lqg::design
