// SPDX-License-Identifier: MIT
// One solved design as it is emitted: data only, in the target's terms. `controller_of` makes it.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "controller/bounds.hpp"
#include "controller/gate.hpp"
#include "controller/recovery.hpp"
#include "controller/worth.hpp"
#include "design/finding.hpp"
#include "design/linear_form.hpp"
#include "design/modal_plant.hpp"
#include "design/solution.hpp"
#include "step/model.hpp"

namespace lqg::controller {

struct Source {
  std::string file;    // without its folder
  std::string sha256;  // of its bytes
};

// The numbers of the target, and how it multiplies and adds.
struct Target {
  bool is_double = false;
  bool is_fused = false;
  bool is_prover = false;  // who reads the code, beside a compiler
  bool is_lane = false;    // one of many instances side by side
};

struct Dimensions {
  int nx = 0;       // states, the inputs on their way among them
  int nu = 0;       // inputs
  int ny = 0;       // outputs that the filter is told; 0 without a filter
  int nr = 0;       // references
  int nxi = 0;      // ξ, integrals
  int nz = 0;       // numbers that a linear form keeps in place of x̂
  int delayed = 0;  // inputs on their way: the last of the states
};

// Which terms the equations of a sample have.
struct Terms {
  bool filter = false, regulator = false;
  bool feedthrough = false;  // D u needs the last input in every update
  bool gate = false;
  bool range = false;         // of what a sensor can say
  bool variance = false;      // of the innovations
  bool stages = false;        // the filter is told of changes of the plant
  bool input_change = false;  // the law gives u[k] − u[k−1]
  bool rate_limit = false;
  bool last_input = false;  // the law begins with u[k−1]
  bool servo = false;       // the law is more than −K x̂ within limits
  bool foresight = false;   // of limits: u is optimal, not only clipped
};

// What is kept from one call to the next beside x̂ and its covariance.
struct Memory {
  bool any = false;         // or x̂: there is a state
  bool input = false;       // that acts
  bool innovation = false;  // predict needs the last outputs: w and v are correlated
  bool sample = false;      // its number chooses the law's gains, or the stage
  bool gain_row = false;    // which of the filter's gains is in force
};

// What the caller's numbers are where those of the controller, which are deviations from it, are 0: the operating point
// in the target's numbers. Each part is empty where all of it is 0.
struct Point {
  Eigen::VectorXd x, u, y, r;  // nx, nu, ny, nr
};

// The gains of one sample: of a law {K, Nbar, H, H_input}, of a filter with given gains {L, M, variances of the
// innovations if a gate needs them}.
using Gains = std::vector<design::RealMatrix>;

struct CoreInstructions {
  std::string core;  // by the name of its port: "cortex-m4f"
  long instructions = 0;
};

// What the emitted code costs. Multiply-adds and RAM are exact; flash and stack are estimates for a Cortex-M4F at -O2,
// so are the instructions for the cores that are named.
struct CodeCost {
  long multiply_adds = 0;   // in one sample: update, control, predict; a lone add, multiply or division counts as one
  long ram = 0;             // bytes of the state
  long flash = 0;           // bytes of code and constants
  long stack = 0;           // bytes of the deepest function
  long values_at_once = 0;  // the most in use at once in a function of every sample; of straight-line code
  std::vector<CoreInstructions> instructions;  // of an ordinary sample; empty where they are not estimated
};

// What each form that the design can have costs and loses, when it asks for another than the physical one.
struct FormCost {
  long multiply_adds = 0;     // in one sample, of straight-line code
  double rounding_error = 0;  // for the same y: rms of the error in the target's numbers / rms, of the worst input u;
                              // where the filter carries P of the worst input or estimate
  std::optional<double> share_of_deviation = {};  // where the filter carries P: rms of the error of the worst estimate
                                                  // in parts of its standard deviation
  double agreement = 0;  // digits in which another form answers outputs as the physical form does
};
struct FormChoice {
  design::Realisation chosen = design::Realisation::physical;
  FormCost physical;
  std::optional<FormCost> folded, modal;
};

// What straight-line code has once, and not again and again: nothing; of a filter that carries P the functions over P
// that all outputs need, or also those over A, which run over the columns of P, or these with loops over the entries of
// P in all that outputs need; of one with a constant gain the loops of its products with dense matrices.
enum class Sharing { nothing, outputs, columns, entries, products };

// How often a sample may change the set of active limits, and where that number is from.
struct Iterations {
  enum class Origin { none, file, certified, cap } origin = Origin::none;
  unsigned most = 0;
  double tie_distance = 0;  // certified: for states as far as those of `worth` went, but for those nearer than this
                            // share of it to a tie of two decisions
};

struct Controller {
  design::Problem problem;
  design::Solution solution;
  Source source;
  Target target;
  step::Filter filter = step::Filter::none;
  bool is_predictor = false;  // u is made before the outputs are there
  Dimensions size;
  Terms has;
  Memory keeps;
  Point point;                            // empty without an operating point
  Eigen::VectorXd x0;                     // nx, with zeros for inputs on their way; empty without a filter
  std::vector<int> integrated;            // the outputs that are integrated, ξ by ξ
  std::vector<int> references;            // the outputs that r names, rising
  std::vector<std::size_t> stage_starts;  // 0, and the `from` of the stages that the filter is told of
  std::size_t last_sample = 0;            // from here on nothing changes
  std::vector<Gains> laws;     // of sample 0, 1, …; the last one is held. One only: it is constant. Empty: no regulator
  std::vector<Gains> filters;  // likewise; empty without a filter of given gains
  Bounds bounds;
  Gate gate;                                      // empty without one
  Recovery recovery;                              // of a filter
  Iterations iterations;                          // with foresight
  std::optional<Worth> worth;                     // with foresight
  std::optional<design::LinearForm> linear;       // the controller keeps z of this form; else it keeps x̂
  std::optional<design::ModalPlant> modal;        // the filter keeps z, x̂ = T z: laws and bounds are those of z
  std::shared_ptr<const Controller> physical;     // beside `modal`: the same controller, which keeps x̂
  std::optional<FormChoice> forms;                // among which it was chosen
  design::Style style = design::Style::unrolled;  // never automatic
  Sharing sharing = Sharing::nothing;             // of straight-line code
  CodeCost cost;
};

// The physical form, which keeps x̂, with its bounds; straight-line code, whose cost is not counted yet. Findings: what
// the engine can design and the target cannot have, a start that the bounds would not let be.
std::optional<Controller> controller_of(design::Problem problem, design::Solution solution, Source source,
                                        design::Findings& findings);

// The same controller, which keeps z of `form`. Its bounds are gone: they are of x̂; z has to be finite.
Controller with_form(Controller controller, const design::LinearForm& form);

// The same controller, whose filter keeps z of `modal`. None, with a finding at code.realisation, where its start is
// beyond what the bounds can be.
std::optional<Controller> with_modes(Controller controller, const design::ModalPlant& modal,
                                     design::Findings& findings);

// What the form that the controller keeps costs and loses.
const FormCost& chosen_form(const FormChoice& forms);

// "folded"
std::string name_of(design::Realisation realisation);

// P is carried along.
inline bool carries_covariance(const Controller& controller) {
  return controller.filter == step::Filter::plain || controller.filter == step::Filter::ud;
}

// It is of the plant's equations, linearised at the estimate.
inline bool is_extended(const Controller& controller) {
  return controller.problem.estimator && controller.problem.estimator->extended;
}

// "x", or "z" of a filter that keeps that in its place: the name of it in the header.
inline const char* kept_name(const Controller& controller) { return controller.modal ? "z" : "x"; }

// The law reads a table of gains, row by row.
inline bool has_law_table(const Controller& controller) { return controller.laws.size() > 1; }
// control writes to the state, beside a filter.
inline bool control_changes_state(const Controller& controller) {
  return controller.has.feedthrough || controller.size.nxi > 0;
}
// There is a function for x̂: what is kept in its place is something else.
bool has_estimate(const Controller& controller);
// An input that was set by hand tells the controller something.
bool can_set_input(const Controller& controller);
// No other output is needed to make the noise of this one independent.
bool can_update_alone(const Controller& controller, int output);
// There is a function for it: the design asks for those.
bool has_update_alone(const Controller& controller, int output);

}  // namespace lqg::controller
