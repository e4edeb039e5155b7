// One solved design, and how it is to be written.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "design/linear_form.hpp"
#include "design/solution.hpp"
#include "emit/bounds.hpp"
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

// The gains of one sample: of a law {K, Nbar, H}, of a filter with given gains {L, M, variances of the innovations if a
// gate needs them}.
using Gains = std::vector<design::RealMatrix>;

// What each form that the design can have costs and loses, when it asks for another than the physical one.
struct FormFigures {
  long multiply_adds = 0;     // in one sample, of straight-line code
  double rounding_error = 0;  // of u for the same y: rms of the error in the target's numbers / rms of u, the worst input
};
struct Realisations {
  design::Realisation chosen = design::Realisation::physical;
  FormFigures physical;
  std::optional<FormFigures> folded, modal;
};

struct Controller {
  design::Problem problem;
  design::Solution solution;
  Source source;
  design::Style style = design::Style::unrolled;  // never automatic
  Figures figures;
  std::vector<Gains> laws;     // of sample 0, 1, …; the last one is held. One only: it is constant. Empty: no regulator
  std::vector<Gains> filters;  // likewise; empty without a filter of given gains
  Bounds bounds;
  std::optional<design::LinearForm> linear;   // the controller keeps z of this form; else it keeps x̂
  std::optional<Realisations> realisations;   // among which it was chosen

  bool is_double() const { return problem.code.real == design::Scalar::float64; }
  bool is_fused() const { return problem.code.arithmetic == design::Arithmetic::fused; }
  bool has_filter() const { return problem.estimator.has_value(); }
  bool has_regulator() const { return problem.regulator.has_value(); }
  bool is_predictor() const { return has_filter() && problem.estimator->form == design::Form::predictor; }
  step::Filter filter() const;
  bool has_feedthrough() const;   // D u needs the last input in every update
  bool gives_change() const;      // the law gives u[k] − u[k−1]
  bool has_rate_limit() const;
  bool continues() const { return gives_change() || has_rate_limit(); }  // the law begins with the last input
  bool keeps_input() const { return has_feedthrough() || continues(); }
  bool keeps_innovation() const;  // predict needs the last outputs: w and v are correlated
  bool has_stages() const { return has_filter() && !solution.stages.empty(); }  // the plant that is told of changes
  const design::SampledPlant& plant_at(std::size_t sample) const;
  const design::SampledNoise& noise_at(std::size_t sample) const;  // before the first stage: of the filter that is held
  const design::OnlineSolution& online_at(std::size_t sample) const;
  std::vector<std::size_t> stage_starts() const;  // 0, and the `from` of the others
  std::size_t last_sample() const;  // from here on nothing changes
  bool keeps_sample() const { return last_sample() > 0; }  // its number chooses the law's gains, or the stage
  bool has_law_table() const { return laws.size() > 1; }
  bool keeps_gain_row() const { return filters.size() > 1; }
  bool gates() const { return has_filter() && problem.estimator->gate > 0; }
  bool has_variance() const;      // of the innovations
  bool can_update_alone(int output) const;  // no other output is needed to make its noise independent
  const std::vector<int>& integral() const;  // the outputs that are integrated, ξ by ξ
  std::vector<int> references() const;       // the outputs that r names, rising
  int nr() const { return static_cast<int>(references().size()); }
  int nz() const { return linear ? static_cast<int>(linear->A.rows()) : 0; }
  int nxi() const { return static_cast<int>(integral().size()); }
  bool has_servo() const { return nr() > 0 || nxi() > 0 || continues(); }  // the law is more than −K x̂ within limits
  bool has_state() const { return has_filter() || has_servo() || keeps_sample(); }
  bool control_changes_state() const { return has_feedthrough() || nxi() > 0; }  // beside a filter
  bool can_set_input() const { return nu() > 0 && (has_filter() || has_servo()) && (delayed() || keeps_input() || nxi()); }
  Eigen::VectorXd x0() const;  // with zeros for inputs on their way
  int delayed() const { return nx() - static_cast<int>(problem.plant.A.rows()); }  // inputs on their way: the last states
  int nx() const { return static_cast<int>(solution.plant.A.rows()); }
  int nu() const { return static_cast<int>(problem.plant.B.cols()); }
  int ny() const { return has_filter() ? static_cast<int>(problem.plant.C.rows()) : 0; }
};

// Chooses the style and counts what the code costs. Findings: the code does not fit the flash that the design allows.
std::optional<Controller> make_controller(design::Problem problem, design::Solution solution, Source source,
                                          design::Findings& findings);

}  // namespace lqg::emit
