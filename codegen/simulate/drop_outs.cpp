// SPDX-License-Identifier: MIT
#include "simulate/drop_outs.hpp"

#include <limits>

#include "controller/operating_point.hpp"
#include "simulate/emitted_controller.hpp"
#include "simulate/numbers.hpp"

namespace lqg::simulate {

namespace {

constexpr int samples_to_settle = 200;  // before a drop-out, and after it

// The covariance of the emitted filter: its estimate is held at 0, so that no output is ever left out for what it says.
template <class S>
class Covariance {
 public:
  explicit Covariance(const Controller& controller)
      : emitted_(controller, constants_of<S>(controller.target)), y_(Vector<S>::Constant(controller.size.ny, S(0))),
        no_y_(Vector<S>::Constant(controller.size.ny, S(std::numeric_limits<double>::quiet_NaN()))),
        u_(Vector<S>::Constant(controller.size.nu, S(0))) {}

  void hear(int samples) { run(samples, y_); }
  void drop_out(int samples) { run(samples, no_y_); }
  bool has_begun_anew() const { return emitted_.covariance_resets() > 0; }

 private:
  void run(int samples, const Vector<S>& y) {
    for (int k = 0; k < samples && !has_begun_anew(); ++k) {
      step::State<S>& state = emitted_.state();
      state.x.setConstant(S(0));
      state.u.setConstant(S(0));
      emitted_.update(y);
      emitted_.predict(u_);
    }
  }

  EmittedController<S> emitted_;
  Vector<S> y_, no_y_, u_;
};

// The drop-out after which P is no covariance; −1: none. One that ends beyond the bounds of P is not one: P begins anew
// while nothing is heard, whatever its form.
template <class S>
int drop_out_that_breaks(const Controller& controller) {
  Covariance<S> before(controller);
  before.hear(samples_to_settle);
  if (before.has_begun_anew()) return 0;
  for (const int samples : tried_drop_outs()) {
    Covariance<S> after = before;
    after.drop_out(samples);
    if (after.has_begun_anew()) return -1;
    after.hear(samples_to_settle);
    if (after.has_begun_anew()) return samples;
  }
  return -1;
}

}  // namespace

const std::vector<int>& tried_drop_outs() {
  static const std::vector<int> lengths = {1, 3, 10, 30, 100, 300, 1000};
  return lengths;
}

void check_drop_outs(const Controller& controller, design::Findings& findings) {
  // Held at one estimate an extended filter is not the one that will run.
  if (controller.filter != step::Filter::plain || controller::is_extended(controller)) return;
  const Controller at_zero = controller::without_point(controller);
  const int samples =
      with_scalar_of(controller.target, [&](auto zero) { return drop_out_that_breaks<decltype(zero)>(at_zero); });
  if (samples < 0) return;
  const std::string advice = controller.target.is_double ? "\"ud\"" : "\"ud\", or real = \"double\"";
  if (samples == 0)
    return design::add_error(
        findings, "kalman.covariance",
        "expected " + advice +
            ": in the target's numbers a plain P loses its definiteness while all outputs are there");
  design::add_note(findings, "kalman.covariance",
                   "in the target's numbers a plain P loses its definiteness when the outputs come back after " +
                       std::to_string(samples) + (samples == 1 ? " sample" : " samples") + " without them (" +
                       design::decimal(samples * controller.problem.plant.sample_time) +
                       " s), and begins anew: choose " + advice + " where that may happen");
}

}  // namespace lqg::simulate
