/* SPDX-License-Identifier: MIT */
/* Is P what it says? Over many runs of plants with the noises of their models; and a published series. */
#include <math.h>
#include <string.h>

#include "model.h"
#include "unity.h"

void setUp(void) {}
void tearDown(void) {}

enum { RUNS = 200, SAMPLES = 40, JOINT = MAX_NX + MAX_NY };

/* Sum of twelve uniform numbers: normal enough up to its fourth moment, 2.9 in place of 3. */
static double normal(unsigned long *seed)
{
    double sum = 0;
    for (unsigned i = 0; i < 12; i++)
        sum += noise(seed) / 2;
    return sum;
}

/* Lower triangular root of a positive semidefinite n × n matrix. */
static void cholesky(const double M[], unsigned n, double root[])
{
    memset(root, 0, n * n * sizeof *root);
    for (unsigned j = 0; j < n; j++)
        for (unsigned i = j; i < n; i++) {
            double left = M[i * n + j];
            for (unsigned k = 0; k < j; k++)
                left -= root[i * n + k] * root[j * n + k];
            root[i * n + j] = i == j ? sqrt(left > 1e-15 ? left : 0) : root[j * n + j] > 0 ? left / root[j * n + j] : 0;
        }
}

static void draw(const double root[], unsigned n, double out[], unsigned long *seed)
{
    double standard[JOINT];
    for (unsigned i = 0; i < n; i++) {
        standard[i] = normal(seed);
        out[i] = 0;
        for (unsigned j = 0; j <= i; j++)
            out[i] += root[i * n + j] * standard[j];
    }
}

/* The root of the covariance of [w; v]. */
static void joint_root(const model_t *model, double root[])
{
    const unsigned nx = model->nx, ny = model->ny, n = nx + ny;
    double joint[JOINT * JOINT];
    for (unsigned i = 0; i < n; i++)
        for (unsigned j = 0; j < n; j++)
            joint[i * n + j] = i < nx && j < nx ? model->W[i * nx + j]
                               : i < nx         ? model->S[i * ny + j - nx]
                               : j < nx         ? model->S[j * ny + i - nx]
                                                : model->V[(i - nx) * ny + j - nx];
    cholesky(joint, n, root);
}

/* y = C x + D u + v, x ← A x + B u + w */
static void go_on(const model_t *model, const double root[], double x[], const lqg_real u_before[], const lqg_real u[],
                  lqg_real y[], unsigned long *seed)
{
    const unsigned nx = model->nx, nu = model->nu;
    double joint[JOINT], next[MAX_NX];
    draw(root, nx + model->ny, joint, seed);
    for (unsigned i = 0; i < model->ny; i++) {
        double sum = joint[nx + i];
        for (unsigned j = 0; j < nx; j++)
            sum += model->C[i * nx + j] * x[j];
        for (unsigned j = 0; j < nu; j++)
            sum += model->D[i * nu + j] * (double)u_before[j];
        y[i] = (lqg_real)sum;
    }
    for (unsigned i = 0; i < nx; i++) {
        next[i] = joint[i];
        for (unsigned j = 0; j < nx; j++)
            next[i] += model->A[i * nx + j] * x[j];
        for (unsigned j = 0; j < nu; j++)
            next[i] += model->B[i * nu + j] * (double)u[j];
    }
    memcpy(x, next, nx * sizeof *x);
}

/* eᵀ P⁻¹ e of e = x − x̂: with U z = e, Σ z_i²/d_i. */
static double normalised_error(const double x[], const state_t *s, unsigned nx)
{
    double z[MAX_NX], sum = 0;
    for (unsigned i = nx; i-- > 0;) {
        z[i] = x[i] - (double)s->x[i];
        for (unsigned j = i + 1; j < nx; j++)
            z[i] -= (double)s->U[LQG_STRICT_TRIANGLE(j) + i] * z[j];
        sum += z[i] * z[i] / (double)s->d[i];
    }
    return sum;
}

/* Of `degrees` degrees of freedom: mean and variance of χ², four standard deviations. */
static void assert_chi_square(double degrees, double value)
{
    TEST_ASSERT_DOUBLE_WITHIN(4 * sqrt(2 * degrees), degrees, value);
}

static void run_many(const model_t *model)
{
    static online_t online;
    double root[JOINT * JOINT], root_of_P0[MAX_NX * MAX_NX], errors = 0, innovations = 0;
    unsigned long seed = 23;

    prepare_online(model, &online);
    joint_root(model, root);
    cholesky(model->P0, model->nx, root_of_P0);
    for (unsigned run = 0; run < RUNS; run++) {
        state_t s;
        double x[MAX_NX];
        lqg_real y[MAX_NY], innovation[MAX_NY], variance[MAX_NY], u[MAX_NU] = {0};
        const lqg_watch_t watch = {innovation, variance, NULL};

        draw(root_of_P0, model->nx, x, &seed);
        for (unsigned i = 0; i < model->nx; i++)
            x[i] += model->x0[i];
        ud_init(&online.ud, &s);
        for (unsigned sample = 0; sample < SAMPLES; sample++) {
            const lqg_real before[MAX_NU] = {u[0]};
            u[0] = (lqg_real)noise(&seed);
            go_on(model, root, x, before, u, y, &seed);
            ud_partial_update(&online.ud, &s, y, LQG_ALL_OUTPUTS, &watch);
            for (unsigned i = 0; i < model->ny; i++)
                innovations += (double)innovation[i] * (double)innovation[i] / (double)variance[i];
            ud_predict(&online.ud, &s, u);
        }
        errors += normalised_error(x, &s, model->nx);
    }
    assert_chi_square(RUNS * model->nx, errors);
    assert_chi_square(RUNS * SAMPLES * model->ny, innovations);
}

static void test_errors_and_innovations_are_consistent_of_a_double_integrator(void)
{
    run_many(&double_integrator);
}
static void test_errors_and_innovations_are_consistent_with_four_states_and_one_noise(void)
{
    run_many(&two_mass);
}
static void test_errors_and_innovations_are_consistent_with_correlated_outputs(void)
{
    run_many(&correlated);
}
static void test_errors_and_innovations_are_consistent_when_w_and_v_are_correlated(void)
{
    run_many(&cross_noise);
}

/* Annual flow of the Nile at Aswan, 1871 to 1970, 10⁸ m³ (Cobb, 1978). */
static const lqg_real nile[100] = {
    1120, 1160, 963,  1210, 1160, 1160, 813,  1230, 1370, 1140, 995,  935,  1110, 994, 1020, 960,  1180,
    799,  958,  1140, 1100, 1210, 1150, 1250, 1260, 1220, 1030, 1100, 774,  840,  874, 694,  940,  833,
    701,  916,  692,  1020, 1050, 969,  831,  726,  456,  824,  702,  1120, 1100, 832, 764,  821,  768,
    845,  864,  862,  698,  845,  744,  796,  1040, 759,  781,  865,  845,  944,  984, 897,  822,  1010,
    771,  676,  649,  846,  812,  742,  801,  1040, 860,  874,  848,  890,  744,  749, 838,  1050, 918,
    986,  797,  923,  975,  815,  1020, 906,  901,  1170, 912,  746,  919,  718,  714, 740};

/* The concentrated diffuse log-likelihood of the local level model, x⁺ = x + w, y = x + v, W = q V, without
 * its constants (Durbin, Koopman: Time Series Analysis by State Space Methods, 2nd edition, 2012,
 * section 2.10.2), with V = 1: −(n − 1)/2 log(Σ innovation²/s/(n − 1)) − ½ Σ log s     over t = 2 … n */
static double log_likelihood(lqg_real q)
{
    const lqg_real one[1] = {1}, x0[1] = {nile[0]};
    const lqg_real P0[1] = {1 + q}; /* of the second year, given the first: x̂ = y, P = V */
    const lqg_kalman_ud_t kalman = {
        {1, 0, 1, one, NULL, one, NULL, NULL}, NULL, one, 1, one, &q, NULL, NULL, x0, NULL, P0, NULL, NULL, NULL};
    lqg_real innovation[1], S[1];
    const lqg_watch_t watch = {innovation, S, NULL};
    LQG_KALMAN_UD_STATE(level, 1, 0, 1, 1);
    double squares = 0, logarithms = 0;

    lqg_kalman_ud_init(&kalman, &level);
    for (unsigned t = 1; t < 100; t++) {
        lqg_kalman_ud_partial_update(&kalman, &level, &nile[t], LQG_ALL_OUTPUTS, &watch);
        squares += (double)innovation[0] * (double)innovation[0] / (double)S[0];
        logarithms += log((double)S[0]);
        lqg_kalman_ud_predict(&kalman, &level, NULL);
    }
    return -49.5 * log(squares / 99) - logarithms / 2;
}

/* Their table 2.1, to two decimals: −495.68 where the maximisation begins, q = 1, and −492.07 where it ends,
 * q = 0.0973. */
static void test_log_likelihoods_of_the_nile_are_the_published_ones(void)
{
    TEST_ASSERT_DOUBLE_WITHIN(0.01, -495.68, log_likelihood(1));
    TEST_ASSERT_DOUBLE_WITHIN(0.01, -492.07, log_likelihood(0.0973f));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_errors_and_innovations_are_consistent_of_a_double_integrator);
    RUN_TEST(test_errors_and_innovations_are_consistent_with_four_states_and_one_noise);
    RUN_TEST(test_errors_and_innovations_are_consistent_with_correlated_outputs);
    RUN_TEST(test_errors_and_innovations_are_consistent_when_w_and_v_are_correlated);
    RUN_TEST(test_log_likelihoods_of_the_nile_are_the_published_ones);
    return UNITY_END();
}
