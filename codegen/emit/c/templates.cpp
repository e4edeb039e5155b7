#include "emit/c/templates.hpp"

#include "emit/text/wording.hpp"

namespace lqg::emit {

namespace {

Conditions common_conditions(const Controller& controller) {
  return {{"has.filter", controller.has.filter},
          {"has.regulator", controller.has.regulator},
          {"has.variance", controller.has.variance},
          {"has.gate", controller.has.gate},
          {"keeps.any", controller.keeps.any},
          {"keeps.sample", controller.keeps.sample},
          {"size.nu", controller.size.nu > 0},
          {"size.nr", controller.size.nr > 0},
          {"size.nxi", controller.size.nxi > 0},
          {"is_predictor", controller.is_predictor}};
}

}  // namespace

std::string write_function(const char* text, const Controller& controller, Words words, Conditions conditions) {
  words.merge(common_words(controller));
  conditions.merge(common_conditions(controller));
  return fill(keep_lines(text, conditions), words);
}

}  // namespace lqg::emit
