/* SPDX-License-Identifier: MIT */
/* LQG_ASSERT notices each MUST that a caller breaks, and nothing of a caller that breaks none. */
#include <math.h>
#include <setjmp.h>
#include <stddef.h>
#include <string.h>

#include "contract_assert.h"
#include "lqg/lqg.h"
#include "unity.h"

static jmp_buf after;
static const char *broken;

void contract_broken(const char *condition)
{
    broken = condition;
    longjmp(after, 1);
}

/* The call breaks a MUST whose check has this in it. */
#define EXPECT_BROKEN(part, call)                                       \
    do {                                                                \
        broken = "nothing";                                             \
        if (setjmp(after) == 0)                                         \
            (void)(call);                                               \
        TEST_ASSERT_TRUE_MESSAGE(strstr(broken, part) != NULL, broken); \
    } while (0)

#define EXPECT_KEPT(call)                                 \
    do {                                                  \
        broken = NULL;                                    \
        if (setjmp(after) == 0)                           \
            (void)(call);                                 \
        TEST_ASSERT_TRUE_MESSAGE(broken == NULL, broken); \
    } while (0)

enum { NX = 2, NU = 1, NY = 2, NW = 1 };

static const lqg_real A[4] = {1, 0.5f, 0, 1}, B[2] = {0, 1}, C[4] = {1, 0, 0, 1};
static const lqg_real D[2] = {0.5f, 0}, L[4] = {0.5f, 0, 0, 0.5f};
static const lqg_real V[2] = {1, 1}, W[3] = {1, 0, 1}, G[2] = {0, 1}, M[4] = {0, 0, 0, 0}, P0[3] = {1, 0, 1};
static const lqg_real U0[1] = {0}, d0[2] = {1, 1}, K[2] = {1, 1}, K_servo[3] = {1, 1, 1};
static const lqg_real H[1] = {0.5f}, widen[2] = {2, 2};
static const lqg_real y[2] = {1, 2}, u_given[1] = {1}, phi[2] = {1, 1};
static const unsigned index_of[1] = {0};
static lqg_real u[1];

#define PLANT {NX, NU, NY, A, B, C, D, NULL}
static const lqg_gate_t gate = {3, NULL, widen, widen};
static const lqg_kalman_steady_t steady_kept = {PLANT, L, M, NULL, NULL, NULL, &gate, V};
static const lqg_kalman_plain_t plain_kept = {PLANT, NULL, V, W, M, A, NULL, P0, NULL, NULL, &gate};
static const lqg_kalman_ud_t ud_kept = {PLANT, NULL, V, NW, G, W, M, A, NULL, U0, d0, NULL, NULL, &gate};
static const lqg_lqr_t lqr_kept = {NX, NU, K, NULL, NULL};
static const lqg_rls_t rls_kept = {2, 0.9f, 1, NULL, d0, NULL};
static const lqg_servo_t servo_kept = {
    .nx = NX, .nu = NU, .nr = 1, .nxi = 1, .T = 1, .K = K_servo, .H = H, .output = index_of, .reference = index_of};

LQG_KALMAN_STEADY_STATE(steady_state, NX, NU, NY);
LQG_KALMAN_PLAIN_STATE(plain_state, NX, NU, NY);
LQG_KALMAN_UD_STATE(ud_state, NX, NU, NY, NW);
LQG_EKF_STATE(ekf_state, NX, NY, NW);
LQG_RLS_STATE(rls_state, 2);
LQG_SERVO_STATE(servo_state, NU, 1, 1);
LQG_LOOP_UD_STATE(loop_state, NX, NU, NY, NW);

enum { ROWS = NU + 1 };
static const lqg_real mpc_F[(ROWS - NU) * NX] = {1}, mpc_G[ROWS * ROWS] = {1, 0, 0, 1}, mpc_ones[ROWS] = {1, 1},
                                          mpc_low[ROWS] = {-1, -1};
static lqg_real mpc_applied[NU];
LQG_MPC_STATE(mpc_state, mpc_applied, ROWS);
static const lqg_mpc_t mpc_kept = {NX,    NU,       ROWS,    9,        mpc_F,    mpc_F,
                                   mpc_G, mpc_ones, mpc_low, mpc_ones, mpc_ones, mpc_ones};
static lqg_mpc_t mpc;

static void f(void *context, lqg_real next[], lqg_real jacobian[], const lqg_real x[], const lqg_real inputs[])
{
    (void)context;
    (void)inputs;
    next[0] = x[0];
    next[1] = x[1];
    jacobian[0] = jacobian[3] = 1;
}

static const lqg_ekf_t ekf_kept = {NX, NY, NW, f, f, NULL, NULL, V, G, W, NULL, U0, d0, NULL};

static lqg_kalman_steady_t steady;
static lqg_kalman_plain_t plain;
static lqg_kalman_ud_t ud;
static lqg_ekf_t ekf;
static lqg_rls_t rls;
static lqg_servo_t servo;
static lqg_lqr_t lqr;
static lqg_loop_ud_t loop;

void setUp(void)
{
    steady = steady_kept;
    plain = plain_kept;
    ud = ud_kept;
    ekf = ekf_kept;
    rls = rls_kept;
    servo = servo_kept;
    lqr = lqr_kept;
    mpc = mpc_kept;
    loop.kalman = ud_kept;
    loop.lqr = lqr_kept;
    loop.form = LQG_FILTER_FORM;
}

void tearDown(void) {}

static void test_nothing_is_said_of_callers_that_do_as_they_must(void)
{
    EXPECT_KEPT((lqg_kalman_steady_init(&steady, &steady_state), 0));
    EXPECT_KEPT(lqg_kalman_steady_update(&steady, &steady_state, y));
    EXPECT_KEPT(lqg_kalman_steady_update_output(&steady, &steady_state, &y[1], 1, NULL));
    EXPECT_KEPT(lqg_kalman_steady_predict(&steady, &steady_state, u_given));
    EXPECT_KEPT((lqg_kalman_plain_init(&plain, &plain_state), 0));
    EXPECT_KEPT(lqg_kalman_plain_update(&plain, &plain_state, y));
    EXPECT_KEPT(lqg_kalman_plain_update_output(&plain, &plain_state, &y[1], 1, NULL));
    EXPECT_KEPT(lqg_kalman_plain_predict(&plain, &plain_state, u_given));
    EXPECT_KEPT((lqg_kalman_ud_init(&ud, &ud_state), 0));
    EXPECT_KEPT(lqg_kalman_ud_update(&ud, &ud_state, y));
    EXPECT_KEPT(lqg_kalman_ud_update_output(&ud, &ud_state, &y[1], 1, NULL));
    EXPECT_KEPT(lqg_kalman_ud_predict(&ud, &ud_state, u_given));
    EXPECT_KEPT((lqg_ekf_init(&ekf, &ekf_state), 0));
    EXPECT_KEPT(lqg_ekf_update(&ekf, &ekf_state, y, NULL));
    EXPECT_KEPT(lqg_ekf_predict(&ekf, &ekf_state, NULL));
    EXPECT_KEPT((lqg_rls_init(&rls, &rls_state), 0));
    EXPECT_KEPT(lqg_rls_update(&rls, &rls_state, 1, phi));
    EXPECT_KEPT((lqg_servo_init(&servo, &servo_state), 0));
    EXPECT_KEPT((lqg_servo_observe(&servo, &servo_state, y), 0));
    EXPECT_KEPT(lqg_servo_control(&servo, &servo_state, y, u));
    EXPECT_KEPT(lqg_servo_advance(&servo, &servo_state, u_given));
    EXPECT_KEPT(lqg_servo_set_input(&servo, &servo_state, y, u_given));
    EXPECT_KEPT(lqg_mpc_control(&mpc, &mpc_state, y, u));
    EXPECT_KEPT(lqg_mpc_limit(&mpc, &mpc_state, y, u));
    EXPECT_KEPT((lqg_loop_ud_init(&loop, &loop_state), 0));
    EXPECT_KEPT(lqg_loop_ud_step(&loop, &loop_state, y));
}

static void test_descriptions_and_states_are_there(void)
{
    EXPECT_BROKEN("kalman && state", lqg_kalman_steady_update(NULL, &steady_state, y));
    EXPECT_BROKEN("kalman && state", lqg_kalman_plain_update(&plain, NULL, y));
    EXPECT_BROKEN("kalman && state", lqg_kalman_ud_predict(NULL, &ud_state, u_given));
    EXPECT_BROKEN("ekf && state", lqg_ekf_predict(NULL, &ekf_state, NULL));
    EXPECT_BROKEN("rls && state", lqg_rls_update(&rls, NULL, 1, phi));
    EXPECT_BROKEN("servo && state", lqg_servo_advance(NULL, &servo_state, u_given));
    EXPECT_BROKEN("lqr &&", lqg_lqr_control(NULL, y, u));
    EXPECT_BROKEN("mpc && state", lqg_mpc_limit(NULL, &mpc_state, y, u));
}

static void test_outputs_and_inputs_are_there(void)
{
    EXPECT_BROKEN("y &&", lqg_kalman_steady_update(&steady, &steady_state, NULL));
    EXPECT_BROKEN("y &&", lqg_kalman_plain_update(&plain, &plain_state, NULL));
    EXPECT_BROKEN("y &&", lqg_kalman_ud_update(&ud, &ud_state, NULL));
    EXPECT_BROKEN("u ||", lqg_kalman_ud_predict(&ud, &ud_state, NULL));
    EXPECT_BROKEN("y &&", lqg_ekf_update(&ekf, &ekf_state, NULL, NULL));
    EXPECT_BROKEN("phi", lqg_rls_update(&rls, &rls_state, 1, NULL));
    EXPECT_BROKEN("x && u", lqg_servo_control(&servo, &servo_state, NULL, u));
    EXPECT_BROKEN("x && u", lqg_lqr_control(&lqr, y, NULL));
    EXPECT_BROKEN("x && u", lqg_mpc_limit(&mpc, &mpc_state, NULL, u));
}

static void test_an_output_is_one_of_the_plant(void)
{
    EXPECT_BROKEN("i < kalman->plant.ny", lqg_kalman_steady_update_output(&steady, &steady_state, y, NY, NULL));
    EXPECT_BROKEN("i < kalman->plant.ny", lqg_kalman_plain_update_output(&plain, &plain_state, y, NY, NULL));
    EXPECT_BROKEN("i < kalman->plant.ny", lqg_kalman_ud_update_output(&ud, &ud_state, y, NY, NULL));
}

static void test_dimensions_are_at_least_one(void)
{
    steady.plant.nx = 0;
    plain.plant.ny = 0;
    ekf.nx = 0;
    rls.ntheta = 0;
    lqr.nu = 0;
    EXPECT_BROKEN("nx >= 1", lqg_kalman_steady_update(&steady, &steady_state, y));
    EXPECT_BROKEN("ny >= 1", lqg_kalman_plain_update(&plain, &plain_state, y));
    EXPECT_BROKEN("nx >= 1", lqg_ekf_update(&ekf, &ekf_state, y, NULL));
    EXPECT_BROKEN("ntheta >= 1", lqg_rls_update(&rls, &rls_state, 1, phi));
    EXPECT_BROKEN("nu >= 1", lqg_lqr_control(&lqr, y, u));
}

static void test_matrices_are_there(void)
{
    steady.L = NULL;
    plain.plant.A = NULL;
    ud.G = NULL;
    servo.K = NULL;
    ekf.d0 = NULL;
    EXPECT_BROKEN("kalman->L", lqg_kalman_steady_update(&steady, &steady_state, y));
    EXPECT_BROKEN("plant->A", lqg_kalman_plain_update(&plain, &plain_state, y));
    EXPECT_BROKEN("kalman->G", lqg_kalman_ud_update(&ud, &ud_state, y));
    EXPECT_BROKEN("servo->K", lqg_servo_control(&servo, &servo_state, y, u));
    EXPECT_BROKEN("ekf->d0", (lqg_ekf_init(&ekf, &ekf_state), 0));
    plain = plain_kept;
    plain.A_free = NULL; /* with an M */
    EXPECT_BROKEN("kalman->A_free", lqg_kalman_plain_update(&plain, &plain_state, y));
    servo = servo_kept;
    servo.H = NULL;
    EXPECT_BROKEN("servo->H", lqg_servo_advance(&servo, &servo_state, u_given));
}

static void test_arrays_of_the_state_are_there_where_the_description_needs_them(void)
{
    lqg_kalman_steady_state_t of_steady = steady_state;
    lqg_kalman_ud_state_t of_ud = ud_state;
    lqg_servo_state_t of_servo = servo_state;
    lqg_rls_state_t of_rls = rls_state;

    of_steady.u_applied = NULL; /* with a D */
    EXPECT_BROKEN("u_applied", lqg_kalman_steady_update(&steady, &of_steady, y));
    of_steady = steady_state;
    of_steady.innovation = NULL; /* with an M */
    EXPECT_BROKEN("innovation", lqg_kalman_steady_update(&steady, &of_steady, y));
    of_steady = steady_state;
    of_steady.gate.widening = NULL; /* with a gate that opens */
    EXPECT_BROKEN("widening", (lqg_kalman_steady_init(&steady, &of_steady), 0));
    of_ud.U = NULL;
    EXPECT_BROKEN("state->U", lqg_kalman_ud_update(&ud, &of_ud, y));
    of_ud = ud_state;
    of_ud.work = NULL;
    EXPECT_BROKEN("work", lqg_kalman_ud_predict(&ud, &of_ud, u_given));
    of_servo.demand = NULL; /* with a ξ */
    EXPECT_BROKEN("demand", lqg_servo_control(&servo, &of_servo, y, u));
    of_servo = servo_state;
    of_servo.r = NULL;
    EXPECT_BROKEN("state->r", lqg_servo_control(&servo, &of_servo, y, u));
    of_rls.work = NULL;
    EXPECT_BROKEN("work", lqg_rls_update(&rls, &of_rls, 1, phi));
}

static void test_numbers_are_in_their_ranges(void)
{
    static const lqg_gate_t closed = {0, NULL, NULL, NULL};
    ud.gate = &closed;
    EXPECT_BROKEN("sigma > 0", (lqg_kalman_ud_init(&ud, &ud_state), 0));
    steady.S = NULL; /* with a gate */
    EXPECT_BROKEN("kalman->S", lqg_kalman_steady_update(&steady, &steady_state, y));
    rls.forgetting = 1.5f;
    EXPECT_BROKEN("forgetting", lqg_rls_update(&rls, &rls_state, 1, phi));
    rls = rls_kept;
    rls.V = (lqg_real)NAN;
    EXPECT_BROKEN("V > 0", lqg_rls_update(&rls, &rls_state, 1, phi));
}

static void test_limits_that_are_foreseen_have_their_rows(void)
{
    lqg_mpc_state_t without = mpc_state;

    without.u_applied = NULL; /* with a u_step */
    EXPECT_BROKEN("u_applied", lqg_mpc_limit(&mpc, &without, y, u));
    mpc.rows = 256; /* more than a byte counts */
    EXPECT_BROKEN("rows <= 255", lqg_mpc_limit(&mpc, &mpc_state, y, u));
    mpc = mpc_kept;
    mpc.F = NULL; /* with rows after the inputs */
    EXPECT_BROKEN("mpc->F", lqg_mpc_limit(&mpc, &mpc_state, y, u));
    mpc = mpc_kept;
    mpc.K = NULL;
    EXPECT_KEPT(lqg_mpc_limit(&mpc, &mpc_state, y, u));
    EXPECT_BROKEN("mpc->K", lqg_mpc_control(&mpc, &mpc_state, y, u));
}

static void test_a_loop_s_regulator_is_one_for_its_plant(void)
{
    loop.lqr.nx = 1;
    EXPECT_BROKEN("lqr->nx == plant->nx", lqg_loop_ud_step(&loop, &loop_state, y));
    loop.lqr.nx = NX;
    loop.lqr.nu = 2;
    EXPECT_BROKEN("lqr->nu == plant->nu", (lqg_loop_ud_init(&loop, &loop_state), 0));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_nothing_is_said_of_callers_that_do_as_they_must);
    RUN_TEST(test_descriptions_and_states_are_there);
    RUN_TEST(test_outputs_and_inputs_are_there);
    RUN_TEST(test_an_output_is_one_of_the_plant);
    RUN_TEST(test_dimensions_are_at_least_one);
    RUN_TEST(test_matrices_are_there);
    RUN_TEST(test_arrays_of_the_state_are_there_where_the_description_needs_them);
    RUN_TEST(test_numbers_are_in_their_ranges);
    RUN_TEST(test_limits_that_are_foreseen_have_their_rows);
    RUN_TEST(test_a_loop_s_regulator_is_one_for_its_plant);
    return UNITY_END();
}
