/* SPDX-License-Identifier: MIT */
/* The extended Kalman filter: against a textbook's in double, against the linear filter, and under attack. */
#include <math.h>
#include <stddef.h>
#include <string.h>

#include "lqg/ekf.h"
#include "model.h"
#include "unity.h"

void setUp(void) {}
void tearDown(void) {}

enum { NX = 4, NY = 2, NW = 2 };

/* Range and bearing of a vehicle [x vx y vy] that accelerates at random and is slowed down by drag: the
 * classic of Bar-Shalom, Li, Kirubarajan: Estimation with Applications to Tracking and Navigation (2001),
 * section 10.3. */
#define PERIOD 0.25
#define DRAG 0.01

/* Written for any scalar, so that the filter and its reference share the plant and nothing else. */
#define VEHICLE(scalar, root, arctangent, motion, sensors)                                      \
    static void motion(scalar next[], scalar A[], const scalar x[])                             \
    {                                                                                           \
        const scalar T = (scalar)PERIOD, c = (scalar)DRAG, v = root(x[1] * x[1] + x[3] * x[3]); \
        for (unsigned i = 0; i < 3; i += 2) {                                                   \
            const unsigned o = 2 - i; /* the other coordinate */                                \
            next[i] = x[i] + T * x[i + 1];                                                      \
            next[i + 1] = x[i + 1] - T * c * v * x[i + 1];                                      \
            A[i * NX + i] = 1;                                                                  \
            A[i * NX + i + 1] = T;                                                              \
            A[(i + 1) * NX + i + 1] = 1 - T * c * (v + x[i + 1] * x[i + 1] / v);                \
            A[(i + 1) * NX + o + 1] = -T * c * x[i + 1] * x[o + 1] / v;                         \
        }                                                                                       \
    }                                                                                           \
    static void sensors(scalar y[], scalar C[], const scalar x[])                               \
    {                                                                                           \
        const scalar range2 = x[0] * x[0] + x[2] * x[2], range = root(range2);                  \
        y[0] = range;                                                                           \
        y[1] = arctangent(x[2], x[0]);                                                          \
        C[0] = x[0] / range;                                                                    \
        C[2] = x[2] / range;                                                                    \
        C[NX] = -x[2] / range2;                                                                 \
        C[NX + 2] = x[0] / range2;                                                              \
    }

#ifdef LQG_REAL_DOUBLE
VEHICLE(lqg_real, sqrt, atan2, motion, sensors)
#else
VEHICLE(lqg_real, sqrtf, atan2f, motion, sensors)
#endif
VEHICLE(double, sqrt, atan2, true_motion, true_sensors)

static const double PI = 3.14159265358979323846;

static double wrapped(double angle)
{
    return angle > PI ? angle - 2 * PI : angle < -PI ? angle + 2 * PI : angle;
}

/* What the context asks f and h to spoil: an entry of next or y, of A or C. */
typedef struct {
    int value, jacobian;
} spoil_t;

static void f(void *context, lqg_real next[], lqg_real A[], const lqg_real x[], const lqg_real u[])
{
    const spoil_t *spoil = (const spoil_t *)context;
    (void)u;
    motion(next, A, x);
    if (spoil && spoil->value >= 0)
        next[spoil->value] = NAN;
    if (spoil && spoil->jacobian >= 0)
        A[spoil->jacobian] = INFINITY;
}

static void h(void *context, lqg_real y[], lqg_real C[], const lqg_real x[], const lqg_real u[])
{
    const spoil_t *spoil = (const spoil_t *)context;
    (void)u;
    sensors(y, C, x);
    if (spoil && spoil->value >= 0)
        y[spoil->value % NY] = NAN;
    if (spoil && spoil->jacobian >= 0)
        C[spoil->jacobian % (NY * NX)] = INFINITY;
}

static void subtract(void *context, lqg_real innovation[], const lqg_real y[], const lqg_real expected[])
{
    (void)context;
    innovation[0] = y[0] - expected[0];
    innovation[1] = (lqg_real)wrapped((double)(y[1] - expected[1]));
}

static const lqg_real V[NY] = {0.25f, 0.0001f}, G[NX * NW] = {0.03125f, 0, 0.25f, 0, 0, 0.03125f, 0, 0.25f};
static const lqg_real W[NW] = {0.04f, 0.04f}, x0[NX] = {-30, 1, 20, -3}, d0[NX] = {4, 1, 4, 1};

#define VEHICLE_WITH(context, gate) {NX, NY, NW, f, h, subtract, context, V, G, W, x0, NULL, d0, gate}
static const lqg_ekf_t vehicle = VEHICLE_WITH(NULL, NULL);

/* A state as arrays that can be compared and copied, and the library's calls over it. */
typedef struct {
    lqg_real x[NX], U[LQG_STRICT_TRIANGLE(NX)], d[NX], work[LQG_EKF_WORK(NX, NY, NX)];
    unsigned long gated[NY];
} ekf_arrays_t;

static lqg_ekf_state_t state_in(ekf_arrays_t *s)
{
    const lqg_ekf_state_t state = {s->x, s->U, s->d, {NULL, s->gated}, s->work};
    return state;
}

static lqg_status_t partial_update(const lqg_ekf_t *ekf, ekf_arrays_t *s, const lqg_real y[], const lqg_real u[],
                                   unsigned long used, const lqg_watch_t *watch)
{
    lqg_ekf_state_t state = state_in(s);
    return lqg_ekf_partial_update(ekf, &state, y, u, used, watch);
}

static lqg_status_t update(const lqg_ekf_t *ekf, ekf_arrays_t *s, const lqg_real y[], const lqg_real u[])
{
    lqg_ekf_state_t state = state_in(s);
    return lqg_ekf_update(ekf, &state, y, u);
}

static lqg_status_t predict(const lqg_ekf_t *ekf, ekf_arrays_t *s, const lqg_real u[])
{
    lqg_ekf_state_t state = state_in(s);
    return lqg_ekf_predict(ekf, &state, u);
}

static void init(const lqg_ekf_t *ekf, ekf_arrays_t *s)
{
    lqg_ekf_state_t state = state_in(s);
    lqg_ekf_init(ekf, &state);
}

static ekf_arrays_t begun(void)
{
    ekf_arrays_t s;
    memset(&s, 0, sizeof s);
    init(&vehicle, &s);
    return s;
}

static int same(const ekf_arrays_t *a, const ekf_arrays_t *b)
{
    return memcmp(a, b, offsetof(ekf_arrays_t, work)) == 0;
}

/* The textbook's: P in full, both outputs at once, S inverted. */
typedef struct {
    double x[NX], P[NX][NX];
} reference_t;

static reference_t reference_begun(void)
{
    reference_t reference = {{0}, {{0}}};
    for (unsigned i = 0; i < NX; i++) {
        reference.x[i] = (double)x0[i];
        reference.P[i][i] = (double)d0[i];
    }
    return reference;
}

static void reference_predict(reference_t *reference)
{
    double next[NX], A[NX * NX] = {0}, P[NX][NX];
    true_motion(next, A, reference->x);
    memcpy(reference->x, next, sizeof next);
    for (unsigned i = 0; i < NX; i++)
        for (unsigned j = 0; j < NX; j++) {
            P[i][j] = 0;
            for (unsigned q = 0; q < NW; q++)
                P[i][j] += (double)G[i * NW + q] * (double)W[q] * (double)G[j * NW + q];
            for (unsigned k = 0; k < NX; k++)
                for (unsigned l = 0; l < NX; l++)
                    P[i][j] += A[i * NX + k] * reference->P[k][l] * A[j * NX + l];
        }
    memcpy(reference->P, P, sizeof P);
}

static void reference_update(reference_t *reference, const lqg_real y[])
{
    double expected[NY], C[NY * NX] = {0}, PC[NX][NY] = {{0}}, S[NY][NY] = {{0}}, inverse[NY][NY], L[NX][NY];
    true_sensors(expected, C, reference->x);
    const double nu[NY] = {(double)y[0] - expected[0], wrapped((double)y[1] - expected[1])};

    for (unsigned i = 0; i < NX; i++)
        for (unsigned a = 0; a < NY; a++)
            for (unsigned k = 0; k < NX; k++)
                PC[i][a] += reference->P[i][k] * C[a * NX + k];
    for (unsigned a = 0; a < NY; a++)
        for (unsigned b = 0; b < NY; b++) {
            S[a][b] = a == b ? (double)V[a] : 0;
            for (unsigned k = 0; k < NX; k++)
                S[a][b] += C[a * NX + k] * PC[k][b];
        }
    const double determinant = S[0][0] * S[1][1] - S[0][1] * S[1][0];
    inverse[0][0] = S[1][1] / determinant;
    inverse[1][1] = S[0][0] / determinant;
    inverse[0][1] = inverse[1][0] = -S[0][1] / determinant;
    for (unsigned i = 0; i < NX; i++)
        for (unsigned a = 0; a < NY; a++) {
            L[i][a] = PC[i][0] * inverse[0][a] + PC[i][1] * inverse[1][a];
            reference->x[i] += L[i][a] * nu[a];
        }
    for (unsigned i = 0; i < NX; i++)
        for (unsigned j = 0; j < NX; j++)
            reference->P[i][j] -= L[i][0] * PC[j][0] + L[i][1] * PC[j][1];
}

/* Sum of twelve uniform numbers: normal enough. */
static double normal(unsigned long *seed)
{
    double sum = 0;
    for (unsigned i = 0; i < 12; i++)
        sum += noise(seed) / 2;
    return sum;
}

/* The vehicle goes on, and its sensors speak. */
static void drive(double x[], lqg_real y[], unsigned long *seed)
{
    double next[NX], unused_A[NX * NX], angle_and_range[NY], unused_C[NY * NX];
    true_motion(next, unused_A, x);
    for (unsigned q = 0; q < NW; q++) {
        const double acceleration = sqrt((double)W[q]) * normal(seed);
        for (unsigned i = 0; i < NX; i++)
            next[i] += (double)G[i * NW + q] * acceleration;
    }
    memcpy(x, next, sizeof next);
    true_sensors(angle_and_range, unused_C, x);
    y[0] = (lqg_real)(angle_and_range[0] + sqrt((double)V[0]) * normal(seed));
    y[1] = (lqg_real)wrapped(angle_and_range[1] + sqrt((double)V[1]) * normal(seed));
}

static void true_start(double x[], unsigned long *seed)
{
    for (unsigned i = 0; i < NX; i++)
        x[i] = (double)x0[i] + sqrt((double)d0[i]) * normal(seed);
}

/* A few hundred roundings a sample of numbers up to 100, which the filter forgets in about 20 samples; the
 * bearing, at ranges up to 100, passes its own on a hundredfold. */
#define TOLERANCE (1e5 * EPSILON)

/* The vehicle crosses the negative x-axis, where bearings jump by 2π, after about 7 s. */
static void test_range_and_bearing_follow_the_textbook_across_the_jump_of_the_angle(void)
{
    ekf_arrays_t s = begun();
    reference_t reference = reference_begun();
    double x[NX];
    unsigned long seed = 1;
    unsigned jumps = 0;
    lqg_real y[NY], previous = 0;

    true_start(x, &seed);
    for (unsigned sample = 0; sample < 200; sample++) {
        drive(x, y, &seed);
        jumps += fabs((double)(y[1] - previous)) > PI;
        previous = y[1];
        TEST_ASSERT_EQUAL_UINT(LQG_OK, predict(&vehicle, &s, NULL));
        TEST_ASSERT_EQUAL_UINT(LQG_OK, update(&vehicle, &s, y, NULL));
        reference_predict(&reference);
        reference_update(&reference, y);
        for (unsigned i = 0; i < NX; i++) {
            TEST_ASSERT_DOUBLE_WITHIN(TOLERANCE, reference.x[i], (double)s.x[i]);
            for (unsigned j = 0; j <= i; j++)
                TEST_ASSERT_DOUBLE_WITHIN(TOLERANCE, reference.P[i][j], ud_covariance(s.U, s.d, NX, i, j));
        }
    }
    TEST_ASSERT_TRUE(jumps > 0);
}

/* Σ over runs and samples of ν²/s, outputs taken singly: χ² with as many degrees of freedom. */
static void test_normalised_innovations_are_consistent_over_many_runs(void)
{
    enum { RUNS = 50, LENGTH = 60 };
    double sum = 0;
    unsigned long seed = 17;
    lqg_real y[NY], innovation[NY], variance[NY];
    const lqg_watch_t watch = {innovation, variance, NULL};

    for (unsigned run = 0; run < RUNS; run++) {
        ekf_arrays_t s = begun();
        double x[NX];
        true_start(x, &seed);
        for (unsigned sample = 0; sample < LENGTH; sample++) {
            drive(x, y, &seed);
            predict(&vehicle, &s, NULL);
            partial_update(&vehicle, &s, y, NULL, LQG_ALL_OUTPUTS, &watch);
            for (unsigned i = 0; i < NY; i++)
                sum += (double)innovation[i] * (double)innovation[i] / (double)variance[i];
        }
    }
    /* mean N, standard deviation √(2N), N = 6000; four of them, and a share for the linearisation */
    const double degrees = RUNS * LENGTH * NY;
    TEST_ASSERT_DOUBLE_WITHIN(4 * sqrt(2 * degrees) + 0.02 * degrees, degrees, sum);
}

/* two_mass as functions. */
static void linear_f(void *context, lqg_real next[], lqg_real A[], const lqg_real x[], const lqg_real u[])
{
    const lqg_plant_t *plant = &((const online_t *)context)->ud.plant;
    for (unsigned i = 0; i < 4; i++) {
        next[i] = plant->B[i] * u[0];
        for (unsigned j = 0; j < 4; j++) {
            A[i * 4 + j] = plant->A[i * 4 + j];
            next[i] += plant->A[i * 4 + j] * x[j];
        }
    }
}

static void linear_h(void *context, lqg_real y[], lqg_real C[], const lqg_real x[], const lqg_real u[])
{
    const lqg_plant_t *plant = &((const online_t *)context)->ud.plant;
    for (unsigned i = 0; i < 2; i++) {
        y[i] = plant->D[i] * u[0];
        for (unsigned j = 0; j < 4; j++) {
            C[i * 4 + j] = plant->C[i * 4 + j];
            y[i] += plant->C[i * 4 + j] * x[j];
        }
    }
}

static void test_of_a_linear_plant_the_covariance_is_the_kalman_filter_s_to_the_bit(void)
{
    static online_t online;
    state_t s;
    ekf_arrays_t e;
    lqg_real u[1] = {0}, y[2];
    double plant[MAX_NX] = {0};
    unsigned long seed = 5;
    prepare_online(&two_mass, &online);
    const lqg_kalman_ud_t *kalman = &online.ud;
    const lqg_ekf_t ekf = {4,         2,         kalman->nw, linear_f,   linear_h,   NULL,       &online,
                           kalman->V, kalman->G, kalman->W,  kalman->x0, kalman->U0, kalman->d0, NULL};

    ud_init(kalman, &s);
    init(&ekf, &e);
    for (unsigned sample = 0; sample < 200; sample++) {
        simulate(&two_mass, plant, u, y, &seed);
        lqg_status_t status = ud_update(kalman, &s, y);
        status |= update(&ekf, &e, y, u);
        u[0] = (lqg_real)noise(&seed) / 8;
        status |= ud_predict(kalman, &s, u);
        status |= predict(&ekf, &e, u);

        TEST_ASSERT_EQUAL_UINT(LQG_OK, status);
        TEST_ASSERT_TRUE(memcmp(s.U, e.U, LQG_STRICT_TRIANGLE(4) * sizeof *s.U) == 0);
        TEST_ASSERT_TRUE(memcmp(s.d, e.d, sizeof e.d) == 0);
        for (unsigned i = 0; i < 4; i++)
            TEST_ASSERT_DOUBLE_WITHIN(TOLERANCE, (double)s.x[i], (double)e.x[i]);
    }
}

static void test_outputs_that_h_cannot_tell_are_left_out(void)
{
    const lqg_real y[NY] = {36, 2.5f};
    for (int entry = 0; entry < NY * NX; entry++) {
        spoil_t value = {entry % NY, -1}, jacobian = {-1, entry};
        const lqg_ekf_t bad_value = VEHICLE_WITH(&value, NULL), bad_jacobian = VEHICLE_WITH(&jacobian, NULL);
        const unsigned bad = (unsigned)entry % NY, bad_row = entry >= NX;
        const unsigned long others = 1ul << (1 - bad), rest = 1ul << (1 - bad_row);
        ekf_arrays_t s = begun(), expected = begun();

        TEST_ASSERT_EQUAL_HEX(REJECTED(bad), update(&bad_value, &s, y, NULL));
        partial_update(&vehicle, &expected, y, NULL, others, NULL);
        TEST_ASSERT_TRUE(same(&expected, &s));

        s = expected = begun();
        TEST_ASSERT_EQUAL_HEX(REJECTED(bad_row), update(&bad_jacobian, &s, y, NULL));
        partial_update(&vehicle, &expected, y, NULL, rest, NULL);
        TEST_ASSERT_TRUE(same(&expected, &s));
    }
}

static void test_begins_anew_when_f_cannot_tell(void)
{
    const lqg_real y[NY] = {36, 2.5f};
    const ekf_arrays_t first = begun();
    for (int entry = 0; entry < NX * NX; entry++) {
        spoil_t value = {entry % NX, -1}, jacobian = {-1, entry};
        const lqg_ekf_t bad[2] = {VEHICLE_WITH(&value, NULL), VEHICLE_WITH(&jacobian, NULL)};
        for (unsigned b = 0; b < 2; b++) {
            ekf_arrays_t s = begun();
            update(&vehicle, &s, y, NULL);
            TEST_ASSERT_FALSE(same(&first, &s));
            const lqg_status_t status = predict(&bad[b], &s, NULL);
            TEST_ASSERT_EQUAL_UINT(b == 0 ? LQG_STATE_RESET : LQG_COVARIANCE_RESET, status);
            TEST_ASSERT_TRUE(b == 1 || memcmp(first.x, s.x, sizeof s.x) == 0);
            TEST_ASSERT_TRUE(memcmp(first.U, s.U, sizeof s.U) == 0 && memcmp(first.d, s.d, sizeof s.d) == 0);
            for (int j = 0; j < NX; j++)
                TEST_ASSERT_TRUE(isfinite(s.x[j]));
        }
    }
}

static void test_outputs_that_are_no_numbers_change_nothing_to_the_bit(void)
{
    const lqg_real y[NY] = {NAN, -INFINITY};
    ekf_arrays_t s = begun();
    const ekf_arrays_t before = s;
    TEST_ASSERT_EQUAL_HEX(REJECTED(0) | REJECTED(1), update(&vehicle, &s, y, NULL));
    TEST_ASSERT_TRUE(same(&before, &s));
}

static void test_gate_leaves_out_an_unlikely_bearing(void)
{
    static const lqg_gate_t gate = {5, NULL, NULL, NULL};
    const lqg_ekf_t gated = VEHICLE_WITH(NULL, &gate);
    const lqg_real likely[NY] = {36, 2.55f}, unlikely[NY] = {36, 1};
    ekf_arrays_t s = begun();
    TEST_ASSERT_EQUAL_UINT(LQG_OK, update(&gated, &s, likely, NULL));
    TEST_ASSERT_EQUAL_UINT(LQG_OUTPUT_GATED, update(&gated, &s, unlikely, NULL));
    TEST_ASSERT_TRUE(s.gated[0] == 0 && s.gated[1] == 1);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_range_and_bearing_follow_the_textbook_across_the_jump_of_the_angle);
    RUN_TEST(test_normalised_innovations_are_consistent_over_many_runs);
    RUN_TEST(test_of_a_linear_plant_the_covariance_is_the_kalman_filter_s_to_the_bit);
    RUN_TEST(test_outputs_that_h_cannot_tell_are_left_out);
    RUN_TEST(test_begins_anew_when_f_cannot_tell);
    RUN_TEST(test_outputs_that_are_no_numbers_change_nothing_to_the_bit);
    RUN_TEST(test_gate_leaves_out_an_unlikely_bearing);
    return UNITY_END();
}
