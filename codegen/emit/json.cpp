#include "emit/json.hpp"

#include <nlohmann/json.hpp>

#include "emit/preamble.hpp"
#include "emit/rounding.hpp"
#include "emit/text.hpp"

namespace lqg::emit {

namespace {

using Json = nlohmann::ordered_json;

Json rows(const design::RealMatrix& matrix) {
  Json out = Json::array();
  for (int i = 0; i < matrix.rows(); ++i) {
    Json row = Json::array();
    for (int j = 0; j < matrix.cols(); ++j) row.push_back(design::to_double(matrix(i, j)));
    out.push_back(std::move(row));
  }
  return out;
}

Json poles(const design::Poles& poles) {
  Json out = Json::array();
  for (const std::complex<double>& pole : poles) out.push_back({pole.real(), pole.imag()});
  return out;
}

Json names(const std::vector<design::Signal>& signals) {
  Json out = Json::array();
  for (const design::Signal& signal : signals)
    out.push_back(signal.unit.empty() ? signal.name : signal.name + " [" + signal.unit + "]");
  return out;
}

Json plant(const Controller& controller) {
  const design::SampledPlant& sampled = controller.solution.plant;
  const design::Plant& stated = controller.problem.plant;
  return {{"domain", stated.domain == design::Domain::continuous ? "continuous" : "discrete"},
          {"sample_time", stated.sample_time},
          {"A", rows(sampled.A)},
          {"B", rows(sampled.B)},
          {"C", rows(sampled.C)},
          {"D", rows(sampled.D)},
          {"G", rows(sampled.G)},
          {"states", names(stated.states)},
          {"inputs", names(stated.inputs)},
          {"outputs", names(stated.outputs)}};
}

Json kalman(const Controller& controller) {
  const design::EstimatorSolution& estimator = *controller.solution.estimator;
  return {{"form", controller.is_predictor() ? "predictor" : "filter"},
          {"L", rows(estimator.L)},
          {"L_predictor", rows(estimator.L_predictor)},
          {"P_prior", rows(estimator.P_prior)},
          {"P_posterior", rows(estimator.P_posterior)},
          {"S", rows(estimator.S)},
          {"poles", poles(estimator.poles)}};
}

Json loop(const design::LoopSolution& solution) {
  Json out = {{"poles", poles(solution.poles)}};
  const auto add = [&](const char* key, const std::optional<double>& value) {
    if (value) out[key] = *value;
  };
  add("gain_margin_dB", solution.at_input.gain_dB);
  add("phase_margin_deg", solution.at_input.phase_deg);
  add("disk_margin", solution.at_input.disk);
  add("cost_per_sample", solution.cost_per_sample);
  add("cost_per_second", solution.cost_per_second);
  return out;
}

Json code(const Controller& controller) {
  return {{"real", controller.is_double() ? "double" : "float"},
          {"arithmetic", controller.is_fused() ? "fused" : "plain"},
          {"style", controller.style == design::Style::compact ? "compact" : "unrolled"},
          {"flash", controller.figures.flash},
          {"ram", controller.figures.ram},
          {"stack", controller.figures.stack},
          {"multiply_adds", controller.figures.multiply_adds}};
}

}  // namespace

std::string json(const Controller& controller) {
  const design::Solution& solution = controller.solution;
  Json out = {{"name", controller.problem.name},
              {"brief", controller.problem.brief},
              {"lqgen", version()},
              {"design_file", {{"name", controller.source.file}, {"sha256", controller.source.sha256}}},
              {"plant", plant(controller)}};
  if (solution.estimator) {
    const design::SampledNoise& noise = solution.estimator->noise;
    out["noise"] = {{"W", rows(noise.W)}, {"V", rows(noise.V)}, {"cross", rows(noise.Swv)}};
  }
  if (solution.regulator) {
    const design::RegulatorSolution& regulator = *solution.regulator;
    out["cost"] = {{"Q", rows(regulator.cost.Q)}, {"R", rows(regulator.cost.R)}, {"N", rows(regulator.cost.N)}};
    out["lqr"] = {{"K", rows(regulator.K)}, {"X", rows(regulator.X)}, {"poles", poles(regulator.poles)}};
  }
  if (solution.estimator) out["kalman"] = kalman(controller);
  out["loop"] = loop(solution.loop);
  out["numerics"] = {{"digits", solution.numerics.digits}, {"condition", solution.numerics.condition}};
  out["code"] = code(controller);
  return out.dump(2) + "\n";
}

}  // namespace lqg::emit
