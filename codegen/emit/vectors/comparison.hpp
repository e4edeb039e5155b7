// SPDX-License-Identifier: MIT
// How the target's numbers are held against the reference: the hash of all bits, errors and tolerances.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

#include "emit/vectors/vectors.hpp"
#include "simulate/numbers.hpp"

namespace lqg::emit {

constexpr std::size_t sample_count = 200;
constexpr std::uint64_t seed = 20260101;
constexpr unsigned reference_digits = 40;  // of the reference of a controller in double

inline std::vector<double> list_of(const Eigen::VectorXd& values) {
  return {values.data(), values.data() + values.size()};
}

inline Eigen::VectorXd vector_of(const std::vector<double>& values) {
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

template <class S>
std::vector<double> list_of(const step::Vector<S>& values) {
  return list_of(simulate::as_doubles(values));
}

template <class S>
step::Vector<S> numbers_of(const std::vector<double>& values) {
  return simulate::numbers_of<S>(vector_of(values));
}

class Hash {
 public:
  explicit Hash(bool is_double) : is_double_(is_double) {}
  void add(double value) {
    value += 0.0;  // the sign of a zero does not count, nor which NaN it is
    if (is_double_) {
      std::uint64_t bits;
      std::memcpy(&bits, &value, sizeof bits);
      add_bits(value == value ? bits : 0x7ff8000000000000u, 8);
    } else {
      const float number = static_cast<float>(value);
      std::uint32_t bits;
      std::memcpy(&bits, &number, sizeof bits);
      add_bits(value == value ? bits : 0x7fc00000u, 4);
    }
  }
  template <class Values>
  void add_all(const Values& values) {
    for (Eigen::Index i = 0; i < static_cast<Eigen::Index>(values.size()); ++i)
      add(simulate::as_double(values[static_cast<std::size_t>(i)]));
  }
  void add_count(unsigned long count) { add_bits(count & 0xffffffffu, 4); }
  std::uint32_t value() const { return hash_; }

 private:
  void add_bits(std::uint64_t bits, int bytes) {
    for (int i = 0; i < bytes; ++i) hash_ = (hash_ ^ static_cast<std::uint32_t>(bits >> (8 * i) & 0xff)) * 16777619u;
  }
  bool is_double_;
  std::uint32_t hash_ = 2166136261u;
};

// The errors of one kind of result, entry by entry, over all samples.
class Errors {
 public:
  void add(const std::vector<double>& found, const std::vector<double>& reference) {
    errors_.resize(found.size(), 0);
    largest_.resize(found.size(), 0);
    for (std::size_t i = 0; i < found.size(); ++i) {
      errors_[i] = std::max(errors_[i], std::abs(found[i] - reference[i]));
      largest_[i] = std::max(largest_[i], std::abs(reference[i]));
    }
  }
  // A result that came out exactly by luck may still be a rounding off: at least one ulp of the largest value counts.
  std::vector<double> tolerances(bool is_double) const {
    const double unit =
        is_double ? std::numeric_limits<double>::epsilon() : static_cast<double>(std::numeric_limits<float>::epsilon());
    std::vector<double> out(errors_.size());
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = Tolerances::margin * std::max(errors_[i], unit * largest_[i]);
    return out;
  }

 private:
  std::vector<double> errors_, largest_;
};

}  // namespace lqg::emit
