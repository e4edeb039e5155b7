// SPDX-License-Identifier: MIT
// What is called between two samples: emitted code in both styles against the step, in every bit.
#include <cstdio>

#include <unity.h>

#include "emitted.hpp"
#include "lqg/status.h"
#include "servo_design.hpp"
#include "simulate/emitted_controller.hpp"
#include "simulate/numbers.hpp"
#include "step/by_hand.hpp"
#include "step/covariance.hpp"
#include "step/innovation.hpp"
#include "step/partial_update.hpp"
#include "trace/print.hpp"

using namespace lqg_test;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using lqg::design::Problem;
using lqg::design::Solution;
using lqg::emit::Controller;
using lqg::simulate::EmittedController;
using lqg::step::Event;
using lqg::step::Vector;

namespace {

constexpr int samples = 6;

// What the caller hands over in one sample, numbers of the target.
struct Calls {
  VectorXd r, y, x, u, late_y;
  unsigned long used = 0;
  int damaged = -1;  // the number of P (or of d) whose sign is wrong from now on
};

std::vector<Calls> random_calls(const Controller& controller) {
  Random random(7);
  const auto numbers = [&](int size) {
    VectorXd values(size);
    for (double& value : values) value = random.uniform();
    return lqg::simulate::in_target(controller.target, values);
  };
  std::vector<Calls> calls(samples);
  for (Calls& call : calls) {
    call.r = numbers(controller.size.nr), call.x = numbers(controller.size.nx), call.u = numbers(controller.size.nu);
    call.y = numbers(controller.size.ny), call.late_y = numbers(controller.size.ny);
    call.used = static_cast<unsigned long>(random.between(0, 3));
    if (controller.size.ny && random.one_in(3)) call.late_y(0) = 1e30;
  }
  if (controller.size.nr) calls[1].r(0) = std::numeric_limits<double>::quiet_NaN();
  return calls;
}

bool has_partial_update(const Controller& controller) { return controller.size.ny > 1 && !controller.has.stages; }

// ---- the step

// Numbers and statuses as both sides print them. A zero has no sign here: the two may differ in it.
class Record {
 public:
  template <class S>
  void add(const S& value) {
    char text[40];
    std::snprintf(text, sizeof text, "%a ", lqg::simulate::as_double(value) + 0.0);
    text_ += text;
  }
  template <class S>
  void add_all(const Vector<S>& values) {
    for (Eigen::Index i = 0; i < values.size(); ++i) add(S(values(i)));
  }
  template <class S>
  void add_all(const std::vector<S>& values) {
    for (const S& value : values) add(value);
  }
  void add_status(unsigned events) {
    const std::pair<Event, lqg_status_t> bits[] = {{Event::output_rejected, LQG_OUTPUT_REJECTED},
                                                   {Event::innovation_not_positive, LQG_INNOVATION_NOT_POSITIVE},
                                                   {Event::input_limited, LQG_INPUT_LIMITED},
                                                   {Event::state_reset, LQG_STATE_RESET},
                                                   {Event::reference_not_finite, LQG_REFERENCE_NOT_FINITE},
                                                   {Event::output_gated, LQG_OUTPUT_GATED},
                                                   {Event::covariance_reset, LQG_COVARIANCE_RESET},
                                                   {Event::not_optimal, LQG_NOT_OPTIMAL}};
    lqg_status_t status = LQG_OK;
    for (const auto& [event, bit] : bits)
      if (events >> static_cast<unsigned>(event) & 1) status |= bit;
    for (int i = 0; i < lqg::step::told_rejections; ++i)
      if (events >> static_cast<unsigned>(lqg::step::rejection_of(i)) & 1) status |= LQG_OUTPUT_REJECTED_BIT(i);
    text_ += std::to_string(status) + " ";
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

// The calls on the host; x̂ that they leave never has to begin anew.
template <class S>
class Host {
 public:
  explicit Host(const Controller& controller)
      : controller_(controller), round_(lqg::simulate::constants_of<S>(controller.target)),
        emitted_(controller, round_) {}

  std::string run(const std::vector<Calls>& calls) {
    for (const Calls& call : calls) {
      emitted_.state().r = numbers(call.r);
      if (call.damaged >= 0) damage(static_cast<std::size_t>(call.damaged));
      if (controller_.has.filter)
        use_filter(call);
      else
        use_regulator(call);
      add_state();
    }
    record_.add_status(0);
    return record_.text() + std::to_string(emitted_.resets()) + " " + std::to_string(emitted_.covariance_resets());
  }

 private:
  void damage(std::size_t k) {
    auto& values = controller_.filter == lqg::step::Filter::ud ? emitted_.state().D : emitted_.state().P;
    values[k] = S(0) - values[k];
  }
  static Vector<S> numbers(const VectorXd& values) { return lqg::simulate::numbers_of<S>(values); }

  void use_filter(const Calls& call) {
    record_.add_status(emitted_.update(numbers(call.y)));
    record_.add_all(lqg::step::covariance(emitted_.model(), emitted_.state()));
    for (int i = 0; i < controller_.size.ny; ++i)
      if (lqg::controller::can_update_alone(controller_, i))
        record_.add_status(emitted_.update_alone(i, S(call.late_y(i))));
    add_state();  // before the updates and predictions behind it write over it
    set_state(call);
    if (lqg::controller::can_set_input(controller_)) set_input(call);
    if (has_partial_update(controller_)) record_.add_status(partial_update(numbers(call.late_y), call.used));
    record_.add_status(emitted_.predict(numbers(call.u)));
  }
  void use_regulator(const Calls& call) {
    Vector<S> u;
    record_.add_status(emitted_.control(numbers(call.x), u));
    record_.add_all(u);
    if (lqg::controller::can_set_input(controller_)) set_input(call);
  }
  void set_state(const Calls& call) {
    lqg::step::Listener listener;
    TEST_ASSERT_TRUE(lqg::step::set_state(emitted_.model(), emitted_.state(), numbers(call.x), listener));
    record_.add_status(listener.events);
  }
  void set_input(const Calls& call) {
    lqg::step::Listener listener;
    TEST_ASSERT_TRUE(lqg::step::set_input(emitted_.model(), emitted_.state(), numbers(call.u), listener));
    record_.add_status(listener.events);
  }
  unsigned partial_update(Vector<S> there, unsigned long used) {
    for (int i = 0; i < there.size(); ++i)
      if (!(used >> i & 1)) there(i) = S(std::numeric_limits<double>::infinity());
    auto outputs = emitted_.model();  // as they are, not made uncorrelated
    outputs.C = lqg::controller::convert<S>(controller_.solution.plant.C, round_);
    if (controller_.has.feedthrough) outputs.D = lqg::controller::convert<S>(controller_.solution.plant.D, round_);
    lqg::step::Listener listener;
    const Vector<S> nu = lqg::step::innovations(outputs, emitted_.state(), there, listener);
    const auto lost = lqg::step::lost_outputs(emitted_.model(), nu, there, listener);
    for (int i = 0; i < there.size(); ++i) listener.reject(i, (used >> i & 1) && lost[static_cast<std::size_t>(i)]);
    return listener.events | (emitted_.update(there) & ~lqg::step::all_rejections());
  }
  void add_state() {
    const auto& state = emitted_.state();
    if (controller_.has.filter) record_.add_all(state.x);
    record_.add_all(state.P), record_.add_all(state.U), record_.add_all(state.D);
    record_.add_all(state.u), record_.add_all(state.widening), record_.add_all(state.innovation);
    record_.add_all(state.xi), record_.add_all(state.error), record_.add_all(state.demand);
  }

  const Controller& controller_;
  decltype(lqg::simulate::constants_of<S>(lqg::emit::Controller().target)) round_;
  EmittedController<S> emitted_;
  Record record_;
};

// ---- the program

std::string literals(const VectorXd& values, bool is_double) {
  std::string out;
  for (const double value : values)
    out += (out.empty() ? "" : ", ") + (std::isnan(value) ? "NAN" : lqg::trace::literal(value, is_double));
  return "{" + out + "}";
}

std::string show_state(const Controller& controller) {
  std::string out;
  for (const auto& field : lqg::controller::state_fields(controller))
    if (field.kind == lqg::controller::Kind::reals && field.name != "r")
      out += "        SHOW(self." + field.name + ");\n";
  return out;
}

// The calls of one sample, in C.
std::string in_c(const Controller& controller, const Calls& call) {
  const bool is_double = controller.target.is_double;
  std::string out = "    {\n";
  const auto array = [&](const char* name, const VectorXd& values) {
    if (values.size()) out += std::string("        const real ") + name + "[] = " + literals(values, is_double) + ";\n";
  };
  const auto status = [&](const std::string& text) { out += "        show_status(loop_" + text + ");\n"; };
  array("r", call.r), array("x", call.x), array("u", call.u), array("y", call.y), array("late_y", call.late_y);
  if (controller.size.nr) out += "        memcpy(self.r, r, sizeof r);\n";
  if (call.damaged >= 0) {
    const std::string number =
        (controller.filter == lqg::step::Filter::ud ? "self.d[" : "self.P[") + std::to_string(call.damaged) + "]";
    out += "        " + number + " = -" + number + ";\n";
  }
  if (controller.has.filter) {
    status("update(&self, y)");
    if (controller.filter == lqg::step::Filter::ud) out += "        loop_covariance(&self, P);\n        SHOW(P);\n";
    if (controller.filter == lqg::step::Filter::plain) out += "        SHOW(self.P);\n";
    for (int i = 0; i < controller.size.ny; ++i)
      if (lqg::controller::can_update_alone(controller, i))
        status("update_" + controller.problem.plant.outputs[static_cast<std::size_t>(i)].name + "(&self, late_y[" +
               std::to_string(i) + "])");
    out += show_state(controller);
    status("set_state(&self, x)");
    if (lqg::controller::can_set_input(controller)) status("set_input(&self, u)");
    if (has_partial_update(controller)) status("partial_update(&self, late_y, " + std::to_string(call.used) + "ul)");
    status(controller.size.nu ? "predict(&self, u)" : "predict(&self)");
  } else {
    out += "        real given[LOOP_NU];\n";
    status("control(&self, x, given)");
    out += "        SHOW(given);\n";
    if (lqg::controller::can_set_input(controller)) status("set_input(&self, x, u)");
  }
  return out + show_state(controller) + "    }\n";
}

std::string program(const Controller& controller, const std::vector<Calls>& calls) {
  std::string out =
      std::string("#include <math.h>\n#include <stdio.h>\n#include <string.h>\n#include \"loop.h\"\n\ntypedef ") +
      (controller.target.is_double ? "double" : "float") + R"( real;

static void show(const real v[], unsigned long count)
{
    for (unsigned long i = 0; i < count; i++)
        printf("%a ", (double)v[i] + 0.0);
}
#define SHOW(v) show(v, sizeof v / sizeof *v)

static void show_status(lqg_status_t status)
{
    printf("%u ", status);
}

int main(void)
{
    static loop_t self;
    real P[LOOP_NX * (LOOP_NX + 1) / 2];

    (void)P;
    loop_init(&self);
)";
  for (const Calls& call : calls) out += in_c(controller, call);
  const std::string resets = controller.has.filter ? "self.resets" : "0ul";
  const std::string covariance_resets = carries_covariance(controller) ? "self.covariance_resets" : "0ul";
  return out + "    show_status(0);\n    printf(\"%lu %lu\", " + resets + ", " + covariance_resets +
         ");\n    return 0;\n}\n";
}

// Returns what both printed.
std::string expect_the_bits_of_the_step(Controller controller, const std::vector<Calls>& calls) {
  const std::string expected = lqg::simulate::with_scalar_of(
      controller.target, [&](auto zero) { return Host<decltype(zero)>(controller).run(calls); });
  for (const auto style : {lqg::design::Style::unrolled, lqg::design::Style::compact}) {
    controller.style = style;
    TEST_ASSERT_EQUAL_STRING(expected.c_str(), run_with_header(controller, program(controller, calls)).c_str());
  }
  return expected;
}

void expect_the_bits_of_the_step(const Controller& controller) {
  expect_the_bits_of_the_step(controller, random_calls(controller));
}

// ---- the controllers

void as_designed(Problem&, Solution&) {}

DesignText correlated(const char* gain, const char* covariance) {
  DesignText design = double_integrators(2);
  design.D = (MatrixXd(2, 2) << 0.3, 0, 0.1, -0.2).finished();
  design.V << 0.01, 0.004, 0.004, 0.02;
  design.Swv = (MatrixXd(2, 2) << 0.01, 0, -0.005, 0.02).finished();
  design.gain = gain, design.covariance = covariance;
  return design;
}

void test_filters_with_everything() {
  for (const char* arithmetic : {"plain", "fused"})
    for (const auto& [gain, covariance] :
         {std::pair("steady", ""), std::pair("online", "ud"), std::pair("online", "plain")}) {
      DesignText design = correlated(gain, covariance);
      design.arithmetic = arithmetic;
      expect_the_bits_of_the_step(changed(design, as_designed));
      design.real = "double", design.form = "predictor";
      expect_the_bits_of_the_step(changed(design, as_designed));
    }
}

void test_filters_of_every_size_that_carry_factors() {
  for (const int count : {1, 3}) {
    DesignText design = double_integrators(count);
    design.gain = "online", design.covariance = "ud";
    design.P0 = MatrixXd::Constant(2 * count, 2 * count, 0.25) + MatrixXd::Identity(2 * count, 2 * count);
    expect_the_bits_of_the_step(changed(design, as_designed));
  }
}

// Each variance in turn: P begins anew, whether an update or a prediction finds it, and x̂ stays.
void test_a_covariance_with_a_negative_variance() {
  for (const char* real : {"float", "double"})
    for (const char* covariance : {"ud", "plain"})
      for (const bool are_correlated : {false, true}) {
        DesignText design = are_correlated ? correlated("online", covariance) : double_integrators(2);
        design.gain = "online", design.covariance = covariance, design.real = real;
        const Controller controller = changed(design, as_designed);
        std::vector<Calls> calls;
        for (int i = 0; i < controller.size.nx; ++i) {
          for (const Calls& call : random_calls(controller)) calls.push_back(call);
          calls.back().damaged = controller.filter == lqg::step::Filter::ud ? i : lqg::step::triangle(i, i);
        }
        const std::string printed = expect_the_bits_of_the_step(controller, calls);
        const std::string resets = printed.substr(printed.size() - 4);  // and those of P: noise may heal one
        TEST_ASSERT_TRUE(resets == " 0 3" || resets == " 0 4");
      }
}

// Each gain of the law is different in each of six samples.
void schedule_law(Problem&, Solution& solution) {
  auto& regulator = *solution.regulator;
  for (int k = 0; k < 5; ++k) {
    auto K = regulator.K;
    for (Eigen::Index i = 0; i < K.size(); ++i) K.data()[i] *= lqg::design::Real(1 + 0.1 * (5 - k));
    regulator.K_schedule.push_back(K);
  }
}

// Two integrals of two outputs, both inputs in each of them.
void integrate_both(Problem& problem, Solution& solution) {
  problem.regulator->integral = lqg::design::Integral{{0, 1}, MatrixXd::Identity(2, 2)};
  solution.regulator->K = matrix({{4, 3, 0.5, 0.25, -2, 0.125}, {0.5, 0.75, 3, 4, 0.25, -1}});
}

void test_integrals_of_outputs_that_are_updated_alone() {
  for (const char* arithmetic : {"plain", "fused"})
    for (const auto& [gain, covariance] :
         {std::pair("steady", ""), std::pair("online", "ud"), std::pair("online", "plain")}) {
      DesignText design = double_integrators(2);
      design.gain = gain, design.covariance = covariance, design.arithmetic = arithmetic;
      expect_the_bits_of_the_step(changed(design, integrate_both));
      expect_the_bits_of_the_step(changed(design, [](Problem& problem, Solution& solution) {
        integrate_both(problem, solution);
        schedule_law(problem, solution);
      }));
    }
}

void test_laws_that_begin_with_the_last_input() {
  for (const auto& also : {as_designed, schedule_law})
    expect_the_bits_of_the_step(changed(limited_double_integrator(), [&](Problem& problem, Solution& solution) {
      weigh_changes(problem, solution);
      also(problem, solution);
    }));
}

void test_laws_with_feed_forward() {
  expect_the_bits_of_the_step(changed(limited_double_integrator(), [](Problem& problem, Solution& solution) {
    track_position(problem, solution);
    integrate_position(problem, solution);
    schedule_law(problem, solution);
  }));
}

void test_regulators_alone() {
  DesignText design = limited_double_integrator();
  design.W.resize(0, 0);
  for (const auto& kind : {integrate_position, weigh_changes})
    for (const auto& also : {as_designed, schedule_law})
      expect_the_bits_of_the_step(changed(design, [&](Problem& problem, Solution& solution) {
        kind(problem, solution);
        also(problem, solution);
      }));
}

// set_input tells the law that the inputs on their way are u, whatever x says of them.
void test_a_regulator_alone_with_inputs_on_their_way() {
  DesignText design = double_integrator();
  design.W.resize(0, 0);
  expect_the_bits_of_the_step(changed(design, [](Problem& problem, Solution& solution) {
    delay_input(problem, solution);
    integrate_position(problem, solution);
    solution.regulator->K = matrix({{0.8, 1.2, 0.12, 0.125, -0.25}});
  }));
}

void test_inputs_on_their_way() { expect_the_bits_of_the_step(changed(double_integrator(), delay_input)); }

}  // namespace

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_filters_with_everything);
  RUN_TEST(test_filters_of_every_size_that_carry_factors);
  RUN_TEST(test_a_covariance_with_a_negative_variance);
  RUN_TEST(test_integrals_of_outputs_that_are_updated_alone);
  RUN_TEST(test_laws_that_begin_with_the_last_input);
  RUN_TEST(test_laws_with_feed_forward);
  RUN_TEST(test_regulators_alone);
  RUN_TEST(test_a_regulator_alone_with_inputs_on_their_way);
  RUN_TEST(test_inputs_on_their_way);
  return UNITY_END();
}
