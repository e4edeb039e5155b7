// SPDX-License-Identifier: MIT
#include "commands/run.hpp"

#include <charconv>
#include <cstdlib>
#include <istream>
#include <optional>
#include <ostream>
#include <sstream>

#include "input/text.hpp"
#include "lqg/status.h"
#include "simulate/emitted_controller.hpp"
#include "simulate/emitted_form.hpp"
#include "simulate/numbers.hpp"

namespace lqg::commands {
namespace {

using controller::Controller;
using Eigen::Index;
using Eigen::VectorXd;
using simulate::as_doubles;
using simulate::EmittedController;
using simulate::EmittedForm;
using simulate::in_target;
using simulate::numbers_of;
using step::Event;
using step::Vector;

// What one line holds: `measured` is y, or x without a filter; `further` is r, or u of an estimator alone.
struct Told {
  VectorXd measured, further;
};

struct Answer {
  VectorXd u, x;
  unsigned events = 0;
};

lqg_status_t status_bit(int event) {
  switch (static_cast<Event>(event)) {
    case Event::output_rejected: return LQG_OUTPUT_REJECTED;
    case Event::innovation_not_positive: return LQG_INNOVATION_NOT_POSITIVE;
    case Event::input_limited: return LQG_INPUT_LIMITED;
    case Event::state_reset: return LQG_STATE_RESET;
    case Event::reference_not_finite: return LQG_REFERENCE_NOT_FINITE;
    case Event::output_gated: return LQG_OUTPUT_GATED;
    case Event::covariance_reset: return LQG_COVARIANCE_RESET;
    case Event::not_optimal: return LQG_NOT_OPTIMAL;
    case Event::first_rejected: break;
  }
  return LQG_OUTPUT_REJECTED_BIT(event - static_cast<int>(Event::first_rejected));
}

lqg_status_t status_of(unsigned events) {
  lqg_status_t status = LQG_OK;
  for (int event = 0; events >> event != 0; ++event)
    if (events >> event & 1u) status |= status_bit(event);
  return status;
}

// How many numbers a line has: all of `measured`, and none or all of `further`.
struct Shape {
  Index measured = 0, further = 0;
  bool needs_further = false;
  std::string words;

  explicit Shape(const Controller& controller) {
    measured = controller.has.filter ? controller.size.ny : controller.size.nx;
    needs_further = !controller.has.regulator && controller.size.nu > 0;
    further = needs_further ? controller.size.nu : controller.has.regulator ? controller.size.nr : 0;
    const std::string first = controller.has.filter ? "y" : "x", second = needs_further ? "u" : "r";
    const auto numbers = [](Index count) { return std::to_string(count) + (count == 1 ? " number" : " numbers"); };
    const std::string both = " (" + first + ", " + second + ")";
    words = needs_further ? numbers(measured + further) + both : numbers(measured) + " (" + first + ")";
    if (!needs_further && further > 0) words += " or " + std::to_string(measured + further) + both;
  }
  bool fits(Index count) const { return count == measured + further || (count == measured && !needs_further); }
};

// The numbers of a line, or the word that is none.
std::optional<std::string> read_numbers(const std::string& line, std::vector<double>& numbers) {
  std::string blanks = line;
  for (char& c : blanks)
    if (c == ',') c = ' ';
  std::istringstream words(blanks);
  for (std::string word; words >> word;) {
    char* end = nullptr;
    numbers.push_back(std::strtod(word.c_str(), &end));
    if (end != word.c_str() + word.size()) return word;
  }
  return std::nullopt;
}

// What the line tells, or why it tells nothing.
std::optional<Told> told_by(const std::string& line, const Shape& shape, std::string& why) {
  std::vector<double> numbers;
  if (const auto word = read_numbers(line, numbers)) {
    why = "expected " + shape.words + ", or reset, found " + input::in_quotes(*word);
    return std::nullopt;
  }
  const Index count = static_cast<Index>(numbers.size());
  if (!shape.fits(count)) {
    why = "expected " + shape.words + ", found " + std::to_string(count);
    return std::nullopt;
  }
  const VectorXd all = Eigen::Map<const VectorXd>(numbers.data(), count);
  return Told{all.head(shape.measured), all.tail(count - shape.measured)};
}

void write_number(std::ostream& out, double value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value).ptr;
  out.write(text, end - text) << ' ';
}

void write_answer(std::ostream& out, const Answer& answer) {
  for (const double value : answer.u) write_number(out, value);
  for (const double value : answer.x) write_number(out, value);
  out << status_of(answer.events) << '\n' << std::flush;
}

// A sample in the order of its form, as firmware takes it.
template <class S>
Answer take_sample(const Controller& controller, EmittedController<S>& emitted, const Told& told) {
  Answer answer;
  Vector<S> u;
  if (controller.has.regulator && told.further.size() > 0) emitted.state().r = numbers_of<S>(told.further);
  if (!controller.has.filter) {
    answer.x = told.measured;
    answer.events = emitted.control(numbers_of<S>(told.measured), u);
    answer.u = as_doubles(u);
    return answer;
  }
  const auto hear = [&] { answer.events |= emitted.update(numbers_of<S>(told.measured)); };
  if (!controller.is_predictor) hear();
  answer.x = as_doubles(emitted.estimate());
  if (controller.has.regulator) {
    answer.events |= emitted.control(u);
    answer.u = as_doubles(u);
  } else {
    u = numbers_of<S>(told.further);
  }
  if (controller.is_predictor) hear();
  answer.events |= emitted.predict(u);
  return answer;
}

template <class S>
Answer take_sample(const Controller& controller, EmittedForm<S>& emitted, const Told& told) {
  Answer answer;
  Vector<S> u;
  const Vector<S> y = numbers_of<S>(told.measured);
  answer.events = emitted.control(controller.is_predictor ? Vector<S>() : y, u);
  answer.u = as_doubles(u);
  answer.x = as_doubles(emitted.estimate());
  answer.events |= emitted.advance(y);
  return answer;
}

template <class Emitted>
std::string serve(const Controller& controller, Emitted emitted, std::istream& in, std::ostream& out) {
  const Shape shape(controller);
  std::string line, why;
  for (unsigned long number = 1; out && std::getline(in, line); ++number) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (line == "reset") {
      emitted.init();
      continue;
    }
    std::optional<Told> told = told_by(line, shape, why);
    if (!told) return "line " + std::to_string(number) + ": " + why;
    told->measured = in_target(controller.target, told->measured);
    told->further = in_target(controller.target, told->further);
    write_answer(out, take_sample(controller, emitted, *told));
  }
  return "";
}

}  // namespace

std::string run(const Controller& controller, std::istream& in, std::ostream& out) {
  return simulate::with_scalar_of(controller.target, [&](auto zero) {
    using S = decltype(zero);
    const auto constants = simulate::constants_of<S>(controller.target);
    return controller.linear ? serve(controller, EmittedForm<S>(controller, constants), in, out)
                             : serve(controller, EmittedController<S>(controller, constants), in, out);
  });
}

}  // namespace lqg::commands
