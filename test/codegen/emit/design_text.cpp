// SPDX-License-Identifier: MIT
#include "design/solve.hpp"
#include "emit/plan/plan.hpp"
#include "design_text.hpp"

#include <Eigen/Eigenvalues>
#include <charconv>

#include <unity.h>

#include "emit/text/sha256.hpp"
#include "input/design_file.hpp"

namespace lqg_test {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

std::string number(double value) {
  char text[40];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

template <class Values>
std::string row(const Values& values) {
  std::string out;
  for (Eigen::Index i = 0; i < values.size(); ++i) out += (i ? ", " : "") + number(values(i));
  return "[" + out + "]";
}

std::string matrix(const char* key, const MatrixXd& value) {
  if (value.size() == 0) return "";
  std::string out;
  for (Eigen::Index i = 0; i < value.rows(); ++i) out += (i ? ", " : "") + row(value.row(i));
  return std::string(key) + " = [" + out + "]\n";
}

std::string vector(const char* key, const MatrixXd& value) {
  return value.size() == 0 ? "" : std::string(key) + " = " + row(value.reshaped()) + "\n";
}

std::string word(const char* key, const std::string& value) {
  return value.empty() ? "" : std::string(key) + " = \"" + value + "\"\n";
}

std::string names(const char* key, const std::string& list) {
  return list.empty() ? "" : std::string(key) + " = " + list + "\n";
}

MatrixXd random_matrix(Random& random, int rows, int columns) {
  MatrixXd out(rows, columns);
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j) out(i, j) = random.one_in(4) ? 0 : random.uniform();
  return out;
}

// Positive definite, its condition not too bad.
MatrixXd random_weight(Random& random, int size) {
  const MatrixXd F = random_matrix(random, size, size);
  const MatrixXd weight = F * F.transpose() + 0.3 * MatrixXd::Identity(size, size);
  return (weight + weight.transpose()) / 2;
}

// Poles a little outside of the circle or the left half plane at most, coupled with each other.
MatrixXd random_dynamics(Random& random, int nx, bool is_discrete) {
  const MatrixXd A = random_matrix(random, nx, nx);
  const auto poles = A.eigenvalues().eval();
  const double wanted = 0.8 + 0.25 * random.uniform();
  if (is_discrete) return A * (wanted / std::max(poles.cwiseAbs().maxCoeff(), 0.1));
  return 2 * (A - (poles.real().maxCoeff() + wanted - 1.05) * MatrixXd::Identity(nx, nx));
}

void add_estimator(Random& random, int nx, int ny, bool is_discrete, DesignText& design) {
  const int nw = random.between(1, nx);
  design.G = random_matrix(random, nx, nw) + MatrixXd::Identity(nx, nw);
  const MatrixXd joint = 0.01 * random_weight(random, nw + ny);
  design.W = joint.topLeftCorner(nw, nw);
  design.V = joint.bottomRightCorner(ny, ny);
  if (random.one_in(2))
    design.V = MatrixXd(design.V.diagonal().asDiagonal());
  else if (random.one_in(2))
    design.Swv = joint.topRightCorner(nw, ny);
  if (!is_discrete && random.one_in(2)) design.noise = "discrete";
  design.gain = random.one_in(3) ? "steady" : "online";
  design.form = random.one_in(2) ? "filter" : "predictor";
  if (design.gain == "online") design.covariance = random.one_in(2) ? "ud" : "plain";
  if (random.one_in(2)) design.x0 = random_matrix(random, nx, 1);
  if (random.one_in(2)) design.P0 = random_weight(random, nx);
}

void add_regulator(Random& random, int nx, int nu, bool is_discrete, DesignText& design) {
  const MatrixXd joint = random_weight(random, nx + nu);
  design.Q = joint.topLeftCorner(nx, nx);
  design.R = joint.bottomRightCorner(nu, nu);
  if (random.one_in(3)) design.N = joint.topRightCorner(nx, nu);
  const char* const costs[] = {"sampled", "discrete", "continuous"};
  if (!is_discrete) design.cost = costs[random.below(3)];
  if (random.one_in(3)) design.u_max = VectorXd::Constant(nu, 2);
  if (random.one_in(3)) design.u_min = VectorXd::Constant(nu, -2.5);
}

}  // namespace

std::string toml(const DesignText& design) {
  std::string out = word("name", design.name) + word("brief", design.brief) + "[plant]\n" +
                    word("domain", design.domain) + "sample_time = " + number(design.sample_time) + "\n" +
                    matrix("A", design.A) + matrix("B", design.B) + matrix("C", design.C) + matrix("D", design.D) +
                    matrix("G", design.G) + names("states", design.states) + names("inputs", design.inputs) +
                    names("outputs", design.outputs);
  if (design.Q.size())
    out +=
        "[lqr]\n" + matrix("Q", design.Q) + matrix("R", design.R) + matrix("N", design.N) + word("cost", design.cost);
  if (design.W.size())
    out += "[kalman]\n" + matrix("process_noise", design.W) + matrix("measurement_noise", design.V) +
           matrix("cross_noise", design.Swv) + matrix("initial_covariance", design.P0) +
           vector("initial_state", design.x0) + word("noise", design.noise) + word("gain", design.gain) +
           word("form", design.form) + word("covariance", design.covariance);
  if (design.u_min.size() + design.u_max.size())
    out += "[limits]\n" + vector("u_min", design.u_min) + vector("u_max", design.u_max);
  return out + "[code]\nflash = 1000000\nupdates = \"each\"\n" + word("real", design.real) +
         word("arithmetic", design.arithmetic) + word("style", design.style);
}

lqg::emit::Controller controller_of(const std::string& text) {
  const lqg::input::DesignFile file = lqg::input::parse_design(text);
  std::string complaints;
  const auto complain = [&](const lqg::design::Findings& findings) {
    for (const lqg::design::Finding& finding : findings) complaints += finding.key + ": " + finding.message + "\n";
  };
  complain(file.findings);
  if (!file.problem) TEST_FAIL_MESSAGE((complaints + text).c_str());
  lqg::design::Findings findings;
  auto solution = lqg::design::solve(*file.problem, findings);
  complain(findings);
  if (!solution) TEST_FAIL_MESSAGE((complaints + text).c_str());
  auto controller = lqg::emit::make_controller(*file.problem, *solution,
                                               {file.problem->name + ".toml", lqg::emit::sha256(text)}, findings);
  if (!controller) TEST_FAIL_MESSAGE((complaints + text).c_str());
  return *controller;
}

DesignText double_integrators(int count) {
  DesignText design;
  const auto repeat = [&](const MatrixXd& one) {
    MatrixXd all = MatrixXd::Zero(one.rows() * count, one.cols() * count);
    for (int i = 0; i < count; ++i) all.block(i * one.rows(), i * one.cols(), one.rows(), one.cols()) = one;
    return all;
  };
  const double T = design.sample_time;
  design.A = repeat((MatrixXd(2, 2) << 1, T, 0, 1).finished());
  design.B = design.G = repeat((MatrixXd(2, 1) << T * T / 2, T).finished());
  design.C = repeat((MatrixXd(1, 2) << 1, 0).finished());
  design.Q = repeat((MatrixXd(2, 2) << 1, 0, 0, 0.5).finished());
  design.R = repeat((MatrixXd(1, 1) << 0.1).finished());
  design.W = repeat((MatrixXd(1, 1) << 0.2).finished());
  design.V = repeat((MatrixXd(1, 1) << 0.01).finished());
  return design;
}

DesignText double_integrator() {
  DesignText design = double_integrators(1);
  design.states = R"(["position [m]", "speed [m/s]"])";
  design.inputs = R"(["force [N]"])";
  design.outputs = R"(["position [m]"])";
  return design;
}

DesignText random_design(Random& random, int nx) {
  DesignText design;
  const int nu = random.between(1, 3), ny = random.between(1, 3);
  const bool is_discrete = random.one_in(2);
  design.domain = is_discrete ? "discrete" : "continuous";
  design.A = random_dynamics(random, nx, is_discrete);
  design.B = random_matrix(random, nx, nu) + MatrixXd::Identity(nx, nu);
  design.C = random_matrix(random, ny, nx) + MatrixXd::Identity(ny, nx);
  if (random.one_in(3)) design.D = random_matrix(random, ny, nu);
  add_estimator(random, nx, ny, is_discrete, design);
  add_regulator(random, nx, nu, is_discrete, design);
  design.real = random.one_in(2) ? "float" : "double";
  design.arithmetic = random.one_in(2) ? "plain" : "fused";
  return design;
}

}  // namespace lqg_test
