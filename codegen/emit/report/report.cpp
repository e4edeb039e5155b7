// SPDX-License-Identifier: MIT
#include "emit/report/report.hpp"

#include "emit/report/sections.hpp"

namespace lqg::emit {

std::string with_unit(double value, const std::string& unit) {
  return decimal(value) + (unit.empty() || unit == "°" ? unit : " " + unit);
}

Eigen::MatrixXd in_double(const design::RealMatrix& values) {
  Eigen::MatrixXd out(values.rows(), values.cols());
  for (Eigen::Index i = 0; i < out.rows(); ++i)
    for (Eigen::Index j = 0; j < out.cols(); ++j) out(i, j) = design::to_double(values(i, j));
  return out;
}

std::string drawn_by() {
  return "This file is yours: use it under any licence. The script that draws its charts, Chart.js, has the MIT "
         "licence.";
}

PageData page_data(const Controller& controller, const design::Findings& findings) {
  PageData page;
  add_head(controller, findings, page);
  const Runs runs = runs_to_show(controller);
  for (PageSection& section :
       std::vector<PageSection>{at_work(controller, runs), foresight_section(controller), far_from_trouble(controller),
                                recovery_section(controller), order_section(controller), pole_section(controller),
                                estimator_section(controller, runs), target_section(controller),
                                parameter_section(controller), number_section(controller)})
    if (!section.views.empty()) page.sections.push_back(std::move(section));
  page.footer = drawn_by();
  shorten(page);
  return page;
}

std::string report(const Controller& controller, const design::Findings& findings) {
  return page_html(page_data(controller, findings));
}

}  // namespace lqg::emit
