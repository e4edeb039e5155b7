// SPDX-License-Identifier: MIT
// Compensators of a given order: derivatives of the cost, optimality, independent references, orders from 0 to full.
#include <cmath>

#include <unity.h>

#include "design/equations/sampling.hpp"
#include "design/order/closed_loop.hpp"
#include "design/rounding.hpp"
#include "order_problems.hpp"

using namespace lqg::design;
using namespace design_test;

namespace {

Real cost_at(const order::LoopFamily<Real>& family, const RealMatrix& column) {
  const order::LoopPoint<Real> point = order::point_at(family, order::unpacked<Real>(family, column));
  TEST_ASSERT_TRUE_MESSAGE(point.is_stable, "the loop is not stable");
  return point.cost;
}

// Differences with steps of 10^−20 in 60 digits miss first derivatives by about 10^−40, second ones by 10^−20.
void expect_derivatives(const OrderProblem& problem, int order, std::uint64_t seed) {
  const order::LoopFamily<Real> family = order::loop_family<Real>(problem, order);
  Random random(seed);
  const Index count = family.free_entries();
  RealMatrix Theta = order::unpacked<Real>(family, real(0.1 * random.matrix(count, 1)));
  if (problem.is_continuous) Theta.bottomRightCorner(order, order) -= identity(order);
  const RealMatrix column = order::packed<Real>(family, Theta);
  const order::LoopPoint<Real> point = order::point_at(family, Theta);
  TEST_ASSERT_TRUE(point.is_stable);
  const RealMatrix g = order::gradient(family, point), H = order::hessian(family, point);
  const Real step = power_of_ten(-20);
  const RealMatrix along = real(random.matrix(count, 1)), aside = real(random.matrix(count, 1));
  const auto moved = [&](int a, int b) { return cost_at(family, column + step * (a * along + b * aside)); };
  const Real slope = (moved(1, 0) - moved(-1, 0)) / (2 * step);
  const Real bend = (moved(1, 1) + moved(-1, -1) - moved(1, -1) - moved(-1, 1)) / (4 * step * step);
  const Real by_gradient = trace_of_product(g.transpose(), along);
  const Real by_hessian = trace_of_product(along.transpose(), multiply(H, aside));
  expect_small(abs(slope - by_gradient), 1e-33 * (1 + std::fabs(to_double(slope))), "the slope's error");
  expect_small(abs(bend - by_hessian), 1e-14 * (1 + std::fabs(to_double(bend))), "the curvature's error");
}

void test_derivatives_are_those_of_differences() {
  const Digits scope(60);
  for (const bool is_continuous : {false, true})
    for (const bool feeds : {false, true})
      for (const bool is_white : {false, true}) {
        if (is_continuous && feeds) continue;
        OrderProblem problem = stable_plant(is_continuous, 3, 2, 2, 5);
        problem.has_feedthrough = feeds;
        if (is_white) add_white_parameters(problem, 7);
        expect_derivatives(problem, 2, 11);
        if (feeds) expect_derivatives(problem, 0, 12);
      }
}

// References: order_reference.py.
struct Reference {
  const char* name;
  OrderProblem problem;
  int order;
  const char *cost, *D, *CB, *CAB;
};

void expect_reference(const Reference& reference) {
  const OrderedCompensator found = best_compensator(reference.problem, reference.order);
  TEST_ASSERT_TRUE_MESSAGE(found.failure == OrderFailure::none, reference.name);
  const auto near = [&](const Real& value, const char* expected) {
    expect_small(abs(value - Real(expected)), 1e-20 * (1 + std::fabs(to_double(value))), reference.name);
  };
  near(found.cost, reference.cost);
  near(found.D(0, 0), reference.D);
  near(multiply(found.C, found.B)(0, 0), reference.CB);
  near(multiply(found.C, multiply(found.A, found.B))(0, 0), reference.CAB);
}

void test_independent_minima_are_found() {
  const Digits scope(60);
  const std::vector<Reference> references = {
      {"third order plant, order 1", third_order_reference(false), 1, "83.96084355357016684923543", "0",
       "0.08521941542764495054658636", "0.04569267159906815131367927"},
      {"third order plant, order 2, feed-through", third_order_reference(true), 2, "41.58724338633374874865707",
       "-0.7954196961437797035575687", "0.6444652998705458577922664", "0.4189161563450251422211464"},
      {"white, order 1", white_reference(false), 1, "73.1540838622830525040466", "0", "0.003110706375342202513746015",
       "0.002870658585909402509182155"},
      {"white, order 1, feed-through", white_reference(true), 1, "21.41487450018938706502728",
       "-0.5997591879286665453672858", "0.3263265409661512927991841", "0.1445511253643966319460778"},
      {"white, order 2", white_reference(false), 2, "27.64828030013075486672998", "0", "-0.5311397422060733105204311",
       "0.2118231127070041984258125"},
      {"continuous, order 1", moving_reference(false), 1, "8.286057615828520903496442", "0",
       "0.3970815305134444793458171", "-0.2602135195468177008975144"},
      {"continuous, white, order 2", moving_reference(true), 2, "7.429028169592464436556838", "0",
       "-0.8799042390995900648251011", "3.510493477658677560375295"},
  };
  for (const Reference& reference : references) expect_reference(reference);
}

// The law of separation from the two Riccati equations.
void test_full_order_is_the_law_of_separation() {
  const Digits scope(60);
  for (const bool is_continuous : {false, true}) {
    const OrderProblem p = stable_plant(is_continuous, 3, 2, 1, 21);
    const auto riccati = is_continuous ? solve_continuous_riccati : solve_discrete_riccati;
    const RealMatrix K = riccati({p.A, p.B, p.Q, p.R, p.N}, RealMatrix()).K;
    const RealMatrix L = riccati({p.A.transpose(), p.C.transpose(), p.W, p.V, p.Swv}, RealMatrix()).K.transpose();
    const OrderedCompensator found = best_compensator(p, 3);
    TEST_ASSERT_TRUE(found.failure == OrderFailure::none);
    const RealMatrix A = p.A - multiply(p.B, K) - multiply(L, p.C);
    expect_small(distance(multiply(found.C, found.B), -multiply(K, L)), 1e-35, "CB");
    expect_small(distance(multiply(found.C, multiply(found.A, found.B)), -multiply(K, multiply(A, L))), 1e-35, "CAB");
  }
}

// With Q = P₁ − Q̂, Q̂ = P₁₂P₂⁻¹P₁₂ᵀ, P = S₁ − P̂, P̂ = S₁₂S₂⁻¹S₁₂ᵀ and the projection τ = −P₁₂P₂⁻¹S₂⁻¹S₁₂ᵀ, without
// cross terms:  Q = AQAᵀ + W − L(V + CQCᵀ)Lᵀ + (I − τ)Z(I − τ)ᵀ, Q̂ = τZτᵀ, Z = (A − BK)Q̂(A − BK)ᵀ + L(V + CQCᵀ)Lᵀ
// with L = AQCᵀ(V + CQCᵀ)⁻¹, K = (R + BᵀPB)⁻¹BᵀPA: D. S. Bernstein, L. D. Davis, D. C. Hyland, "The optimal projection
// equations for reduced-order, discrete-time modelling, estimation and control", Journal of Guidance, Control, and
// Dynamics 9 (1986), 288–293.
void expect_projection_equations(const OrderProblem& p, const OrderedCompensator& c) {
  const Index nx = p.A.rows(), n = nx + c.A.rows();
  const order::LoopFamily<Real> family = order::loop_family<Real>(p, c.A.rows());
  const order::LoopPoint<Real> point = order::point_at(family, above(beside(c.D, c.C), beside(c.B, c.A)));
  const RealMatrix P12 = point.P.topRightCorner(nx, n - nx), S12 = point.S.topRightCorner(nx, n - nx);
  const RealMatrix toward = *solve(point.P.bottomRightCorner(n - nx, n - nx), P12.transpose());
  const RealMatrix dual = *solve(point.S.bottomRightCorner(n - nx, n - nx), S12.transpose());
  const RealMatrix tau = -multiply(transpose_multiply(toward, identity(n - nx)), dual);
  const RealMatrix Qhat = multiply(P12, toward), Phat = multiply(S12, dual);
  const RealMatrix Q = point.P.topLeftCorner(nx, nx) - Qhat, P = point.S.topLeftCorner(nx, nx) - Phat;
  const RealMatrix innovation = p.V + congruence(p.C, Q), weight = p.R + transpose_congruence(p.B, P);
  const RealMatrix L = solve(innovation, multiply(p.C, multiply(Q, p.A.transpose())))->transpose();
  const RealMatrix K = *solve(weight, transpose_multiply(p.B, multiply(P, p.A)));
  const RealMatrix gained = congruence(L, innovation), rest = identity(nx) - tau;
  const RealMatrix Z = congruence(p.A - multiply(p.B, K), Qhat) + gained;
  expect_small(distance(multiply(tau, tau), tau), 1e-33, "the projection");
  expect_small(distance(congruence(tau, Z), Qhat), 1e-33, "the equation of the estimate");
  expect_small(distance(congruence(p.A, Q) + p.W - gained + congruence(rest, Z), Q), 1e-33,
               "the equation of the error");
  const RealMatrix paid = transpose_congruence(K, weight);
  const RealMatrix Zdual = transpose_congruence(p.A - multiply(L, p.C), Phat) + paid;
  expect_small(distance(transpose_congruence(tau, Zdual), Phat), 1e-33, "the dual equation of the estimate");
  expect_small(distance(transpose_congruence(p.A, P) + p.Q - paid + transpose_congruence(rest, Zdual), P), 1e-33,
               "the equation of the control");
}

void test_optimal_projection_equations_hold() {
  const Digits scope(60);
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const OrderProblem problem = stable_plant(false, 4, 1 + static_cast<Index>(seed % 2), 1, seed);
    for (const OrderedCompensator& c : best_compensators(problem, 1, 2)) {
      TEST_ASSERT_TRUE(c.failure == OrderFailure::none);
      expect_projection_equations(problem, c);
    }
  }
}

Real markov_difference(const OrderedCompensator& a, const OrderedCompensator& b) {
  Real largest;
  RealMatrix from_a = a.B, from_b = b.B;
  for (int k = 0; k < 4; ++k) {
    largest = std::max<Real>(largest, distance(multiply(a.C, from_a), multiply(b.C, from_b)));
    from_a = multiply(a.A, from_a);
    from_b = multiply(b.A, from_b);
  }
  return largest;
}

// Twelve states. The cost falls with the order, and more digits change nothing that fewer have settled.
void test_six_masses_cost_less_with_every_state() {
  const Digits scope(60);
  const OrderProblem problem = six_masses();
  const OrderedCompensator none = best_compensator(problem, 0);
  TEST_ASSERT_TRUE(none.failure == OrderFailure::none);
  Real before = none.cost;
  // No less was found from 60 random starts an order by the same descent, without any of its other starts.
  const double best_known[] = {3.74745864245, 2.93476482849, 2.54259855755, 1.70602642027};
  for (const OrderedCompensator& c : best_compensators(problem, 1, 4)) {
    const Index order = c.A.rows();
    TEST_ASSERT_TRUE(c.failure == OrderFailure::none);
    TEST_ASSERT_TRUE(c.cost < before);
    TEST_ASSERT_TRUE(c.curvature > 0 && c.reached >= 1 && c.starts >= 9);
    expect_small(abs(c.cost / best_known[order - 1] - 1), 1e-9, "the distance to the best known cost");
    before = c.cost;
    const Digits more(90);
    const OrderedCompensator finer = polished_compensator(problem, c);
    TEST_ASSERT_TRUE(finer.failure == OrderFailure::none);
    expect_small(markov_difference(c, finer), 1e-40, "what more digits change");
  }
}

// x⁺ = (1.5 + 0.1γ)x + (1 + ση)u, y = (1 + 0.1γ)x has compensators of order 1 up to σ = 0.58764038697…. Close to that
// the moments are 10^12 times those of the noise, and doubles are too coarse to refine them by.
void test_brink_of_the_mean_square_keeps_its_digits() {
  const Digits scope(60);
  const auto number = [](const char* x) { return RealMatrix::Constant(1, 1, Real(x)); };
  OrderProblem problem = unit_problem(false, number("1.5"), number("1"), number("1"));
  problem.white = {{number("0.1"), number("0"), number("0.1")}, {number("0"), number("0.58764038697"), number("0")}};
  const OrderedCompensator found = best_compensator(problem, 1);
  TEST_ASSERT_TRUE(found.failure == OrderFailure::none && found.cost > 1e9);
  {
    const Digits more(90);
    expect_small(markov_difference(found, polished_compensator(problem, found)), 1e-30, "what more digits change");
  }
  problem.white[1].B = number("0.5877");
  const OrderedCompensator none = best_compensator(problem, 1);
  TEST_ASSERT_TRUE(none.failure == OrderFailure::no_stabilising_compensator);
  TEST_ASSERT_TRUE(none.discount > 0.9998 && none.discount < 1);
}

// White parameters leave compensators of full order with states that are hardly needed: in some of these plants the
// least curvature is below 1e-11 of the largest one, which doubles hardly tell from none.
void test_full_order_is_found_where_the_cost_is_flat() {
  const Digits scope(60);
  int found = 0, flat = 0;
  for (std::uint64_t seed = 1; seed <= 16; ++seed) {
    OrderProblem problem = stable_plant(false, 3, 1, 1, seed);
    problem.has_feedthrough = true;
    add_white_parameters(problem, seed);
    for (WhiteParameter& white : problem.white) white.B = zeros(3, 1);
    const OrderedCompensator best = best_compensator(problem, 3);
    if (best.failure != OrderFailure::none) continue;
    ++found;
    flat += best.curvature < 1e-11;
    const Digits more(90);
    const OrderedCompensator again = polished_compensator(problem, best);
    TEST_ASSERT_TRUE(again.failure == OrderFailure::none);
    expect_small(markov_difference(best, again), 1e-25, "what more digits change");
  }
  TEST_ASSERT_GREATER_OR_EQUAL(15, found);
  TEST_ASSERT_GREATER_OR_EQUAL(3, flat);
}

// k y of this plant moves only the trace of A + k B C, whose poles have the product −4: the least radius is 2, and the
// moments can be discounted by 1/4 at most. A state of its own stabilises it.
void test_hopeless_order_says_how_far_it_got() {
  const Digits scope(50);
  OrderProblem problem = stable_plant(false, 2, 1, 1, 1);
  problem.A = real((Eigen::MatrixXd(2, 2) << 0, 4, 1, 0).finished());
  problem.B = real((Eigen::MatrixXd(2, 1) << 1, 0).finished());
  problem.C = real((Eigen::MatrixXd(1, 2) << 1, 0).finished());
  problem.has_feedthrough = true;
  const OrderedCompensator gain = best_compensator(problem, 0);
  TEST_ASSERT_TRUE(gain.failure == OrderFailure::no_stabilising_compensator);
  TEST_ASSERT_TRUE(gain.discount > 0.249 && gain.discount <= 0.25);
  TEST_ASSERT_TRUE(best_compensator(problem, 1).failure == OrderFailure::none);
}

// A second state is of no use to a plant with one: every compensator that contains the best one of order 1 costs as
// little.
void test_order_that_is_not_needed_is_not_strict() {
  const Digits scope(50);
  const OrderProblem problem = stable_plant(false, 1, 1, 1, 3);
  const OrderedCompensator one = best_compensator(problem, 1), two = best_compensator(problem, 2);
  TEST_ASSERT_TRUE(one.failure == OrderFailure::none);
  TEST_ASSERT_TRUE(two.failure == OrderFailure::not_strict);
  expect_small(abs(two.cost / one.cost - 1), 1e-9, "what the second state saves");
}

// Random plants, some of them unstable: nearly every one has a compensator of order 1 or 2, and most starts find the
// same one.
void test_random_plants_have_one_best_compensator() {
  const Digits scope(40);
  int found = 0, agreed = 0, starts = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const OrderedCompensator c = best_compensator(unstable_plant(seed), 1 + static_cast<int>(seed % 2));
    if (c.failure != OrderFailure::none) continue;
    ++found;
    agreed += c.reached;
    starts += c.starts;
  }
  TEST_ASSERT_TRUE(found >= 58);
  TEST_ASSERT_TRUE(agreed > 0.8 * starts);
}

}  // namespace

void setUp() {}
void tearDown() {}

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_derivatives_are_those_of_differences);
  RUN_TEST(test_independent_minima_are_found);
  RUN_TEST(test_full_order_is_the_law_of_separation);
  RUN_TEST(test_optimal_projection_equations_hold);
  RUN_TEST(test_six_masses_cost_less_with_every_state);
  RUN_TEST(test_brink_of_the_mean_square_keeps_its_digits);
  RUN_TEST(test_full_order_is_found_where_the_cost_is_flat);
  RUN_TEST(test_hopeless_order_says_how_far_it_got);
  RUN_TEST(test_order_that_is_not_needed_is_not_strict);
  RUN_TEST(test_random_plants_have_one_best_compensator);
  return UNITY_END();
}
