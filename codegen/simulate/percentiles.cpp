// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>

#include "simulate/monte_carlo.hpp"

namespace lqg::simulate {

double percentile(std::vector<double> values, double percent) {
  if (values.empty()) return 0;
  const double rank = std::ceil(percent / 100 * static_cast<double>(values.size()));
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(std::max(1.0, rank)) - 1;
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

ScenarioNumbers percentile_numbers(const MonteCarlo& result, double percent) {
  // A run that was lost may have fewer answers than others.
  ScenarioNumbers out =
      *std::max_element(result.numbers.begin(), result.numbers.end(),
                        [](const auto& a, const auto& b) { return a.answers.size() < b.answers.size(); });
  const auto of_all = [&](auto number) {
    std::vector<double> values;
    for (const ScenarioNumbers& numbers : result.numbers) values.push_back(number(numbers));
    return percentile(std::move(values), percent);
  };
  const auto each = [&](auto member) {
    auto& values = out.*member;
    for (std::size_t i = 0; i < values.size(); ++i)
      values[i] = static_cast<std::decay_t<decltype(values[i])>>(
          of_all([&](const ScenarioNumbers& numbers) { return static_cast<double>((numbers.*member)[i]); }));
  };
  using Numbers = ScenarioNumbers;
  for (const auto member : {&Numbers::rms_x, &Numbers::peak_x, &Numbers::rms_u, &Numbers::peak_u, &Numbers::rms_y,
                            &Numbers::peak_y, &Numbers::share_at_limits})
    each(member);
  each(&Numbers::left_out);
  for (const auto member : {&Numbers::resets, &Numbers::covariance_resets})
    out.*member = static_cast<unsigned long>(
        of_all([&](const Numbers& numbers) { return static_cast<double>(numbers.*member); }));
  out.cost = of_all([](const Numbers& numbers) { return numbers.cost; });
  constexpr double never = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < out.answers.size(); ++i) {
    const auto time = [&](std::optional<double> StepAnswer::* member) {
      const double found = of_all([&](const Numbers& numbers) {
        return i < numbers.answers.size() ? (numbers.answers[i].*member).value_or(never) : never;
      });
      return std::isfinite(found) ? std::optional(found) : std::nullopt;
    };
    out.answers[i].rise_time = time(&StepAnswer::rise_time);
    out.answers[i].settling_time = time(&StepAnswer::settling_time);
    out.answers[i].overshoot = of_all(
        [&](const Numbers& numbers) { return i < numbers.answers.size() ? numbers.answers[i].overshoot : never; });
  }
  out.has_diverged = of_all([](const Numbers& numbers) { return numbers.has_diverged ? 1.0 : 0.0; }) > 0;
  return out;
}

}  // namespace lqg::simulate
