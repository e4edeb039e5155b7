// SPDX-License-Identifier: MIT
// Every matrix, with the names of its rows and columns.
#include "design/sampled/reference.hpp"
#include "emit/report/sections.hpp"
#include "emit/text/wording.hpp"

namespace lqg::emit {

namespace {

using Names = std::vector<std::string>;

// w1, w2 …
Names numbered(const std::string& letter, Eigen::Index count) {
  Names out;
  for (Eigen::Index i = 1; i <= count; ++i) out.push_back(letter + std::to_string(i));
  return out;
}

Names with_prefix(const std::string& prefix, const Names& names) {
  Names out;
  for (const std::string& name : names) out.push_back(prefix + name);
  return out;
}

class Matrices {
 public:
  explicit Matrices(const Controller& controller)
      : is_double_(controller.target.is_double), x_(names_of(state_signals(controller))),
        u_(names_of(controller.problem.plant.inputs)), y_(names_of(controller.problem.plant.outputs)),
        r_(names_of(reference_signals(controller))) {
    Names integrated;
    for (const int output : design::integrated_outputs(controller.problem))
      integrated.push_back(y_[static_cast<std::size_t>(output)]);
    xi_ = with_prefix("∫", integrated);
    z_ = x_;
    z_.insert(z_.end(), xi_.begin(), xi_.end());
    if (controller.has.input_change)
      for (const std::string& name : with_prefix("last ", u_)) z_.push_back(name);
  }

  // Names that do not fit are left out.
  void add(const std::string& name, const std::string& words, const design::RealMatrix& values, const Names& rows,
           const Names& columns) {
    if (values.size() == 0) return;
    const auto fitting = [](const Names& names, Eigen::Index size) {
      return static_cast<Eigen::Index>(names.size()) == size ? names : Names();
    };
    PageMatrix matrix = {name, words, fitting(rows, values.rows()), fitting(columns, values.cols()), {}, is_double_};
    for (Eigen::Index i = 0; i < values.rows(); ++i) {
      matrix.values.emplace_back();
      for (Eigen::Index j = 0; j < values.cols(); ++j) matrix.values.back().push_back(number(values(i, j), is_double_));
    }
    all_.push_back(std::move(matrix));
  }

  void add_plant(const Controller& controller) {
    const design::SampledPlant& plant = controller.solution.plant;
    add("A", "of the samples", plant.A, x_, x_);
    add("B", "of the samples", plant.B, x_, u_);
    if (!controller.has.filter) return;
    add("C", "", plant.C, y_, x_);
    add("D", "", plant.D, y_, u_);
    add("G", "how w acts", plant.G, x_, numbered("w", plant.G.cols()));
  }

  void add_weights(const design::SampledCost& cost) {
    add("Q", "of the samples", cost.Q, x_, x_);
    add("R", "of the samples", cost.R, u_, u_);
    add("N", "of the samples", cost.N, x_, u_);
  }

  void add_noises(const design::SampledNoise& noise) {
    const Names w = numbered("w", noise.W.rows());
    add("W", "E[w wᵀ]", noise.W, w, w);
    add("V", "E[v vᵀ]", noise.V, y_, y_);
    add("Swv", "E[w vᵀ]", noise.Swv, w, y_);
  }

  void add_compensator(const Controller& controller) {
    const design::CompensatorSolution& own = *controller.solution.compensator;
    const design::LinearForm& form = *controller.linear;
    const Names z = numbered("z", form.A.rows());
    add("A of z", "z⁺ = A z + B y", form.A, z, z);
    add("B of y", "z⁺ = A z + B y", form.B, z, y_);
    add("C of z", "u = C z + D y", form.C, u_, z);
    if (!controller.is_predictor) add("D of y", "u = C z + D y", form.D, u_, y_);
    add("T", "x̂ before the outputs, T z", form.T, x_, z);
    add("P", "covariance of x − T z", own.P, x_, x_);
    add("A continuous", "ż = A z + B y, z: estimates of states", own.A_continuous, z, z);
    add("B continuous", "likewise", own.B_continuous, z, y_);
    add("C continuous", "u = C z", own.C_continuous, u_, z);
  }

  void add_regulator(const design::RegulatorSolution& regulator) {
    add("K", "gain of the regulator", regulator.K, u_, z_);
    add("Nbar", "gain of the reference", regulator.Nbar, u_, r_);
    add("Gamma", "of ξ + Γ x̂, what the model does not explain", regulator.Gamma, xi_, x_);
    add("H", "of ξ + H (u − v)", regulator.H, xi_, u_);
    add("X", "solution of the Riccati equation", regulator.X, z_, z_);
  }

  void add_estimator(const design::EstimatorSolution& estimator) {
    add("fictitious", "q B Bᵀ at the samples, for the gain alone", estimator.fictitious, x_, x_);
    add("L", "gain of the filter", estimator.L, x_, y_);
    add("L_predictor", "A L + M", estimator.L_predictor, x_, y_);
    add("P_prior", "covariance of the error before the outputs", estimator.P_prior, x_, x_);
    add("P_posterior", "covariance of the error after the outputs", estimator.P_posterior, x_, x_);
    add("S", "covariance of the innovations", estimator.S, y_, y_);
    add("L_continuous", "gain of the continuous equation", estimator.L_continuous, x_, y_);
    add("P_continuous", "covariance of the continuous equation", estimator.P_continuous, x_, x_);
  }

  std::vector<PageMatrix> all() const { return all_; }

 private:
  static Names names_of(const std::vector<design::Signal>& signals) {
    Names out;
    for (const design::Signal& signal : signals) out.push_back(signal.name);
    return out;
  }

  bool is_double_;
  Names x_, u_, y_, r_, xi_, z_;
  std::vector<PageMatrix> all_;
};

// Empty without one.
std::vector<PageTable> point_tables(const Controller& controller) {
  const auto& point = controller.problem.plant.operating_point;
  if (!point) return {};
  PageTable table = {"Operating point, from which x, u and y of the matrices are deviations", {"", "at"}, {}};
  const design::Plant& plant = controller.problem.plant;
  for (const auto& [signals, values] :
       {std::pair(&plant.states, &point->x), {&plant.inputs, &point->u}, {&plant.outputs, &point->y}})
    for (std::size_t i = 0; i < signals->size(); ++i)
      table.rows.push_back(
          {name_with_unit((*signals)[i]), number(design::Real((*values)(static_cast<Eigen::Index>(i))), true)});
  return {table};
}

}  // namespace

PageSection number_section(const Controller& controller) {
  Matrices matrices(controller);
  matrices.add_plant(controller);
  if (controller.solution.regulator) matrices.add_weights(controller.solution.regulator->cost);
  if (controller.solution.estimator) matrices.add_noises(controller.solution.estimator->noise);
  if (controller.solution.compensator) {
    matrices.add_compensator(controller);
  } else {
    if (controller.solution.regulator) matrices.add_regulator(*controller.solution.regulator);
    if (controller.solution.estimator) matrices.add_estimator(*controller.solution.estimator);
  }
  PageView view;
  view.tables = point_tables(controller);
  view.matrices = matrices.all();
  return {"numbers", "Numbers", {view}};
}

}  // namespace lqg::emit
