/* SPDX-License-Identifier: MIT */
/* Filter and regulator together: the recipe of a sample, and memory of exactly the sizes that the macros say.
 * */
#include <stdlib.h>
#include <string.h>

#include "loop.h"
#include "unity.h"

void setUp(void) {}
void tearDown(void) {}

static const model_t *const models[] = {&double_integrator, &two_mass, &correlated, &cross_noise};

static lqg_status three_calls(loop_t *loop, lqg_form_t form, const lqg_real y[], lqg_real u[])
{
    lqg_status status = LQG_OK;
    if (form == LQG_PREDICTOR_FORM)
        status |= loop_control(loop, u);
    status |= loop_update(loop, y);
    if (form == LQG_FILTER_FORM)
        status |= loop_control(loop, u);
    return status | loop_predict(loop, u);
}

static void compare_step_with_calls(const model_t *model, unsigned filter, lqg_form_t form)
{
    static loop_t stepped, called;
    double plant[MAX_NX] = {0};
    lqg_real y[MAX_NY], u[MAX_NU] = {0}, u_called[MAX_NU];
    unsigned long seed = 3;

    make_loop(&stepped, model, filter, form);
    make_loop(&called, model, filter, form);
    for (unsigned sample = 0; sample < 200; sample++) {
        simulate(model, plant, u, y, &seed);
        const lqg_status status = loop_step(&stepped, y, u);
        TEST_ASSERT_EQUAL_UINT(status, three_calls(&called, form, y, u_called));
        TEST_ASSERT_TRUE(memcmp(u, u_called, model->nu * sizeof *u) == 0);
        TEST_ASSERT_TRUE(same_state(&stepped.state, &called.state));
    }
}

static void test_step_is_its_three_calls_in_the_order_of_the_form(void)
{
    for (unsigned filter = 0; filter < FILTERS; filter++)
        for (unsigned m = 0; m < sizeof models / sizeof *models; m++) {
            compare_step_with_calls(models[m], filter, LQG_FILTER_FORM);
            compare_step_with_calls(models[m], filter, LQG_PREDICTOR_FORM);
        }
}

static void test_the_forms_differ_in_the_estimate_that_u_is_made_of(void)
{
    static loop_t filter, predictor;
    const lqg_real y[1] = {4};
    lqg_real u_filter[1], u_predictor[1];
    make_loop(&filter, &double_integrator, PLAIN, LQG_FILTER_FORM);
    make_loop(&predictor, &double_integrator, PLAIN, LQG_PREDICTOR_FORM);
    loop_step(&filter, y, u_filter);
    loop_step(&predictor, y, u_predictor);
    TEST_ASSERT_TRUE(u_predictor[0] == 0); /* x0 = 0 */
    TEST_ASSERT_TRUE(u_filter[0] < 0);
}

static void test_predictor_form_takes_its_own_u_out_of_y(void)
{
    static loop_t loop;
    lqg_real y[2], u[1], x0[4];
    make_loop(&loop, &two_mass, STEADY, LQG_PREDICTOR_FORM);
    memcpy(x0, loop.state.x, sizeof x0);
    lqg_lqr_control(&loop.steady.lqr, x0, u);
    for (unsigned i = 0; i < 2; i++) /* y = C x0 + D u */
        y[i] = x0[2 * i] + loop.online.D[i] * u[0];
    loop_control(&loop, u);
    loop_update(&loop, y);
    for (unsigned i = 0; i < 4; i++)
        TEST_ASSERT_DOUBLE_WITHIN(2 * EPSILON, (double)x0[i], (double)loop.state.x[i]);
}

/* The state, each array in an allocation of its own, so that AddressSanitizer sees a step beyond; the guards
 * see it elsewhere. */
enum { GUARD = 4 };
static lqg_real *guarded(unsigned length)
{
    lqg_real *memory = (lqg_real *)malloc((length + GUARD) * sizeof *memory);
    for (unsigned i = 0; i < length + GUARD; i++)
        memory[i] = 12345;
    return memory;
}

static void check_and_free(lqg_real *memory, unsigned length)
{
    for (unsigned i = length; i < length + GUARD; i++)
        TEST_ASSERT_TRUE(memory[i] == 12345);
    free(memory);
}

static void stay_inside(const model_t *model)
{
    static loop_t loop;
    const unsigned nx = model->nx, nu = model->nu, ny = model->ny;
    const unsigned plain_work = LQG_KALMAN_PLAIN_WORK(nx, ny), ud_work = LQG_KALMAN_UD_WORK(nx, ny, nx);
    const unsigned steady_work = LQG_KALMAN_STEADY_WORK(nx, ny);
    lqg_real *x = guarded(nx), *P = guarded(LQG_KALMAN_PLAIN_P(nx));
    lqg_real *U = guarded(LQG_KALMAN_UD_U(nx)), *d = guarded(nx);
    lqg_real *u_applied = guarded(nu), *innovation = guarded(ny), *u = guarded(nu), *y = guarded(ny);
    lqg_real *work[FILTERS] = {guarded(steady_work), guarded(plain_work), guarded(ud_work)};

    make_loop(&loop, model, STEADY, LQG_FILTER_FORM);
    for (unsigned i = 0; i < ny; i++)
        y[i] = 1;
    lqg_kalman_steady_init(&loop.steady.kalman, x, u_applied, innovation);
    lqg_lqg_steady_step(&loop.steady, x, u_applied, innovation, y, u, work[STEADY]);
    lqg_kalman_plain_init(&loop.plain.kalman, x, P, u_applied, innovation);
    lqg_lqg_plain_step(&loop.plain, x, P, u_applied, innovation, y, u, work[PLAIN]);
    lqg_kalman_ud_init(&loop.ud.kalman, x, U, d, u_applied, innovation);
    lqg_lqg_ud_step(&loop.ud, x, U, d, u_applied, innovation, y, u, work[UD]);

    check_and_free(x, nx);
    check_and_free(P, LQG_KALMAN_PLAIN_P(nx));
    check_and_free(U, LQG_KALMAN_UD_U(nx));
    check_and_free(d, nx);
    check_and_free(u_applied, nu);
    check_and_free(innovation, ny);
    check_and_free(u, nu);
    check_and_free(y, ny);
    check_and_free(work[STEADY], steady_work);
    check_and_free(work[PLAIN], plain_work);
    check_and_free(work[UD], ud_work);
}

static void test_nothing_is_written_beyond_the_sizes_of_the_macros(void)
{
    for (unsigned m = 0; m < sizeof models / sizeof *models; m++)
        stay_inside(models[m]);
    stay_inside(&random_walk);
}

static void test_optional_state_may_be_left_out(void)
{
    static loop_t with, without;
    const lqg_real y[1] = {1};
    lqg_real u[1], u_without[1];
    make_loop(&with, &double_integrator, UD, LQG_FILTER_FORM);
    make_loop(&without, &double_integrator, UD, LQG_FILTER_FORM);
    state_t *s = &without.state;
    loop_step(&with, y, u);
    lqg_lqg_ud_step(&without.ud, s->x, s->U, s->d, NULL, NULL, y, u_without, s->work);
    TEST_ASSERT_TRUE(u[0] == u_without[0]);
    TEST_ASSERT_TRUE(memcmp(with.state.x, s->x, sizeof s->x) == 0);
}

static void test_a_copied_state_goes_on_like_the_first(void)
{
    static loop_t first, second;
    const lqg_real y[2] = {1, -1};
    lqg_real u[1], u_copy[1];
    for (unsigned filter = 0; filter < FILTERS; filter++) {
        make_loop(&first, &cross_noise, filter, LQG_FILTER_FORM);
        make_loop(&second, &cross_noise, filter, LQG_FILTER_FORM);
        for (unsigned sample = 0; sample < 10; sample++)
            loop_step(&first, y, u);
        second.state = first.state;
        TEST_ASSERT_EQUAL_UINT(loop_step(&first, y, u), loop_step(&second, y, u_copy));
        TEST_ASSERT_TRUE(u[0] == u_copy[0] && same_state(&first.state, &second.state));
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_step_is_its_three_calls_in_the_order_of_the_form);
    RUN_TEST(test_the_forms_differ_in_the_estimate_that_u_is_made_of);
    RUN_TEST(test_predictor_form_takes_its_own_u_out_of_y);
    RUN_TEST(test_nothing_is_written_beyond_the_sizes_of_the_macros);
    RUN_TEST(test_optional_state_may_be_left_out);
    RUN_TEST(test_a_copied_state_goes_on_like_the_first);
    return UNITY_END();
}
