/* SPDX-License-Identifier: MIT */
/* What the sensors, or the application, should never say. */
#include <math.h>
#include <string.h>

#include "loop.h"
#include "unity.h"

void setUp(void) {}
void tearDown(void) {}

#ifdef LQG_REAL_DOUBLE
#define LARGEST DBL_MAX
#else
#define LARGEST FLT_MAX
#endif

static const model_t *const models[] = {&double_integrator, &two_mass, &correlated, &cross_noise};
static const lqg_real hostile[] = {NAN, INFINITY, -INFINITY, LARGEST, -LARGEST, LARGEST / 1024, 1e30f, -1e19f};
enum { HOSTILE = sizeof hostile / sizeof *hostile, NOT_FINITE = 3, SAMPLES = 30 };

/* The status when `output` is not finite: E may mix it with the one after it. */
static lqg_status_t expected_of(const model_t *model, unsigned filter, unsigned output)
{
    const int mixed = filter != STEADY && output == 0 && model->ny > 1 && model->V[1] != 0;
    return REJECTED(output) | (mixed ? REJECTED(1) : LQG_OK);
}

/* One loop in which output `output` says `value` in sample `when`, and for ever with when = SAMPLES. */
static void run_hostile(const model_t *model, unsigned filter, lqg_form_t form, unsigned output, unsigned which,
                        unsigned when)
{
    static loop_t loop;
    double plant[MAX_NX] = {0};
    lqg_real y[MAX_NY], u[MAX_NU] = {0};
    unsigned long seed = 5;

    make_loop(&loop, model, filter, form);
    for (unsigned sample = 0; sample < SAMPLES; sample++) {
        const int is_hostile = sample == when || when == SAMPLES;
        simulate(model, plant, u, y, &seed);
        y[output] = is_hostile ? hostile[which] : y[output];
        const lqg_status_t status = loop_step(&loop, y, u);

        TEST_ASSERT_TRUE(all_finite(&loop.state));
        TEST_ASSERT_TRUE(u[0] >= -1 && u[0] <= 1);
        if (which < NOT_FINITE) {
            TEST_ASSERT_EQUAL_HEX(is_hostile ? expected_of(model, filter, output) : LQG_OK,
                                  status & ~LQG_INPUT_LIMITED);
        } else if (sample < when && when < SAMPLES) {
            TEST_ASSERT_EQUAL_UINT(LQG_OK, status & ~LQG_INPUT_LIMITED);
        }
    }
}

static void run_all_hostile(unsigned filter)
{
    for (unsigned m = 0; m < sizeof models / sizeof *models; m++)
        for (unsigned output = 0; output < models[m]->ny; output++)
            for (unsigned which = 0; which < HOSTILE; which++)
                for (unsigned when = 0; when <= SAMPLES; when++) {
                    run_hostile(models[m], filter, LQG_FILTER_FORM, output, which, when);
                    run_hostile(models[m], filter, LQG_PREDICTOR_FORM, output, which, when);
                }
}

static void test_steady_loop_survives_every_output_at_every_sample(void)
{
    run_all_hostile(STEADY);
}
static void test_plain_loop_survives_every_output_at_every_sample(void)
{
    run_all_hostile(PLAIN);
}
static void test_ud_loop_survives_every_output_at_every_sample(void)
{
    run_all_hostile(UD);
}

static void test_update_without_any_usable_output_changes_nothing_to_the_bit(void)
{
    static loop_t loop;
    const lqg_real y[2] = {NAN, INFINITY}, good[2] = {1, 2};
    lqg_real u[1];
    for (unsigned filter = 0; filter < FILTERS; filter++)
        for (unsigned m = 0; m < sizeof models / sizeof *models; m++) {
            make_loop(&loop, models[m], filter, LQG_FILTER_FORM);
            for (unsigned sample = 0; sample < 5; sample++)
                loop_step(&loop, good, u);
            const state_t before = loop.state;
            TEST_ASSERT_EQUAL_HEX(REJECTED(0) | (models[m]->ny > 1 ? REJECTED(1) : LQG_OK), loop_update(&loop, y));
            TEST_ASSERT_TRUE(same_state(&before, &loop.state));
        }
}

/* A filter of two_mass that knows only its second output. */
static void without_first_output(loop_t *loop)
{
    const model_t *model = loop->model;
    lqg_plant_t *plants[] = {&loop->steady.kalman.plant, &loop->plain.kalman.plant, &loop->ud.kalman.plant};
    for (unsigned i = 0; i < FILTERS; i++) {
        plants[i]->ny = 1;
        plants[i]->C += model->nx;
        plants[i]->D += model->nu;
    }
    loop->plain.kalman.V += 1;
    loop->ud.kalman.V += 1;
}

static void test_an_output_left_out_is_as_if_there_were_none(void)
{
    static loop_t both, one;
    const lqg_real y[2] = {NAN, 1}, second[1] = {1};
    for (unsigned filter = 0; filter < FILTERS; filter++) {
        make_loop(&both, &two_mass, filter, LQG_FILTER_FORM);
        make_loop(&one, &two_mass, filter, LQG_FILTER_FORM);
        without_first_output(&one); /* its L = [0.25 …] is that of the second output too */
        TEST_ASSERT_EQUAL_HEX(REJECTED(0), loop_update(&both, y));
        TEST_ASSERT_EQUAL_UINT(LQG_OK, loop_update(&one, second));
        TEST_ASSERT_TRUE(same_state(&both.state, &one.state));
    }
}

static void test_zeros_of_E_keep_a_NaN_out_of_the_other_outputs(void)
{
    static loop_t loop;
    const lqg_real identity[4] = {1, 0, 0, 1}, y[2] = {NAN, 1};
    for (unsigned filter = PLAIN; filter < FILTERS; filter++) {
        make_loop(&loop, &two_mass, filter, LQG_FILTER_FORM);
        loop.plain.kalman.E = loop.ud.kalman.E = identity;
        const state_t before = loop.state;
        loop_update(&loop, y);
        TEST_ASSERT_FALSE(same_state(&before, &loop.state)); /* the second output still counts */
    }
}

static void test_predict_with_an_input_that_is_no_number_begins_anew(void)
{
    static loop_t loop;
    const lqg_real good[2] = {1, 2}, u[1] = {NAN};
    lqg_real applied[1];
    for (unsigned filter = 0; filter < FILTERS; filter++) {
        make_loop(&loop, &two_mass, filter, LQG_FILTER_FORM);
        const state_t begun = loop.state;
        loop_step(&loop, good, applied);
        loop_update(&loop, good);
        TEST_ASSERT_EQUAL_UINT(LQG_STATE_RESET, loop_predict(&loop, u));
        TEST_ASSERT_TRUE(same_state(&begun, &loop.state));
    }
}

static void test_update_with_a_state_that_is_no_number_begins_anew(void)
{
    static loop_t loop;
    const lqg_real good[2] = {1, 2};
    for (unsigned filter = 0; filter < FILTERS; filter++) {
        make_loop(&loop, &two_mass, filter, LQG_FILTER_FORM);
        const state_t begun = loop.state;
        loop.state.x[1] = NAN;
        loop.state.P[4] = -1;
        loop.state.d[2] = 0.5f;
        TEST_ASSERT_TRUE(loop_update(&loop, good) & LQG_STATE_RESET);
        TEST_ASSERT_TRUE(memcmp(begun.x, loop.state.x, sizeof begun.x) == 0);
        TEST_ASSERT_TRUE(filter != PLAIN || memcmp(begun.P, loop.state.P, sizeof begun.P) == 0);
        TEST_ASSERT_TRUE(filter != UD || memcmp(begun.d, loop.state.d, sizeof begun.d) == 0);
    }
}

static void test_plain_begins_P_anew_when_the_variance_of_an_innovation_is_not_positive(void)
{
    static loop_t loop;
    const lqg_real y[2] = {1, 2};
    make_loop(&loop, &two_mass, PLAIN, LQG_FILTER_FORM);
    const state_t begun = loop.state;
    for (unsigned i = 0; i < LQG_TRIANGLE(4); i++)
        loop.state.P[i] = 0;
    loop.state.P[0] = -1; /* s of the first output = −1 + V; the second has a gain of 0 */
    TEST_ASSERT_EQUAL_UINT(LQG_INNOVATION_NOT_POSITIVE | LQG_COVARIANCE_RESET, loop_update(&loop, y));
    TEST_ASSERT_TRUE(same_state(&begun, &loop.state));
    TEST_ASSERT_EQUAL_UINT(LQG_OK, loop_update(&loop, y));
    for (unsigned i = 0; i < LQG_TRIANGLE(4); i++)
        loop.state.P[i] = 0;
    loop.state.P[0] = -loop.plain.kalman.V[0]; /* s = 0 */
    TEST_ASSERT_EQUAL_UINT(LQG_INNOVATION_NOT_POSITIVE | LQG_COVARIANCE_RESET, loop_update(&loop, y));
}

/* Process noise that makes up for it heals it, too. */
static void test_predict_begins_P_anew_when_a_variance_is_negative(void)
{
    static loop_t loop;
    const lqg_real u[1] = {0};
    for (unsigned filter = PLAIN; filter < FILTERS; filter++)
        for (unsigned i = 0; i < 4; i++) {
            make_loop(&loop, &two_mass, filter, LQG_FILTER_FORM);
            const state_t begun = loop.state;
            loop.state.x[2] = 0.5f;
            loop.state.P[LQG_TRIANGLE(i) + i] = -1000;
            loop.state.d[i] = -1000;
            TEST_ASSERT_EQUAL_UINT(LQG_COVARIANCE_RESET, loop_predict(&loop, u));
            TEST_ASSERT_TRUE(loop.state.x[2] > 0.4f);
            TEST_ASSERT_TRUE(filter != PLAIN || memcmp(begun.P, loop.state.P, sizeof begun.P) == 0);
            TEST_ASSERT_TRUE(filter != UD || memcmp(begun.d, loop.state.d, sizeof begun.d) == 0);
            TEST_ASSERT_TRUE(filter != UD || memcmp(begun.U, loop.state.U, sizeof begun.U) == 0);
            TEST_ASSERT_EQUAL_UINT(LQG_OK, loop_predict(&loop, u));
        }
}

static void test_predict_begins_P_anew_when_it_overflows(void)
{
    static loop_t loop;
    const lqg_real u[1] = {0};
    for (unsigned filter = PLAIN; filter < FILTERS; filter++) {
        make_loop(&loop, &two_mass, filter, LQG_FILTER_FORM);
        const state_t begun = loop.state;
        loop.state.P[0] = loop.state.P[2] = loop.state.d[0] = loop.state.d[1] = LARGEST;
        loop.state.x[0] = 0.5f;
        TEST_ASSERT_EQUAL_UINT(LQG_COVARIANCE_RESET, loop_predict(&loop, u));
        TEST_ASSERT_TRUE(loop.state.x[0] > 0.4f);
        TEST_ASSERT_TRUE(filter != PLAIN || memcmp(begun.P, loop.state.P, sizeof begun.P) == 0);
        TEST_ASSERT_TRUE(filter != UD || memcmp(begun.d, loop.state.d, sizeof begun.d) == 0);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_steady_loop_survives_every_output_at_every_sample);
    RUN_TEST(test_plain_loop_survives_every_output_at_every_sample);
    RUN_TEST(test_ud_loop_survives_every_output_at_every_sample);
    RUN_TEST(test_update_without_any_usable_output_changes_nothing_to_the_bit);
    RUN_TEST(test_an_output_left_out_is_as_if_there_were_none);
    RUN_TEST(test_zeros_of_E_keep_a_NaN_out_of_the_other_outputs);
    RUN_TEST(test_predict_with_an_input_that_is_no_number_begins_anew);
    RUN_TEST(test_update_with_a_state_that_is_no_number_begins_anew);
    RUN_TEST(test_plain_begins_P_anew_when_the_variance_of_an_innovation_is_not_positive);
    RUN_TEST(test_predict_begins_P_anew_when_a_variance_is_negative);
    RUN_TEST(test_predict_begins_P_anew_when_it_overflows);
    return UNITY_END();
}
