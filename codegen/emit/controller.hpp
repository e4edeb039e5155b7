// One solved design, and how it is to be written.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "design/solution.hpp"
#include "step/model.hpp"

namespace lqg::emit {

struct Source {
  std::string file;    // without its folder
  std::string sha256;  // of its bytes
};

// What the emitted code costs. Multiply-adds and RAM are exact; flash and stack are estimates for a Cortex-M4F at -O2.
struct Figures {
  long multiply_adds = 0;  // in one sample: update, control, predict; a lone add, multiply or division counts as one
  long ram = 0;            // bytes of the state
  long flash = 0;          // bytes of code and constants
  long stack = 0;          // bytes of the deepest function
};

struct Controller {
  design::Problem problem;
  design::Solution solution;
  Source source;
  design::Style style = design::Style::unrolled;  // never automatic
  Figures figures;

  bool is_double() const { return problem.code.real == design::Scalar::float64; }
  bool is_fused() const { return problem.code.arithmetic == design::Arithmetic::fused; }
  bool has_filter() const { return problem.estimator.has_value(); }
  bool has_regulator() const { return problem.regulator.has_value(); }
  bool is_predictor() const { return has_filter() && problem.estimator->form == design::Form::predictor; }
  step::Filter filter() const;
  bool keeps_input() const;       // D u needs the last input
  bool keeps_innovation() const;  // predict needs the last outputs: w and v are correlated
  int nx() const { return static_cast<int>(problem.plant.A.rows()); }
  int nu() const { return static_cast<int>(problem.plant.B.cols()); }
  int ny() const { return has_filter() ? static_cast<int>(problem.plant.C.rows()) : 0; }
};

// Chooses the style and counts what the code costs. Findings: the code does not fit the flash that the design allows.
std::optional<Controller> make_controller(design::Problem problem, design::Solution solution, Source source,
                                          design::Findings& findings);

}  // namespace lqg::emit
