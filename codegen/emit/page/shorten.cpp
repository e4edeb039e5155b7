// SPDX-License-Identifier: MIT
#include <algorithm>

#include "emit/page/page.hpp"

namespace lqg::emit {

namespace {

template <class Visit>
void each_chart(PageData& data, Visit visit) {
  for (PageSection& section : data.sections)
    for (PageView& view : section.views)
      for (Chart& chart : view.charts) visit(chart);
}

std::size_t points_with(PageData& data, std::size_t most) {
  std::size_t count = 0;
  each_chart(data, [&](const Chart& chart) {
    for (const Curve& curve : chart.curves) count += std::min(curve.x.size(), most);
    for (const Band& band : chart.bands) count += 2 * std::min(band.x.size(), most);
  });
  return count;
}

}  // namespace

void shorten(PageData& data, std::size_t points) {
  std::size_t most = 1500;
  while (most > 150 && points_with(data, most) > points) most = most * 4 / 5;
  each_chart(data, [&](Chart& chart) {
    for (Curve& curve : chart.curves) curve = reduced(curve, most);
    for (Band& band : chart.bands) band = reduced(band, most);
  });
}

}  // namespace lqg::emit
