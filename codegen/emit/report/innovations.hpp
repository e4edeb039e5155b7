// SPDX-License-Identifier: MIT
// What the innovations of a run with noise tell of the filter.
#pragma once

#include "emit/report/scenario_view.hpp"

namespace lqg::emit {

// Of the first run that has noise and innovations: NIS, with the band that 95 % of the samples are in where the filter
// is right; the correlation of the innovations with those before, which is 0 then; a table of the shares. Nothing
// without such a run.
void add_innovations(const Controller& controller, const std::vector<ShownRun>& runs, PageView& view);

// Correlation of a signal with itself so many samples later, lag 0 to `most`; values that are not finite are left out.
std::vector<double> autocorrelation(const std::vector<double>& signal, std::size_t most);

// The value that a sum of `degrees` squares of normal numbers exceeds with this probability; 0 without
// degrees.
double chi_squared(int degrees, double probability);

}  // namespace lqg::emit
