// SPDX-License-Identifier: MIT
#include "emit/c/templates.hpp"

#include "emit/text/wording.hpp"

namespace lqg::emit {

namespace {

Conditions common_conditions(const Controller& controller) {
  return {{"has.filter", controller.has.filter},
          {"has.regulator", controller.has.regulator},
          {"has.variance", controller.has.variance},
          {"has.gate", controller.has.gate},
          {"has.range", controller.has.range},
          {"has.feedthrough", controller.has.feedthrough},
          {"has.servo", controller.has.servo},
          {"keeps.any", controller.keeps.any},
          {"keeps.sample", controller.keeps.sample},
          {"keeps.gain_row", controller.keeps.gain_row},
          {"keeps.innovation", controller.keeps.innovation},
          {"size.nu", controller.size.nu > 0},
          {"size.nr", controller.size.nr > 0},
          {"size.nxi", controller.size.nxi > 0},
          {"is_predictor", controller.is_predictor},
          {"is_of_given_order", controller.solution.compensator.has_value()},
          {"carries_covariance", carries_covariance(controller)},
          {"is_steady", controller.filter == step::Filter::steady},
          {"has_law_table", has_law_table(controller)},
          {"point.x", controller.point.x.size() > 0},
          {"point.u", controller.point.u.size() > 0},
          {"point.y", controller.point.y.size() > 0},
          {"point.r", controller.point.r.size() > 0}};
}

}  // namespace

std::string write_body(const char* text, const Controller& controller, Words words, Conditions conditions) {
  words.merge(common_words(controller));
  conditions.merge(common_conditions(controller));
  return fill(keep_lines(text, conditions), words);
}

std::string write_function(const char* text, const Controller& controller, Words words, Conditions conditions) {
  return "\n" + write_body(text, controller, std::move(words), std::move(conditions));
}

}  // namespace lqg::emit
