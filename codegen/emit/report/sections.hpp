// SPDX-License-Identifier: MIT
// The sections of the page, one file each. A section without views is left out.
#pragma once

#include "design/finding.hpp"
#include "emit/controller.hpp"
#include "emit/page/page.hpp"
#include "emit/report/scenario_view.hpp"

namespace lqg::emit {

// Name, verdict, the six figures; of the findings the notes, and as errors what [require] asks for and is missed.
void add_head(const Controller& controller, const design::Findings& findings, PageData& page);

using Runs = std::vector<ShownRun>;
PageSection at_work(const Controller& controller, const Runs& runs);            // what does it do?
PageSection foresight_section(const Controller& controller);                    // what are foreseen limits worth?
PageSection far_from_trouble(const Controller& controller);                     // what may be wrong with the model?
PageSection recovery_section(const Controller& controller);                     // what does robustness cost?
PageSection order_section(const Controller& controller);                        // what is known of the optimum?
PageSection pole_section(const Controller& controller);                         // how fast, how damped?
PageSection estimator_section(const Controller& controller, const Runs& runs);  // does it know what it knows?
PageSection target_section(const Controller& controller);                       // what does it cost?
PageSection parameter_section(const Controller& controller);                    // what hangs on what?
PageSection number_section(const Controller& controller);

// Of a controller with foresight: one or two sentences.
std::string worth_in_words(const Controller& controller);

// Whose poles a person wants to see beside the plant's: regulator and estimator, whose poles are those of the loop,
// else the loop itself.
struct NamedPoles {
  std::string owner;
  design::Poles poles;
};
std::vector<NamedPoles> poles_of_controller(const Controller& controller);

// The poles as the weights on the inputs are scaled over decades; none where the regulator has no steady cost that the
// samples are summed by.
std::vector<Chart> root_locus(const Controller& controller);

// The footer of a page.
std::string drawn_by();

// Of a frequency, a time: "3.21 Hz".
std::string with_unit(double value, const std::string& unit);

Eigen::MatrixXd in_double(const design::RealMatrix& values);

}  // namespace lqg::emit
