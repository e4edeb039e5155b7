// SPDX-License-Identifier: MIT
#include "emit/vectors/calls.hpp"

#include <cmath>
#include <limits>
#include <utility>

#include "emit/vectors/comparison.hpp"
#include "emit/vectors/player.hpp"
#include "emit/vectors/vectors.hpp"

namespace lqg::emit {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

// Plays turns and writes them down.
class Script {
 public:
  Script(const Controller& controller, const std::vector<Sample>& samples)
      : controller_(controller), samples_(samples), player_(make_player(controller, samples)) {}

  const Player& player() const { return *player_; }

  // Turns that this header has no call for are left out.
  void add(const Turn& turn) {
    if (!can(turn)) return;
    player_->play(turn);
    turns_.push_back(turn);
  }

  // A row of the samples that was not used for a while.
  std::size_t next_row() { return row_ = (row_ + 1) % samples_.size(); }

  // Adds the turns with turns[varied].number on both sides of each place where they answer otherwise: from small
  // numbers of the sign to the largest. Whatever a bound, a gate or a limit is, it is found here.
  void search(std::vector<Turn> turns, std::size_t varied, double sign = 1) {
    constexpr int first = -24, step = 4, most = 3;
    const int last = controller_.target.is_double ? 1020 : 124;
    for (const Turn& turn : turns)
      if (!can(turn)) return;
    const auto with = [&](double number) {
      turns[varied].number = sign * number;
      return turns;
    };
    int found = 0;
    Signature before = signature_of(with(std::ldexp(1.0, first)));
    for (int exponent = first; exponent < last && found < most; exponent += step) {
      const double low = std::ldexp(1.0, exponent), high = std::ldexp(1.0, exponent + step);
      if (!is_finite(with(high)[varied]) || (was_reset(before) && !is_heard(turns[varied].call))) return;
      if (signature_of(with(high)) == before) continue;
      ++found;
      for (const bool beyond : {false, true}) {
        auto [near, far] = edge(with, low, high);
        // The bounds of x̂ and ξ are one sum in straight-line code and two in the library: where a quarter of it is
        // below its bound and four times it is not, both say the same.
        if (controller_.size.nxi && was_reset(signature_of(with(far)))) near /= 2, far *= 2;
        for (const Turn& turn : with(beyond ? far : near)) add(turn);
      }
      before = signature_of(with(high));
    }
  }

  Calls calls() const {
    Calls calls{turns_, 0};
    Hash hash(controller_.target.is_double);
    const std::unique_ptr<Player> player = make_player(controller_, samples_);
    for (const Turn& turn : turns_) {
      const Answer answer = player->play(turn);
      hash.add_count(told(answer.events));
      hash.add_all(answer.results);
      player->add_state(hash);
    }
    calls.hash = hash.value();
    return calls;
  }

 private:
  using Signature = std::vector<std::pair<unsigned, std::vector<bool>>>;

  static unsigned told(unsigned events) {
    unsigned out = 0;
    for (std::size_t i = 0; i < told_events.size(); ++i)
      out |= (events >> static_cast<unsigned>(told_events[i]) & 1u) << i;
    const unsigned rejected = (events & step::all_rejections()) >> static_cast<unsigned>(step::Event::first_rejected);
    return out | rejected << 8;  // where the status has them
  }
  // Beyond the output that is too much for the state come those that nobody believes.
  static bool is_heard(Call call) {
    return call == Call::update || call == Call::update_alone || call == Call::partial_alone;
  }
  static bool was_reset(const Signature& signature) {
    for (const auto& [events, at_limits] : signature)
      for (const step::Event reset : {step::Event::state_reset, step::Event::covariance_reset})
        if (events >> static_cast<unsigned>(reset) & 1u) return true;
    return false;
  }

  bool can(const Turn& turn) const {
    return has_call(controller_, turn.call) &&
           (turn.call != Call::update_alone || controller::has_update_alone(controller_, turn.entry));
  }
  // None of the numbers of the row overflows.
  bool is_finite(const Turn& turn) const {
    const Sample& sample = samples_[turn.row];
    for (const auto* row : {&sample.r, &sample.y, &sample.x, &sample.u})
      if (turn.entry < 0)
        for (const double value : handed_over(turn, *row, controller_.target))
          if (!std::isfinite(value)) return false;
    return true;
  }

  Signature signature_of(const std::vector<Turn>& turns) const {
    const std::unique_ptr<Player> player = player_->copy();
    Signature signature;
    for (const Turn& turn : turns) {
      const Answer answer = player->play(turn);
      signature.emplace_back(answer.events, answer.at_limits);
    }
    return signature;
  }

  // Two neighbours among the target's numbers that answer as `low` does and not so.
  template <class With>
  std::pair<double, double> edge(With with, double low, double high) const {
    const Signature before = signature_of(with(low));
    for (;;) {
      double middle = (low + high) / 2;
      if (!controller_.target.is_double) middle = static_cast<double>(static_cast<float>(middle));
      if (middle <= low || middle >= high) return {low, high};
      (signature_of(with(middle)) == before ? low : high) = middle;
    }
  }

  const Controller& controller_;
  const std::vector<Sample>& samples_;
  std::unique_ptr<Player> player_;
  std::vector<Turn> turns_;
  std::size_t row_ = 0;
};

// ---- of a controller that keeps x̂

class PhysicalScript {
 public:
  PhysicalScript(const Controller& controller, const std::vector<Sample>& samples)
      : controller_(controller), script_(controller, samples), samples_(samples) {}

  Calls calls() {
    add(Call::init);
    run(3);
    search({whole(Call::set_state)}, 0);
    run(2);
    for (int i = 0; i < controller_.size.ny; ++i) drop_out(i);
    for (int i = 0; i < controller_.size.ny; ++i) say_absurd(i);
    for (int i = 0; i < controller_.size.nr; ++i) refer(i);
    limit();
    leave_bounds();
    lose_covariance();
    integrate();
    run(6);
    return script_.calls();
  }

 private:
  void add(Call call) { script_.add(whole(call)); }
  void add(Call call, int entry, double number) { script_.add(one(call, entry, number)); }
  void search(const std::vector<Turn>& turns, std::size_t varied, double sign = 1) {
    script_.search(turns, varied, sign);
  }

  Turn whole(Call call, double number = 1) { return {call, script_.next_row(), Turn::every_entry, number}; }
  Turn one(Call call, int entry, double number) { return {call, script_.next_row(), entry, number}; }

  // Samples as they are, and what those see who watch.
  void run(int count) {
    for (int k = 0; k < count; ++k) {
      add(Call::write_r);
      add(Call::innovation);
      add(Call::step);
      add(Call::estimate);
      add(Call::covariance);
      if (!controller_.has.filter) add(Call::control);
    }
  }

  // The output is missing for a while, by each path.
  void drop_out(int i) {
    const double honest =
        handed_over({}, samples_[script_.next_row()].y, controller_.target)[static_cast<std::size_t>(i)];
    for (const double number : {nan, infinity, -infinity}) {
      add(Call::innovation, i, number);
      add(Call::update, i, number);
      add(Call::control);
      add(Call::predict);
      add(Call::partial_alone, i, number);
      add(Call::update_alone, i, number);
    }
    add(Call::step, i, nan);
    add(Call::predict);
    add(Call::partial_without, i, nan);
    add(Call::partial_without, controller_.size.ny, 0);  // all are there
    add(Call::control);
    add(Call::predict);
    add(Call::partial_alone, i, honest);
    add(Call::predict);
    add(Call::update_alone, i, honest);
    run(1);
  }

  // Up to the largest numbers, in each call that hears the output.
  void say_absurd(int i) {
    for (const double sign : {1.0, -1.0}) {
      search({whole(Call::set_state), one(Call::update, i, 0)}, 1, sign);
      search({whole(Call::set_state), one(Call::update_alone, i, 0)}, 1, sign);
    }
    search({whole(Call::set_state), one(Call::partial_alone, i, 0)}, 1);
    add(Call::set_state);
    run(1);
  }

  void refer(int i) {
    add(Call::write_r, i, nan);
    add(Call::control);
    add(Call::step);
    search({one(Call::write_r, i, 0), whole(Call::control)}, 0);
    search({one(Call::write_r, i, 0), whole(Call::control)}, 0, -1);
    run(1);
  }

  // A law far beyond its limits, on both sides, and an actuator that did something else.
  void limit() {
    for (const double sign : {1.0, -1.0}) {
      if (!controller_.has.filter) search({whole(Call::control)}, 0, sign);
      for (int row = 0; row < 2; ++row) search({whole(Call::write_x), whole(Call::control)}, 0, sign);
      add(Call::predict);
      add(Call::set_state);
      add(Call::control);
      script_.add(whole(Call::predict, -2));
      search({whole(Call::set_input), whole(Call::control)}, 0, sign);
      run(1);
    }
    forget_a_state();
    for (int i = 0; i < controller_.size.nu; ++i) {
      search({one(Call::predict, i, 0)}, 0);
      search({one(Call::set_input, i, 0)}, 0, -1);
      run(1);
    }
  }

  // A state of which every input is made is no number: straight-line code leaves out those that no input needs.
  void forget_a_state() {
    for (int i = 0; i < controller_.size.nx && controller_.has.regulator; ++i) {
      bool acts = true;
      for (const Gains& law : controller_.laws)
        for (int j = 0; j < controller_.size.nu; ++j) acts = acts && law[0](j, i) != 0;
      if (!acts) continue;
      add(Call::write_x, i, nan);
      add(Call::control, i, nan);
      add(Call::set_state);
      return;
    }
  }

  // Nothing is heard, and each call in turn finds the state at its bounds.
  void leave_bounds() {
    for (int row = 0; row < 2; ++row) {
      const Turn far = whole(Call::write_x, 0);
      search({far, whole(Call::update, nan)}, 0);
      search({far, whole(Call::predict)}, 0);
      search({far, whole(Call::set_input)}, 0);
      search({far, one(Call::partial_without, 0, nan)}, 0);
      search({whole(Call::set_state)}, 0);
    }
    for (int i = 0; i < controller_.size.ny; ++i) search({whole(Call::write_x, 0), one(Call::update_alone, i, nan)}, 0);
    run(1);
  }

  // Variances that grow, and that become negative.
  void lose_covariance() {
    if (controller_.filter != step::Filter::plain && controller_.filter != step::Filter::ud) return;
    add(Call::init);
    search({whole(Call::write_covariance, 0), whole(Call::predict), whole(Call::update)}, 0);
    for (const auto& [entry, variance] : script_.player().variances())
      for (const double times : {-2.0, -0.0625}) {
        add(Call::init);
        run(1);
        add(Call::write_covariance, entry, times * variance);
        add(Call::innovation);
        add(Call::update);
        add(Call::covariance);
        run(2);
      }
    add(Call::init);
    run(1);
  }

  // ξ at its bounds, and inputs set by hand.
  void integrate() {
    for (int i = 0; i < controller_.size.nxi; ++i) {
      search({one(Call::write_xi, i, 0), whole(Call::predict)}, 0);
      search({one(Call::write_xi, i, 0), whole(Call::set_input)}, 0, -1);
      search({one(Call::write_xi, i, 0), whole(Call::control)}, 0);
      run(1);
    }
    for (int k = 0; k < 2; ++k) {
      add(Call::set_input);
      add(Call::control);
      add(Call::predict);
    }
  }

  const Controller& controller_;
  Script script_;
  const std::vector<Sample>& samples_;
};

// ---- of a controller that keeps z

class FormScript {
 public:
  FormScript(const Controller& controller, const std::vector<Sample>& samples)
      : controller_(controller), script_(controller, samples) {}

  Calls calls() {
    script_.add(whole(Call::init));
    run(3);
    for (int i = 0; i < controller_.size.ny; ++i)
      for (const double number : {nan, infinity, -infinity}) {
        hear(i, number);
        run(1);
      }
    for (const double sign : {1.0, -1.0}) {
      script_.search({whole(Call::write_z), whole(Call::control), whole(Call::advance)}, 0, sign);
      script_.search({whole(Call::set_state), whole(Call::control), whole(Call::advance)}, 0, sign);
      for (int i = 0; i < controller_.size.ny; ++i)
        script_.search({one(Call::control, i, 0), one(Call::advance, i, 0)}, controller_.is_predictor ? 1 : 0, sign);
      run(1);
    }
    script_.add(whole(Call::set_state));
    run(4);
    return script_.calls();
  }

 private:
  Turn whole(Call call, double number = 1) { return {call, script_.next_row(), Turn::every_entry, number}; }
  Turn one(Call call, int entry, double number) { return {call, script_.next_row(), entry, number}; }

  void run(int count) {
    for (int k = 0; k < count; ++k) hear(Turn::every_entry, 1);
    for (int k = 0; k < count; ++k) script_.add(whole(Call::step));
  }
  void hear(int entry, double number) {
    script_.add(one(Call::control, entry, number));
    script_.add(whole(Call::estimate));
    script_.add(one(Call::advance, entry, number));
    script_.add(one(Call::step, entry, number));
  }

  const Controller& controller_;
  Script script_;
};

}  // namespace

std::vector<double> handed_over(const Turn& turn, std::vector<double> row, const controller::Target& target) {
  const auto round = [&](double value) {
    return target.is_double ? value : static_cast<double>(static_cast<float>(value));
  };
  for (double& value : row) value = round(value);
  if (turn.entry >= 0 && turn.entry < static_cast<int>(row.size()))
    row[static_cast<std::size_t>(turn.entry)] = turn.number;
  if (turn.entry < 0)
    for (double& value : row) value = round(value * turn.number);  // the product of two floats is a double
  return row;
}

bool has_call(const Controller& controller, Call call) {
  constexpr int bits_of_long = 32;  // at least, and ~(1ul << ny) is all outputs
  const bool filter = controller.has.filter, linear = controller.linear.has_value();
  switch (call) {
    case Call::init: return controller.keeps.any;
    case Call::step: return filter;
    case Call::control: return controller.has.regulator;
    case Call::set_state: return filter;
    case Call::estimate: return has_estimate(controller);
    case Call::advance:
    case Call::write_z: return linear;
    case Call::update:
    case Call::predict:
    case Call::write_x: return filter && !linear;
    case Call::update_alone: return filter && !linear && controller.problem.code.updates == design::Updates::each;
    case Call::partial_without:
    case Call::partial_alone:
      return filter && !linear && controller.size.ny > 1 && controller.size.ny < bits_of_long && !controller.has.stages;
    case Call::innovation: return filter && !linear && !controller.has.stages;
    case Call::covariance: return controller.filter == step::Filter::ud || controller.modal;
    case Call::write_covariance:
      return controller.filter == step::Filter::ud || controller.filter == step::Filter::plain;
    case Call::set_input: return !linear && can_set_input(controller);
    case Call::write_r: return !linear && controller.size.nr > 0;
    case Call::write_xi: return !linear && controller.size.nxi > 0;
  }
  return false;
}

Calls make_calls(const Controller& controller, const std::vector<Sample>& samples) {
  return controller.linear ? FormScript(controller, samples).calls() : PhysicalScript(controller, samples).calls();
}

}  // namespace lqg::emit
