// SPDX-License-Identifier: MIT
#include "emit/vectors/player.hpp"

#include "emit/vectors/comparison.hpp"
#include "simulate/emitted_controller.hpp"
#include "simulate/emitted_form.hpp"
#include "step/covariance.hpp"

namespace lqg::emit {

namespace {

using step::Vector;

// A controller that keeps x̂, or none.
template <class S>
class PhysicalPlayer : public Player {
 public:
  PhysicalPlayer(const Controller& controller, const std::vector<Sample>& samples)
      : controller_(controller), samples_(samples), emitted_(controller, simulate::constants_of<S>(controller.target)) {
  }

  std::unique_ptr<Player> copy() const override { return std::make_unique<PhysicalPlayer>(*this); }
  Answer play(const Turn& turn) override {
    Answer answer;
    answer.events = call(turn, answer);
    for (const S& error : emitted_.state().error) answer.at_limits.push_back(step::is_zero(error));
    return answer;
  }

  void add_state(Hash& hash) const override {
    const step::State<S>& state = emitted_.state();
    if (controller_.has.filter) hash.add_all(list_of(state.x));
    hash.add_all(state.P), hash.add_all(state.U), hash.add_all(state.D);
    for (const auto* values :
         {&state.u, &state.widening, &state.innovation, &state.r, &state.xi, &state.error, &state.demand})
      hash.add_all(list_of(*values));
    if (controller_.has.filter) hash.add_count(emitted_.resets());
    if (carries_covariance(controller_)) hash.add_count(emitted_.covariance_resets());
    for (std::size_t i = 0; controller_.has.gate && i < emitted_.gated().size(); ++i)
      hash.add_count(emitted_.gated()[i]);
  }

  std::vector<std::pair<int, double>> variances() const override {
    const step::State<S>& state = emitted_.state();
    std::vector<std::pair<int, double>> out;
    for (int i = 0; i < emitted_.model().nx; ++i) {
      const int at = state.P.empty() ? i : step::triangle(i, i);
      const double value = simulate::as_double((state.P.empty() ? state.D : state.P)[static_cast<std::size_t>(at)]);
      if (value != 0) out.emplace_back(at, value);
    }
    return out;
  }

 private:
  Vector<S> given(const Turn& turn, std::vector<double> Sample::* row) const {
    return numbers_of<S>(handed_over(turn, samples_[turn.row].*row, controller_.target));
  }
  Vector<S> given_input(const Turn& turn) const { return given(turn, &Sample::u); }
  // Of a regulator alone the samples hold states in place of outputs.
  std::vector<double> Sample::* states() const { return controller_.has.filter ? &Sample::x : &Sample::y; }

  unsigned call(const Turn& turn, Answer& answer) {
    switch (turn.call) {
      case Call::init: return emitted_.init(), 0;
      case Call::step: return run_sample(turn, answer);
      case Call::update: return emitted_.update(given(turn, &Sample::y));
      case Call::update_alone: return emitted_.update_alone(turn.entry, S(turn.number));
      case Call::partial_alone: return emitted_.partial_update(given(turn, &Sample::y), 1ul << turn.entry);
      case Call::partial_without: return emitted_.partial_update(given(turn, &Sample::y), ~(1ul << turn.entry));
      case Call::control: return act(turn, answer);
      case Call::predict: return emitted_.predict(given_input(turn));
      case Call::set_state: return emitted_.set_state(given(turn, states()));
      case Call::set_input:
        return controller_.has.filter ? emitted_.set_input(given_input(turn))
                                      : emitted_.set_input(numbers_of<S>(samples_[turn.row].y), given_input(turn));
      default: return look_or_write(turn, answer), 0;
    }
  }

  void look_or_write(const Turn& turn, Answer& answer) {
    step::State<S>& state = emitted_.state();
    switch (turn.call) {
      case Call::innovation: return innovate(turn, answer);
      case Call::estimate: answer.results = list_of(emitted_.estimate()); return;
      case Call::covariance:
        for (const S& entry : step::covariance(emitted_.model(), state))
          answer.results.push_back(simulate::as_double(entry));
        return;
      case Call::write_r: state.r = given(turn, &Sample::r); return;
      case Call::write_x: state.x = given(turn, states()); return;
      case Call::write_covariance: return write(turn, state.P.empty() ? state.D : state.P);
      case Call::write_xi: return write(turn, state.xi);
      default: return;
    }
  }

  template <class Values>
  void write(const Turn& turn, Values& values) {
    const S number(turn.number);
    if (turn.entry >= 0)
      values[static_cast<std::size_t>(turn.entry)] = number;
    else
      for (auto& value : values) value = S(number * value);
  }

  void innovate(const Turn& turn, Answer& answer) {
    Vector<S> nu, variances;
    emitted_.innovation(given(turn, &Sample::y), nu, variances);
    answer.results = list_of(nu);
    for (const double variance : list_of(variances)) answer.results.push_back(variance);
  }

  unsigned act(const Turn& turn, Answer& answer) {
    const Vector<S> last = emitted_.state().u;
    Vector<S> u;
    const unsigned events = controller_.has.filter ? emitted_.control(u) : emitted_.control(given(turn, &Sample::y), u);
    answer.results = list_of(u);
    const step::Model<S>& model = emitted_.model();
    const bool foresees = model.foreseen.G.rows() > 0;
    const Vector<S> least = foresees ? Vector<S>(model.foreseen.low.head(u.size())) : model.u_min;
    const Vector<S> most = foresees ? Vector<S>(model.foreseen.high.head(u.size())) : model.u_max;
    const Vector<S>& steps = foresees ? model.foreseen.u_step : model.u_step;
    for (Eigen::Index i = 0; i < u.size(); ++i) {
      const auto is = [&](const Vector<S>& values, const S& deviation) {
        const S value = step::in_own_units(model.point.u, static_cast<int>(i), deviation);
        return values.size() && step::is_zero(S(u(i) - value));
      };
      const S step = steps.size() ? S(steps(i)) : S(0);
      answer.at_limits.push_back(is(least, least.size() ? S(least(i)) : S(0)));
      answer.at_limits.push_back(is(most, most.size() ? S(most(i)) : S(0)));
      answer.at_limits.push_back(is(steps, last.size() ? S(last(i) - step) : S(0)));
      answer.at_limits.push_back(is(steps, last.size() ? S(last(i) + step) : S(0)));
    }
    return events;
  }

  // As NAME_step.
  unsigned run_sample(const Turn& turn, Answer& answer) {
    unsigned events = 0;
    if (controller_.has.regulator && controller_.is_predictor) events |= act(turn, answer);
    events |= emitted_.update(given(turn, &Sample::y));
    if (controller_.has.regulator && !controller_.is_predictor) events |= act(turn, answer);
    const std::vector<double> applied = controller_.has.regulator ? answer.results : samples_[turn.row].u;
    return events | emitted_.predict(numbers_of<S>(applied));
  }

  const Controller& controller_;
  const std::vector<Sample>& samples_;
  simulate::EmittedController<S> emitted_;
};

// A controller that keeps z.
template <class S>
class FormPlayer : public Player {
 public:
  FormPlayer(const Controller& controller, const std::vector<Sample>& samples)
      : controller_(controller), samples_(samples), emitted_(controller, simulate::constants_of<S>(controller.target)) {
  }

  std::unique_ptr<Player> copy() const override { return std::make_unique<FormPlayer>(*this); }
  Answer play(const Turn& turn) override {
    Answer answer;
    const Vector<S> y = numbers_of<S>(handed_over(turn, samples_[turn.row].y, controller_.target));
    switch (turn.call) {
      case Call::init: emitted_.init(); break;
      case Call::step: answer.events = act(y, answer) | emitted_.advance(y); break;
      case Call::control: answer.events = act(y, answer); break;
      case Call::advance: answer.events = emitted_.advance(y); break;
      case Call::estimate: answer.results = list_of(emitted_.estimate()); break;
      case Call::set_state:
        answer.events = emitted_.set_state(numbers_of<S>(handed_over(turn, samples_[turn.row].x, controller_.target)));
        break;
      default:
        for (S& each : emitted_.state().z) each = S(S(turn.number) * each);
    }
    return answer;
  }

  void add_state(Hash& hash) const override {
    hash.add_all(list_of(emitted_.state().z));
    hash.add_all(list_of(emitted_.state().y));
    hash.add_count(emitted_.resets());
  }

 private:
  unsigned act(const Vector<S>& y, Answer& answer) {
    Vector<S> u;
    const unsigned events = emitted_.control(y, u);
    answer.results = list_of(u);
    return events;
  }

  const Controller& controller_;
  const std::vector<Sample>& samples_;
  simulate::EmittedForm<S> emitted_;
};

}  // namespace

std::unique_ptr<Player> make_player(const Controller& controller, const std::vector<Sample>& samples) {
  return simulate::with_scalar_of(controller.target, [&](auto zero) -> std::unique_ptr<Player> {
    using S = decltype(zero);
    if (controller.linear) return std::make_unique<FormPlayer<S>>(controller, samples);
    return std::make_unique<PhysicalPlayer<S>>(controller, samples);
  });
}

}  // namespace lqg::emit
