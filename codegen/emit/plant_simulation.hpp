// The sampled plant with its noise, for the loops that the reference vectors are taken from.
#pragma once

#include <cstdint>

#include "emit/controller.hpp"

namespace lqg::emit {

// Noise that is the same on every host: no function of libm, no library's generator.
class Noise {
 public:
  explicit Noise(std::uint64_t seed) : state_(seed) {}
  double uniform();  // in (−1/2, 1/2)
  double normal();   // mean 0, variance 1: the sum of twelve uniform ones

 private:
  std::uint64_t state_;
};

class PlantSimulation {
 public:
  PlantSimulation(const Controller& controller, std::uint64_t seed);

  // y = C x + D u + v with the u that acts while the outputs are sampled; draws the noises of this sample.
  step::Vector<double> measure(const step::Vector<double>& u);
  // x ← A x + B u + G w
  void advance(const step::Vector<double>& u);
  const step::Vector<double>& state() const { return x_; }

 private:
  struct Stage {
    step::Matrix<double> A, B, C, D, factor;  // factor: square root of the joint covariance of G w and v
  };
  const Stage& stage() const;

  Noise noise_;
  std::vector<std::size_t> starts_;  // of the stages
  std::vector<Stage> stages_;
  std::size_t sample_ = 0;
  step::Vector<double> x_, drawn_;
};

}  // namespace lqg::emit
