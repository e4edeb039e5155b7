// SPDX-License-Identifier: MIT
#include "commands/orders.hpp"

#include <cstdio>

namespace lqg::commands {

namespace {

std::string formatted(const char* format, double value) {
  char text[40];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

std::string padded_left(const std::string& text, std::size_t width) {
  return std::string(width > text.size() ? width - text.size() : 0, ' ') + text;
}

std::string line_of(const design::CostOfOrder& of, const std::optional<double>& full) {
  std::string out = padded_left(std::to_string(of.order), 5);
  if (!of.cost) return out + "  none found that stabilises the plant\n";
  out += padded_left(formatted("%.6g", *of.cost), 14);
  out += padded_left(full && *full > 0 ? formatted("%.2f %%", 100 * (*of.cost / *full - 1)) : "-", 14);
  out += padded_left(std::to_string(of.reached) + " of " + std::to_string(of.starts), 12);
  return out + (of.is_unstable ? "  unstable by itself\n" : "\n");
}

}  // namespace

std::string table_of_orders(const design::CostsOfOrders& orders) {
  std::string out = "order" + padded_left(orders.is_per_second ? "cost a second" : "cost a sample", 14) +
                    padded_left("above full", 14) + padded_left("starts", 12) + "\n";
  for (const design::CostOfOrder& of : orders.costs) out += line_of(of, orders.costs.back().cost);
  return out;
}

}  // namespace lqg::commands
