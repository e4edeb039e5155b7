// SPDX-License-Identifier: MIT
// Units of measurement: "m/s^2", "N m/A", "kg·m²", "V*s/rad", "µF", "rpm", "%".
//
//     unit   = power { ("*" | "·" | blank | "/") power }      from left to right: m/s/s = m/s²
//     power  = ["√"] atom [ "^2" | "^-1" | "^0.5" | "²" | "⁻¹" | "2" ]
//     atom   = symbol | "1" | "(" unit ")"
//
// Symbols: m, g, s, A, K, mol, rad, N, V, W, ohm (Ω), S, H, F, Hz, J, C, T, Wb, Pa, bar, L, Nm with the prefixes f to T
// of the SI, and deg (°), min, h, rpm, %, °C (degC; of differences), which have none.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>

namespace lqg::expression {

struct Unit {
  std::array<double, 6> powers = {};      // of m, s, kg, A, K and mol; an angle in rad is a pure number
  double decades = 0;                     // the decimal logarithm of its size in these
  std::map<std::string, double> symbols;  // as it was written: {"V", 1}, {"s", −1}
};

// Nothing of what is not understood. "", "1" and "-" are the pure number.
std::optional<Unit> parse_unit(const std::string& text);

Unit operator*(const Unit& a, const Unit& b);
Unit operator/(const Unit& a, const Unit& b);
Unit power(const Unit& unit, double exponent);

// Of the same dimension: both lengths, whether m or mm.
bool is_like(const Unit& a, const Unit& b);
// Of the same dimension and size.
bool is_same(const Unit& a, const Unit& b);
// The pure number 1.
bool is_pure(const Unit& unit);

// "V/s", "N·m/A"; of more than three symbols those of the SI where that is shorter, "1/s²"; "a pure number".
std::string in_words(const Unit& unit);

}  // namespace lqg::expression
