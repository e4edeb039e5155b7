// What the runs of the reference share: scalars in and out, the hash of all bits, errors and tolerances.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

#include "design/rounding.hpp"
#include "emit/vectors.hpp"
#include "step/model.hpp"

namespace lqg::emit {

constexpr std::size_t sample_count = 200;
constexpr std::uint64_t seed = 20260101;
constexpr unsigned reference_digits = 40;  // of the reference of a controller in double

inline double as_double(double value) { return value; }
inline double as_double(float value) { return static_cast<double>(value); }
inline double as_double(const design::Real& value) { return design::to_double(value); }
template <class T>
double as_double(step::Fused<T> value) { return static_cast<double>(value.value); }

inline double to_target(double value, bool is_double) {
  return is_double ? value : static_cast<double>(static_cast<float>(value));
}

template <class S>
step::Vector<S> vector_of(const std::vector<double>& values) {
  step::Vector<S> out(static_cast<Eigen::Index>(values.size()));
  for (Eigen::Index i = 0; i < out.size(); ++i) out(i) = S(values[static_cast<std::size_t>(i)]);
  return out;
}

template <class S>
std::vector<double> doubles(const step::Vector<S>& values) {
  std::vector<double> out;
  for (Eigen::Index i = 0; i < values.size(); ++i) out.push_back(as_double(values(i)));
  return out;
}

class Hash {
 public:
  explicit Hash(bool is_double) : is_double_(is_double) {}
  void add(double value) {
    value += 0.0;  // the sign of a zero does not count
    if (is_double_) {
      std::uint64_t bits;
      std::memcpy(&bits, &value, sizeof bits);
      add_bits(bits, 8);
    } else {
      const float number = static_cast<float>(value);
      std::uint32_t bits;
      std::memcpy(&bits, &number, sizeof bits);
      add_bits(bits, 4);
    }
  }
  std::uint32_t value() const { return hash_; }

 private:
  void add_bits(std::uint64_t bits, int bytes) {
    for (int i = 0; i < bytes; ++i) hash_ = (hash_ ^ static_cast<std::uint32_t>(bits >> (8 * i) & 0xff)) * 16777619u;
  }
  bool is_double_;
  std::uint32_t hash_ = 2166136261u;
};

inline void widen(std::vector<double>& errors, const std::vector<double>& found, const std::vector<double>& reference) {
  errors.resize(found.size(), 0);
  for (std::size_t i = 0; i < found.size(); ++i) errors[i] = std::max(errors[i], std::abs(found[i] - reference[i]));
}

// A result that came out exactly by luck may still be a rounding off: at least one ulp of the largest value counts.
inline void finish(std::vector<double>& errors, const std::vector<double>& largest, bool is_double) {
  const double unit = is_double ? std::numeric_limits<double>::epsilon()
                                : static_cast<double>(std::numeric_limits<float>::epsilon());
  for (std::size_t i = 0; i < errors.size(); ++i)
    errors[i] = Tolerances::margin * std::max(errors[i], unit * largest[i]);
}

}  // namespace lqg::emit
