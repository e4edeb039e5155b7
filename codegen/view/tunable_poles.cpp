// SPDX-License-Identifier: MIT
#include "view/tunable_poles.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace lqg::view {

namespace {

constexpr double near_circle = 0.999;  // the largest part of a pole in z

struct Table {
  const char* key;
  const char* words;
  bool is_continuous;
};

const Table tables[] = {
    {"pole_placement.poles", "Poles of the regulator in z", false},
    {"pole_placement.continuous_poles", "Poles of the regulator in s", true},
    {"observer.poles", "Poles of the observer in z", false},
    {"observer.continuous_poles", "Poles of the observer in s", true},
};

struct PlacedPole {
  std::string real_key, imaginary_key;  // the latter is empty for a plain number
  double real = 0, imaginary = 0;
  bool is_taken = false;
};

// "observer.poles[2]", or "observer.poles[2][0]" and "observer.poles[2][1]".
std::vector<PlacedPole> poles_of(const std::string& table, const std::vector<input::PlacedNumber>& numbers) {
  std::map<std::size_t, PlacedPole> poles;
  for (const input::PlacedNumber& number : numbers) {
    if (number.key.rfind(table + "[", 0) != 0) continue;
    const std::string rest = number.key.substr(table.size() + 1);
    PlacedPole& pole = poles[static_cast<std::size_t>(std::stoul(rest))];
    const bool is_imaginary = rest.find("][1]") != rest.npos;
    (is_imaginary ? pole.imaginary_key : pole.real_key) = number.key;
    (is_imaginary ? pole.imaginary : pole.real) = number.value;
  }
  std::vector<PlacedPole> list;
  for (const auto& [index, pole] : poles) list.push_back(pole);
  return list;
}

Tunable part(const Table& table, const std::string& name, double value, std::vector<Target> targets) {
  Tunable tunable;
  tunable.group = std::string(table.words) + ", " + table.key;
  tunable.name = name;
  tunable.unit = table.is_continuous ? "1/s" : "";
  tunable.targets = std::move(targets);
  tunable.value = value;
  if (table.is_continuous) {
    const double far = value != 0 ? 4 * value : 1;
    tunable.low = std::min(0.0, far);
    tunable.high = std::max(0.0, far);
  } else {
    tunable.low = std::min(-near_circle, value);
    tunable.high = std::max(near_circle, value);
  }
  return tunable;
}

void add_pair(const Table& table, const PlacedPole& pole, const PlacedPole& other, const std::string& number,
              std::vector<Tunable>& result) {
  result.push_back(part(table, "real part of " + number, pole.real, {{pole.real_key, 1}, {other.real_key, 1}}));
  Tunable imaginary =
      part(table, "imaginary part of " + number, pole.imaginary, {{pole.imaginary_key, 1}, {other.imaginary_key, -1}});
  imaginary.low = 0;
  result.push_back(imaginary);
}

void add_table(const Table& table, const std::vector<input::PlacedNumber>& numbers, std::vector<Tunable>& result) {
  std::vector<PlacedPole> poles = poles_of(table.key, numbers);
  for (std::size_t i = 0; i < poles.size(); ++i) {
    PlacedPole& pole = poles[i];
    const std::string number = "pole " + std::to_string(i);
    if (pole.imaginary == 0) result.push_back(part(table, number, pole.real, {{pole.real_key, 1}}));
    if (pole.imaginary <= 0) continue;
    const auto other = std::find_if(poles.begin(), poles.end(), [&](const PlacedPole& candidate) {
      return !candidate.is_taken && candidate.real == pole.real && candidate.imaginary == -pole.imaginary;
    });
    if (other == poles.end()) continue;
    other->is_taken = true;
    add_pair(table, pole, *other, number, result);
  }
}

}  // namespace

std::vector<Tunable> tunable_poles(const std::vector<input::PlacedNumber>& numbers) {
  std::vector<Tunable> result;
  for (const Table& table : tables) add_table(table, numbers, result);
  return result;
}

}  // namespace lqg::view
