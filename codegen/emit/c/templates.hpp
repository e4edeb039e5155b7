// SPDX-License-Identifier: MIT
// The emitted functions as they stand in templates/*.c.in: with {words} to fill in, and lines that only some
// controllers have behind a mark, "//? condition".
#pragma once

#include "emit/controller.hpp"
#include "emit/text/text.hpp"

namespace lqg::emit {

namespace templates {

extern const char init[], reset[], recover[], weigh[], update[], update_alone[], partial_update[], innovation[],
    control[], law[], predict[], step[], covariance[], covariance_in_loops[], estimate[], set_state[], set_input[];
extern const char linear_filter_form[], linear_predictor_form[], linear_state[], batch[];

// Bodies, and parts of them.
extern const char initial_state[], counters[], recover_body[], weigh_body[], step_calls[], foreseeing_control[];
extern const char compact_init[], compact_update[], compact_update_alone[], compact_predict[], compact_control[],
    compact_law[], compact_act[], compact_recover[], compact_filter_of_sample[], compact_law_of_sample[];
extern const char shared_project[], shared_use[], shared_correct[], shared_column[], shared_correct_in_loops[],
    shared_project_in_loops[], shared_rows[], shared_predict_covariance[], shared_update[], shared_observation[];
extern const char products_add_rows[], products_innovate[], products_update[];

}  // namespace templates

// The template with its lines chosen and its places filled, by common_words, what most templates ask for ("has.filter",
// "keeps.sample", "size.nu" (is not 0) … as in Controller), and by these.
std::string write_body(const char* text, const Controller& controller, Words words, Conditions conditions = {});

// The same behind an empty line.
std::string write_function(const char* text, const Controller& controller, Words words, Conditions conditions = {});

}  // namespace lqg::emit
