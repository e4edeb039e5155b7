/* SPDX-License-Identifier: MIT */
/* Updates by some of the outputs, by one alone, at several rates; what is told; and plants that vary. */
#include <math.h>
#include <string.h>

#include "loop.h"
#include "textbook.h"
#include "unity.h"

void setUp(void) {}
void tearDown(void) {}

/* About 100 roundings a sample, each forgotten within about 100 samples, as the slower sensor speaks every
 * fifth. */
#define TOLERANCE (5000 * EPSILON)

static const model_t *const models[] = {&double_integrator, &two_mass, &correlated, &cross_noise, &random_walk};
enum { MODELS = sizeof models / sizeof *models };

static loop_t tested, other; /* here once for all tests: small targets have little memory */

static lqg_status_t update_output(loop_t *loop, unsigned i, lqg_real y_i)
{
    if (loop->filter == STEADY)
        return steady_update_output(&loop->steady.kalman, &loop->state, y_i, i, NULL);
    if (loop->filter == PLAIN)
        return plain_update_output(&loop->plain.kalman, &loop->state, y_i, i, NULL);
    return ud_update_output(&loop->ud.kalman, &loop->state, y_i, i, NULL);
}

static void test_watch_over_all_outputs_changes_no_bit_of_the_update(void)
{
    const lqg_real y[MAX_NY] = {0.5f, -0.25f};
    lqg_real innovation[MAX_NY], S[MAX_NY];
    unsigned char heard[MAX_NY];
    const lqg_watch_t watches[] = {{NULL, NULL, NULL}, {innovation, S, heard}};

    for (unsigned filter = 0; filter < FILTERS; filter++)
        for (unsigned m = 0; m < MODELS; m++)
            for (unsigned w = 0; w < 2; w++) {
                make_running_loop(&tested, models[m], filter);
                make_running_loop(&other, models[m], filter);
                TEST_ASSERT_EQUAL_UINT(LQG_OK, loop_update(&tested, y));
                TEST_ASSERT_EQUAL_UINT(LQG_OK, loop_partial_update(&other, y, LQG_ALL_OUTPUTS, &watches[w]));
                TEST_ASSERT_TRUE(same_state(&tested.state, &other.state));
            }
}

static void test_outputs_one_by_one_change_no_bit_of_the_update(void)
{
    const lqg_real y[MAX_NY] = {0.5f, -0.25f};
    const model_t *const independent[] = {&double_integrator, &two_mass, &random_walk}; /* no E, no M */

    for (unsigned filter = PLAIN; filter < FILTERS; filter++)
        for (unsigned m = 0; m < 3; m++) {
            make_running_loop(&tested, independent[m], filter);
            make_running_loop(&other, independent[m], filter);
            TEST_ASSERT_EQUAL_UINT(LQG_OK, loop_update(&tested, y));
            for (unsigned i = 0; i < independent[m]->ny; i++)
                TEST_ASSERT_EQUAL_UINT(LQG_OK, update_output(&other, i, y[i]));
            TEST_ASSERT_TRUE(same_state(&tested.state, &other.state));
        }
}

static void test_one_output_alone_is_a_mask_with_one_output_even_when_w_and_v_are_correlated(void)
{
    const lqg_real y[MAX_NY] = {0.5f, NAN};

    for (unsigned filter = 0; filter < FILTERS; filter++)
        for (unsigned m = 0; m < MODELS; m++) {
            make_running_loop(&tested, models[m], filter);
            make_running_loop(&other, models[m], filter);
            TEST_ASSERT_EQUAL_UINT(LQG_OK, loop_partial_update(&tested, y, 1ul << 0, NULL));
            TEST_ASSERT_EQUAL_UINT(LQG_OK, update_output(&other, 0, y[0]));
            TEST_ASSERT_TRUE(same_state(&tested.state, &other.state));
        }
}

static void test_one_output_that_is_left_out_has_nothing_for_the_prediction(void)
{
    for (unsigned filter = 0; filter < FILTERS; filter++) {
        make_running_loop(&tested, &cross_noise, filter);
        TEST_ASSERT_EQUAL_HEX(REJECTED(0), update_output(&tested, 0, NAN));
        TEST_ASSERT_TRUE(tested.state.innovation[0] == 0);
    }
}

/* Without a gate a constant gain needs no variances. */
static void test_variance_that_nobody_gives_is_told_as_zero(void)
{
    const lqg_real y[MAX_NY] = {0.5f, -0.25f};
    lqg_real S[MAX_NY] = {7, 7};
    const lqg_watch_t watch = {NULL, S, NULL};

    make_running_loop(&tested, &two_mass, STEADY);
    TEST_ASSERT_EQUAL_UINT(LQG_OK, loop_partial_update(&tested, y, LQG_ALL_OUTPUTS, &watch));
    TEST_ASSERT_TRUE(S[0] == 0 && S[1] == 0);
}

static void test_an_output_not_used_is_one_that_is_no_number_but_goes_unreported(void)
{
    const lqg_real y[MAX_NY] = {INFINITY, -0.25f}, one_is_nan[MAX_NY] = {NAN, -0.25f};
    const unsigned long second = 1ul << 1;

    for (unsigned filter = 0; filter < FILTERS; filter++) {
        make_running_loop(&tested, &two_mass, filter);
        make_running_loop(&other, &two_mass, filter);
        TEST_ASSERT_EQUAL_UINT(LQG_OK, loop_partial_update(&tested, y, second, NULL));
        TEST_ASSERT_EQUAL_HEX(REJECTED(0), loop_update(&other, one_is_nan));
        TEST_ASSERT_TRUE(same_state(&tested.state, &other.state));
    }
}

static void test_an_output_that_E_mixes_with_an_unused_one_is_left_out_and_reported(void)
{
    const lqg_real y[MAX_NY] = {0.5f, -0.25f};
    const unsigned long second = 1ul << 1;

    for (unsigned filter = PLAIN; filter < FILTERS; filter++) {
        make_running_loop(&tested, &correlated, filter);
        const state_t before = tested.state;
        TEST_ASSERT_EQUAL_HEX(REJECTED(1), loop_partial_update(&tested, y, second, NULL));
        TEST_ASSERT_EQUAL_HEX(REJECTED(1), update_output(&tested, 1, y[1]));
        TEST_ASSERT_TRUE(same_state(&before, &tested.state));
    }
}

/* The model with output i alone, or with none. */
static model_t with_output(const model_t *model, unsigned i)
{
    model_t one = *model;
    one.ny = 1;
    memcpy(one.C, model->C + i * model->nx, model->nx * sizeof *one.C);
    memcpy(one.D, model->D + i * model->nu, model->nu * sizeof *one.D);
    one.V[0] = model->V[i * model->ny + i];
    return one;
}

/* Neither x̂ nor P grows beyond 10 in these runs. */
static void assert_prior(const model_t *model, const loop_t *loop, const textbook_t *textbook)
{
    for (unsigned i = 0; i < model->nx; i++) {
        TEST_ASSERT_DOUBLE_WITHIN(TOLERANCE * 10, textbook->x_prior[i], (double)loop->state.x[i]);
        for (unsigned j = 0; j <= i; j++) {
            const double P_ij = textbook->P_prior[i * model->nx + j];
            const double ours = loop->filter == PLAIN ? (double)loop->state.P[LQG_TRIANGLE(i) + j]
                                                      : ud_covariance(loop->state.U, loop->state.d, model->nx, i, j);
            TEST_ASSERT_DOUBLE_WITHIN(TOLERANCE * 10, P_ij, ours);
        }
    }
}

/* Output 0 every second sample, output 1 every fifth: both, one or none. */
static void test_sensors_of_two_rates_follow_the_textbook(void)
{
    const model_t single[2] = {with_output(&two_mass, 0), with_output(&two_mass, 1)};
    textbook_t textbook;

    for (unsigned filter = PLAIN; filter < FILTERS; filter++) {
        unsigned long seed = 11;
        double plant[MAX_NX] = {0};
        lqg_real y[MAX_NY], u[MAX_NU] = {0};
        make_loop(&tested, &two_mass, filter, LQG_FILTER_FORM);
        textbook_init(&two_mass, &textbook);
        for (unsigned sample = 0; sample < 200; sample++) {
            const unsigned first = sample % 2 == 0, second = sample % 5 == 0;
            simulate(&two_mass, plant, u, y, &seed);
            const model_t *model = first && second ? &two_mass : first ? &single[0] : &single[1];
            model_t none = *model;
            none.ny = 0;
            model = first || second ? model : &none;
            textbook_update(model, &textbook, model == &single[1] ? y + 1 : y, u);
            for (unsigned i = 0; i < 2; i++)
                if (i == 0 ? first : second)
                    TEST_ASSERT_EQUAL_UINT(LQG_OK, update_output(&tested, i, y[i]));
            u[0] = (lqg_real)noise(&seed) / 8;
            textbook_predict(model, &textbook, u);
            TEST_ASSERT_EQUAL_UINT(LQG_OK, loop_predict(&tested, u));
            assert_prior(&two_mass, &tested, &textbook);
        }
    }
}

/* A plant all of whose matrices change from sample to sample. */
static model_t model_of(unsigned sample)
{
    model_t model = two_mass;
    const double wave = sin(0.1 * sample);
    model.A[4] *= 1 + 0.5 * wave;
    model.A[5] = 0.9 - 0.05 * wave;
    model.B[1] = 0.5 + 0.3 * wave;
    model.C[2] = 0.25 * wave;
    model.W[5] += 0.001 * wave * wave;
    model.V[0] *= 2 + wave;
    return model;
}

static void test_a_plant_that_varies_follows_the_textbook(void)
{
    textbook_t textbook;

    for (unsigned filter = PLAIN; filter < FILTERS; filter++) {
        unsigned long seed = 13;
        double plant[MAX_NX] = {0};
        lqg_real y[MAX_NY], u[MAX_NU] = {0};
        make_loop(&tested, &two_mass, filter, LQG_FILTER_FORM);
        textbook_init(&two_mass, &textbook);
        for (unsigned sample = 0; sample < 200; sample++) {
            const model_t model = model_of(sample);
            prepare_online(&model, &tested.online);
            tested.plain.kalman = tested.online.plain;
            tested.ud.kalman = tested.online.ud;

            simulate(&model, plant, u, y, &seed);
            textbook_update(&model, &textbook, y, u);
            TEST_ASSERT_EQUAL_UINT(LQG_OK, loop_update(&tested, y));
            u[0] = (lqg_real)noise(&seed) / 8;
            textbook_predict(&model, &textbook, u);
            TEST_ASSERT_EQUAL_UINT(LQG_OK, loop_predict(&tested, u));
            assert_prior(&model, &tested, &textbook);
        }
    }
}

static void test_innovation_and_its_variance_are_those_of_the_textbook(void)
{
    textbook_t textbook;
    lqg_real y[1] = {0.75f}, u[1] = {0.5f}, innovation[1], S[1];
    const lqg_watch_t watch = {innovation, S, NULL};

    for (unsigned filter = PLAIN; filter < FILTERS; filter++)
        for (unsigned output = 0; output < 2; output++) {
            const model_t model = with_output(&two_mass, output);
            make_loop(&tested, &model, filter, LQG_FILTER_FORM);
            textbook_init(&model, &textbook);
            textbook_update(&model, &textbook, y, tested.state.u_applied);
            loop_update(&tested, y);
            textbook_predict(&model, &textbook, u);
            loop_predict(&tested, u);
            textbook_update(&model, &textbook, y, u);
            TEST_ASSERT_EQUAL_UINT(LQG_OK, loop_partial_update(&tested, y, LQG_ALL_OUTPUTS, &watch));
            TEST_ASSERT_DOUBLE_WITHIN(TOLERANCE, textbook.innovation[0], (double)innovation[0]);
            TEST_ASSERT_DOUBLE_WITHIN(TOLERANCE, textbook.S[0], (double)S[0]);
        }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_watch_over_all_outputs_changes_no_bit_of_the_update);
    RUN_TEST(test_outputs_one_by_one_change_no_bit_of_the_update);
    RUN_TEST(test_one_output_alone_is_a_mask_with_one_output_even_when_w_and_v_are_correlated);
    RUN_TEST(test_one_output_that_is_left_out_has_nothing_for_the_prediction);
    RUN_TEST(test_variance_that_nobody_gives_is_told_as_zero);
    RUN_TEST(test_an_output_not_used_is_one_that_is_no_number_but_goes_unreported);
    RUN_TEST(test_an_output_that_E_mixes_with_an_unused_one_is_left_out_and_reported);
    RUN_TEST(test_sensors_of_two_rates_follow_the_textbook);
    RUN_TEST(test_a_plant_that_varies_follows_the_textbook);
    RUN_TEST(test_innovation_and_its_variance_are_those_of_the_textbook);
    return UNITY_END();
}
