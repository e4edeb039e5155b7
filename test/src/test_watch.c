/* SPDX-License-Identifier: MIT */
/* Updates by some of the outputs, by one alone, at several rates, with a gate; and plants that vary. */
#include <math.h>
#include <string.h>

#include "loop.h"
#include "textbook.h"
#include "unity.h"

void setUp(void)
{
}
void tearDown(void)
{
}

/* About 100 roundings a sample, each forgotten within about 100 samples, as the slower sensor speaks every
 * fifth. */
#define TOLERANCE (5000 * EPSILON)

static const model_t *const models[] = {&double_integrator, &two_mass, &correlated, &cross_noise,
                                        &random_walk};
enum { MODELS = sizeof models / sizeof *models };

static loop_t tested, other; /* here once for all tests: small targets have little memory */

/* Of the loop's constant gain: any variances, as its gain is not the best one either. */
static const lqg_real steady_s[MAX_NY] = {0.5f, 0.25f};

static lqg_status update_watched(loop_t *loop, const lqg_real y[], const lqg_watch_t *watch)
{
    state_t *s = &loop->state;
    if (loop->filter == STEADY)
        return lqg_kalman_steady_update_watched(&loop->steady.kalman, s->x, s->u_applied, s->innovation, y,
                                                steady_s, watch, s->work);
    if (loop->filter == PLAIN)
        return lqg_kalman_plain_update_watched(&loop->plain.kalman, s->x, s->P, s->u_applied, s->innovation,
                                               y, watch, s->work);
    return lqg_kalman_ud_update_watched(&loop->ud.kalman, s->x, s->U, s->d, s->u_applied, s->innovation, y,
                                        watch, s->work);
}

static lqg_status update_output(loop_t *loop, unsigned i, lqg_real y_i, const lqg_watch_t *watch)
{
    state_t *s = &loop->state;
    if (loop->filter == STEADY)
        return lqg_kalman_steady_update_output(&loop->steady.kalman, s->x, s->u_applied, s->innovation, i,
                                               y_i, steady_s, watch);
    if (loop->filter == PLAIN)
        return lqg_kalman_plain_update_output(&loop->plain.kalman, s->x, s->P, s->u_applied, s->innovation, i,
                                              y_i, watch, s->work);
    return lqg_kalman_ud_update_output(&loop->ud.kalman, s->x, s->U, s->d, s->u_applied, s->innovation, i,
                                       y_i, watch, s->work);
}

/* A loop some samples after its beginning. */
static void make_running_loop(loop_t *loop, const model_t *model, unsigned filter)
{
    lqg_real y[MAX_NY], u[MAX_NU] = {0};
    double plant[MAX_NX] = {0};
    unsigned long seed = 3;

    make_loop(loop, model, filter, LQG_FILTER_FORM);
    for (unsigned sample = 0; sample < 5; sample++) {
        simulate(model, plant, u, y, &seed);
        loop_step(loop, y, u);
    }
}

static void test_watch_over_all_outputs_changes_no_bit_of_the_update(void)
{
    const lqg_real y[MAX_NY] = {0.5f, -0.25f};
    const unsigned char all[MAX_NY] = {1, 1};
    unsigned long gated[MAX_NY] = {0};
    lqg_real nu[MAX_NY], s[MAX_NY];
    const lqg_watch_t watches[] = {{NULL, 0, NULL, NULL, NULL, NULL, NULL, NULL, NULL}, {all, 1000, gated, nu, s, NULL, NULL, NULL, NULL}};

    for (unsigned filter = 0; filter < FILTERS; filter++)
        for (unsigned m = 0; m < MODELS; m++)
            for (unsigned w = 0; w < 2; w++) {
                make_running_loop(&tested, models[m], filter);
                make_running_loop(&other, models[m], filter);
                TEST_ASSERT_EQUAL_UINT(LQG_OK, loop_update(&tested, y));
                TEST_ASSERT_EQUAL_UINT(LQG_OK, update_watched(&other, y, &watches[w]));
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
                TEST_ASSERT_EQUAL_UINT(LQG_OK, update_output(&other, i, y[i], NULL));
            TEST_ASSERT_TRUE(same_state(&tested.state, &other.state));
        }
}

static void test_one_output_alone_is_a_mask_with_one_output_even_when_w_and_v_are_correlated(void)
{
    const lqg_real y[MAX_NY] = {0.5f, NAN};
    const unsigned char first[MAX_NY] = {1, 0};
    const lqg_watch_t watch = {first, 0, NULL, NULL, NULL, NULL, NULL, NULL, NULL};

    for (unsigned filter = 0; filter < FILTERS; filter++)
        for (unsigned m = 0; m < MODELS; m++) {
            make_running_loop(&tested, models[m], filter);
            make_running_loop(&other, models[m], filter);
            TEST_ASSERT_EQUAL_UINT(LQG_OK, update_watched(&tested, y, &watch));
            TEST_ASSERT_EQUAL_UINT(LQG_OK, update_output(&other, 0, y[0], NULL));
            TEST_ASSERT_TRUE(same_state(&tested.state, &other.state));
        }
}

static void test_one_output_that_is_left_out_has_nothing_for_the_prediction(void)
{
    for (unsigned filter = 0; filter < FILTERS; filter++) {
        make_running_loop(&tested, &cross_noise, filter);
        TEST_ASSERT_EQUAL_UINT(LQG_OUTPUT_NOT_FINITE, update_output(&tested, 0, NAN, NULL));
        TEST_ASSERT_TRUE(tested.state.innovation[0] == 0);
    }
}

/* Without a gate a constant gain needs no variances. */
static void test_variance_that_nobody_gives_is_told_as_zero(void)
{
    const lqg_real y[MAX_NY] = {0.5f, -0.25f};
    lqg_real s[MAX_NY] = {7, 7};
    const lqg_watch_t watch = {NULL, 0, NULL, NULL, s, NULL, NULL, NULL, NULL};
    state_t *state = &tested.state;

    make_running_loop(&tested, &two_mass, STEADY);
    TEST_ASSERT_EQUAL_UINT(LQG_OK, lqg_kalman_steady_update_watched(&tested.steady.kalman, state->x, state->u_applied,
                                                                    state->innovation, y, NULL, &watch, state->work));
    TEST_ASSERT_TRUE(s[0] == 0 && s[1] == 0);
}

static void test_an_output_not_used_is_one_that_is_no_number_but_goes_unreported(void)
{
    const lqg_real y[MAX_NY] = {INFINITY, -0.25f}, one_is_nan[MAX_NY] = {NAN, -0.25f};
    const unsigned char second[MAX_NY] = {0, 1};
    const lqg_watch_t watch = {second, 0, NULL, NULL, NULL, NULL, NULL, NULL, NULL};

    for (unsigned filter = 0; filter < FILTERS; filter++) {
        make_running_loop(&tested, &two_mass, filter);
        make_running_loop(&other, &two_mass, filter);
        TEST_ASSERT_EQUAL_UINT(LQG_OK, update_watched(&tested, y, &watch));
        TEST_ASSERT_EQUAL_UINT(LQG_OUTPUT_NOT_FINITE, loop_update(&other, one_is_nan));
        TEST_ASSERT_TRUE(same_state(&tested.state, &other.state));
    }
}

static void test_an_output_that_E_mixes_with_an_unused_one_is_left_out_and_reported(void)
{
    const lqg_real y[MAX_NY] = {0.5f, -0.25f};
    const unsigned char second[MAX_NY] = {0, 1};
    const lqg_watch_t watch = {second, 0, NULL, NULL, NULL, NULL, NULL, NULL, NULL};

    for (unsigned filter = PLAIN; filter < FILTERS; filter++) {
        make_running_loop(&tested, &correlated, filter);
        const state_t before = tested.state;
        TEST_ASSERT_EQUAL_UINT(LQG_OUTPUT_NOT_FINITE, update_watched(&tested, y, &watch));
        TEST_ASSERT_EQUAL_UINT(LQG_OUTPUT_NOT_FINITE, update_output(&tested, 1, y[1], NULL));
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
            const double ours = loop->filter == PLAIN
                                    ? (double)loop->state.P[LQG_TRIANGLE(i) + j]
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
                    TEST_ASSERT_EQUAL_UINT(LQG_OK, update_output(&tested, i, y[i], NULL));
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
    lqg_real y[1] = {0.75f}, u[1] = {0.5f}, nu[1], s[1];
    const lqg_watch_t watch = {NULL, 0, NULL, nu, s, NULL, NULL, NULL, NULL};

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
            TEST_ASSERT_EQUAL_UINT(LQG_OK, update_watched(&tested, y, &watch));
            TEST_ASSERT_DOUBLE_WITHIN(TOLERANCE, textbook.innovation[0], (double)nu[0]);
            TEST_ASSERT_DOUBLE_WITHIN(TOLERANCE, textbook.S[0], (double)s[0]);
        }
}

/* The first output alone, `sigmas` standard deviations from what is expected. */
static lqg_status update_with_outlier(loop_t *loop, double sigmas, const lqg_watch_t *watch)
{
    lqg_real y[MAX_NY] = {0}, nu[MAX_NY] = {0}, s[MAX_NY] = {0};
    const lqg_watch_t look = {watch->used, 0, NULL, nu, s, NULL, NULL, NULL, NULL};
    const state_t before = loop->state;

    update_watched(loop, y, &look); /* of y = 0, to see what is expected */
    loop->state = before;
    y[0] = (lqg_real)(sigmas * sqrt((double)s[0]) - (double)nu[0]);
    return update_watched(loop, y, watch);
}

static void test_gate_leaves_out_what_lies_beyond_it_and_counts(void)
{
    unsigned long gated[MAX_NY];
    const unsigned char first[MAX_NY] = {1, 0};
    const lqg_watch_t watch = {first, 3, gated, NULL, NULL, NULL, NULL, NULL, NULL};

    for (unsigned filter = 0; filter < FILTERS; filter++)
        for (unsigned m = 0; m < MODELS; m++) {
            gated[0] = gated[1] = 0;
            make_running_loop(&tested, models[m], filter);
            TEST_ASSERT_EQUAL_UINT(LQG_OK, update_with_outlier(&tested, 2.99, &watch));
            make_running_loop(&tested, models[m], filter);
            TEST_ASSERT_EQUAL_UINT(LQG_OUTPUT_GATED, update_with_outlier(&tested, 3.01, &watch));
            TEST_ASSERT_EQUAL_UINT(LQG_OUTPUT_GATED, update_with_outlier(&tested, -1e6, &watch));
            TEST_ASSERT_EQUAL_UINT32(2, gated[0]);
        }
}

static void test_gate_may_be_less_than_one_standard_deviation(void)
{
    const unsigned char first[MAX_NY] = {1, 0};
    const lqg_watch_t watch = {first, 0.5f, NULL, NULL, NULL, NULL, NULL, NULL, NULL};

    for (unsigned filter = 0; filter < FILTERS; filter++) {
        make_running_loop(&tested, &two_mass, filter);
        TEST_ASSERT_EQUAL_UINT(LQG_OUTPUT_GATED, update_with_outlier(&tested, 0.51, &watch));
        TEST_ASSERT_EQUAL_UINT(LQG_OK, update_with_outlier(&tested, 0.49, &watch));
    }
}

/* 2² s = 1² with s = 0.25, all of them exact. */
static void test_output_right_at_the_gate_is_let_in(void)
{
    const unsigned char second[MAX_NY] = {0, 1};
    const lqg_watch_t watch = {second, 2, NULL, NULL, NULL, NULL, NULL, NULL, NULL};
    const lqg_real at[MAX_NY] = {0, 1}, beyond[MAX_NY] = {0, 1.0001f};

    make_loop(&tested, &two_mass, STEADY, LQG_FILTER_FORM);
    memset(tested.state.x, 0, sizeof tested.state.x);
    TEST_ASSERT_EQUAL_UINT(LQG_OUTPUT_GATED, update_watched(&tested, beyond, &watch));
    TEST_ASSERT_EQUAL_UINT(LQG_OK, update_watched(&tested, at, &watch));
}

static void test_a_gated_output_does_not_come_in_by_way_of_one_that_is_freed_of_its_noise(void)
{
    const lqg_real y[MAX_NY] = {1e6f, -0.25f}, missing[MAX_NY] = {NAN, -0.25f};
    const lqg_watch_t watch = {NULL, 3, NULL, NULL, NULL, NULL, NULL, NULL, NULL};

    for (unsigned filter = PLAIN; filter < FILTERS; filter++) {
        make_running_loop(&tested, &correlated, filter);
        make_running_loop(&other, &correlated, filter);
        TEST_ASSERT_EQUAL_UINT(LQG_OUTPUT_GATED | LQG_OUTPUT_NOT_FINITE, update_watched(&tested, y, &watch));
        TEST_ASSERT_EQUAL_UINT(LQG_OUTPUT_NOT_FINITE, loop_update(&other, missing));
        TEST_ASSERT_TRUE(same_state(&tested.state, &other.state));
    }
}

/* Of outputs that are used, far off, no number, and not asked for; with a gate and without. */
static void test_heard_tells_which_outputs_were_used(void)
{
    static const lqg_real widen[MAX_NY] = {1.5f, 1.5f}, narrow[MAX_NY] = {0.75f, 0.75f};
    const unsigned char all[MAX_NY] = {1, 1}, second[MAX_NY] = {0, 1};
    lqg_real widening[MAX_NY];
    unsigned char heard[MAX_NY];

    for (unsigned filter = 0; filter < FILTERS; filter++)
        for (unsigned k = 0; k < 8; k++) {
            const lqg_real y[MAX_NY] = {k & 1 ? (lqg_real)NAN : 1e6f, 0};
            const int has_gate = k & 2, asks_for_both = k & 4;
            const lqg_watch_t watch = {asks_for_both ? all : second,      has_gate ? 1000 : 0, NULL, NULL, NULL,
                                       has_gate ? widening : NULL, widen, narrow, heard};

            widening[0] = widening[1] = 1;
            heard[0] = heard[1] = 7;
            make_running_loop(&tested, &two_mass, filter);
            (void)update_watched(&tested, y, &watch);
            TEST_ASSERT_EQUAL_UINT(asks_for_both && !has_gate && !(k & 1), heard[0]);
            TEST_ASSERT_EQUAL_UINT(1, heard[1]);
        }
}

static void test_a_gated_output_is_one_that_is_not_used(void)
{
    const lqg_real y[MAX_NY] = {1e6f, -0.25f};
    const unsigned char second[MAX_NY] = {0, 1};
    const lqg_watch_t gate = {NULL, 1000, NULL, NULL, NULL, NULL, NULL, NULL, NULL}, mask = {second, 0, NULL, NULL, NULL, NULL, NULL, NULL, NULL};

    for (unsigned filter = 0; filter < FILTERS; filter++) {
        make_running_loop(&tested, &two_mass, filter);
        make_running_loop(&other, &two_mass, filter);
        TEST_ASSERT_EQUAL_UINT(LQG_OUTPUT_GATED, update_watched(&tested, y, &gate));
        TEST_ASSERT_EQUAL_UINT(LQG_OK, update_watched(&other, y, &mask));
        TEST_ASSERT_TRUE(same_state(&tested.state, &other.state));
    }
}

/* Within 2⁸⁰ = 1.5¹³⁷, whatever w was. */
static void test_gate_opens_for_an_output_that_is_left_out_again_and_again_and_narrows_again(void)
{
    const lqg_real widen[MAX_NY] = {1.5f, 1.5f}, narrow[MAX_NY] = {0.5f, 0.5f}, begun[] = {1, 0, -4, NAN, INFINITY, -INFINITY};
    const unsigned char first[MAX_NY] = {1, 0};

    for (unsigned filter = 0; filter < FILTERS; filter++)
        for (unsigned b = 0; b < sizeof begun / sizeof *begun; b++) {
            lqg_real widening[MAX_NY] = {begun[b], begun[b]};
            const lqg_watch_t watch = {first, 3, NULL, NULL, NULL, widening, widen, narrow, NULL};
            unsigned samples = 0;
            make_running_loop(&tested, &two_mass, filter);
            const state_t before = tested.state;
            while (update_with_outlier(&tested, 1e6, &watch) == LQG_OUTPUT_GATED && samples < 200) {
                TEST_ASSERT_TRUE(widening[0] >= 1);
                samples++;
            }
            TEST_ASSERT_TRUE(samples <= 64); /* (1e6/3)² = 1.5^62.7 */
            tested.state = before;
            for (unsigned k = 0; k < 80; k++)
                TEST_ASSERT_EQUAL_UINT(LQG_OK, update_with_outlier(&tested, 0, &watch));
            TEST_ASSERT_TRUE(widening[0] == 1);
            TEST_ASSERT_EQUAL_UINT(LQG_OUTPUT_GATED, update_with_outlier(&tested, 3.1, &watch));
        }
}

static void test_gate_is_never_wider_than_the_widest(void)
{
    const lqg_real same[MAX_NY] = {1, 1};
    const unsigned char first[MAX_NY] = {1, 0};

    for (unsigned filter = 0; filter < FILTERS; filter++) {
        lqg_real widening[MAX_NY] = {INFINITY, 1};
        const lqg_watch_t watch = {first, 3, NULL, NULL, NULL, widening, same, same, NULL};
        make_running_loop(&tested, &two_mass, filter);
        TEST_ASSERT_EQUAL_UINT(LQG_OK, update_with_outlier(&tested, 0, &watch));
        TEST_ASSERT_TRUE(widening[0] == (lqg_real)1208925819614629174706176.0f); /* 2⁸⁰ */
    }
}

/* P grows by itself while nothing is heard; of a constant gain the gate does. */
static void test_silence_opens_the_gate_of_a_constant_gain_only(void)
{
    const lqg_real widen[MAX_NY] = {1.5f, 1.5f}, narrow[MAX_NY] = {0.5f, 0.5f}, y[MAX_NY] = {NAN, 0};
    const unsigned char first[MAX_NY] = {1, 0};

    for (unsigned filter = 0; filter < FILTERS; filter++) {
        lqg_real widening[MAX_NY] = {4, 4};
        const lqg_watch_t watch = {first, 1000, NULL, NULL, NULL, widening, widen, narrow, NULL};
        make_running_loop(&tested, &two_mass, filter);
        TEST_ASSERT_EQUAL_UINT(LQG_OUTPUT_NOT_FINITE, update_watched(&tested, y, &watch));
        TEST_ASSERT_TRUE(widening[0] == (filter == STEADY ? 6 : 4));
        TEST_ASSERT_TRUE(widening[1] == (filter == STEADY ? 6 : 4));
    }
}

static void test_an_output_that_is_no_number_is_not_the_gate_s_business(void)
{
    const lqg_real y[MAX_NY] = {NAN, NAN};
    unsigned long gated[MAX_NY] = {0};
    lqg_real nu[MAX_NY] = {7, 7}, s[MAX_NY] = {0};
    const lqg_watch_t watch = {NULL, 3, gated, nu, s, NULL, NULL, NULL, NULL};

    for (unsigned filter = 0; filter < FILTERS; filter++) {
        make_running_loop(&tested, &two_mass, filter);
        TEST_ASSERT_EQUAL_UINT(LQG_OUTPUT_NOT_FINITE, update_watched(&tested, y, &watch));
        TEST_ASSERT_EQUAL_UINT32(0, gated[0] + gated[1]);
        TEST_ASSERT_TRUE(nu[0] == 0 && nu[1] == 0 && s[0] > 0 && s[1] > 0);
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
    RUN_TEST(test_gate_leaves_out_what_lies_beyond_it_and_counts);
    RUN_TEST(test_gate_may_be_less_than_one_standard_deviation);
    RUN_TEST(test_output_right_at_the_gate_is_let_in);
    RUN_TEST(test_a_gated_output_does_not_come_in_by_way_of_one_that_is_freed_of_its_noise);
    RUN_TEST(test_heard_tells_which_outputs_were_used);
    RUN_TEST(test_a_gated_output_is_one_that_is_not_used);
    RUN_TEST(test_gate_opens_for_an_output_that_is_left_out_again_and_again_and_narrows_again);
    RUN_TEST(test_gate_is_never_wider_than_the_widest);
    RUN_TEST(test_silence_opens_the_gate_of_a_constant_gain_only);
    RUN_TEST(test_an_output_that_is_no_number_is_not_the_gate_s_business);
    return UNITY_END();
}
