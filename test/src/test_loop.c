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

static lqg_status_t three_calls(loop_t *loop, lqg_form_t form, const lqg_real y[], lqg_real u[])
{
    lqg_status_t status = LQG_OK;
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
        const lqg_status_t status = loop_step(&stepped, y, u);
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

static const lqg_gate_t gate = {1000, NULL, (const lqg_real[]){2, 2}, (const lqg_real[]){0.5f, 0.5f}};
static const lqg_real S[MAX_NY] = {1, 1};

/* All loops with all that a state can have. */
static void make_descriptions(loop_t *loop, const model_t *model)
{
    make_loop(loop, model, STEADY, LQG_FILTER_FORM);
    loop->steady.kalman.gate = loop->plain.kalman.gate = loop->ud.kalman.gate = &gate;
    loop->steady.kalman.S = S;
}

static void stay_inside_arrays(const model_t *model)
{
    static loop_t loop;
    const unsigned nx = model->nx, nu = model->nu, ny = model->ny;
    const unsigned plain_work = LQG_KALMAN_PLAIN_WORK(nx, ny), ud_work = LQG_KALMAN_UD_WORK(nx, ny, nx);
    const unsigned steady_work = LQG_KALMAN_STEADY_WORK(nx, ny);
    lqg_real *x = guarded(nx), *P = guarded(LQG_TRIANGLE(nx));
    lqg_real *U = guarded(LQG_STRICT_TRIANGLE(nx)), *d = guarded(nx), *widening = guarded(ny);
    lqg_real *u_applied = guarded(nu), *innovation = guarded(ny), *u = guarded(nu), *y = guarded(ny);
    lqg_real *work[FILTERS] = {guarded(steady_work), guarded(plain_work), guarded(ud_work)};
    lqg_loop_steady_state_t steady = {{x, u_applied, innovation, {widening, NULL}, work[STEADY]}, u};
    lqg_loop_plain_state_t plain = {{x, P, u_applied, innovation, {widening, NULL}, work[PLAIN]}, u};
    lqg_loop_ud_state_t ud = {{x, U, d, u_applied, innovation, {widening, NULL}, work[UD]}, u};

    make_descriptions(&loop, model);
    for (unsigned i = 0; i < ny; i++)
        y[i] = 1;
    lqg_loop_steady_init(&loop.steady, &steady);
    lqg_loop_steady_step(&loop.steady, &steady, y);
    lqg_loop_plain_init(&loop.plain, &plain);
    lqg_loop_plain_step(&loop.plain, &plain, y);
    lqg_loop_ud_init(&loop.ud, &ud);
    lqg_loop_ud_step(&loop.ud, &ud, y);

    check_and_free(x, nx);
    check_and_free(P, LQG_TRIANGLE(nx));
    check_and_free(U, LQG_STRICT_TRIANGLE(nx));
    check_and_free(d, nx);
    check_and_free(widening, ny);
    check_and_free(u_applied, nu);
    check_and_free(innovation, ny);
    check_and_free(u, nu);
    check_and_free(y, ny);
    check_and_free(work[STEADY], steady_work);
    check_and_free(work[PLAIN], plain_work);
    check_and_free(work[UD], ud_work);
}

/* In the memory of the macros the arrays neither overlap nor leave it: loops with it have the bits of loops with arrays
 * of their own. */
static void stay_inside_memory(const model_t *model)
{
    static loop_t loop;
    static state_t apart;
    const unsigned nx = model->nx, nu = model->nu, ny = model->ny;
    const unsigned steady_length = LQG_LOOP_STEADY_MEMORY(nx, nu, ny), plain_length = LQG_LOOP_PLAIN_MEMORY(nx, nu, ny);
    const unsigned ud_length = LQG_LOOP_UD_MEMORY(nx, nu, ny, nx);
    lqg_real *steady_memory = guarded(steady_length), *plain_memory = guarded(plain_length);
    lqg_real *ud_memory = guarded(ud_length), u[MAX_NU] = {0};
    lqg_loop_steady_state_t steady = LQG_LOOP_STEADY_STATE_IN(steady_memory, nx, nu, ny);
    lqg_loop_plain_state_t plain = LQG_LOOP_PLAIN_STATE_IN(plain_memory, nx, nu, ny);
    lqg_loop_ud_state_t ud = LQG_LOOP_UD_STATE_IN(ud_memory, nx, nu, ny, nx);
    lqg_loop_ud_state_t other = {ud_state(&apart), u};

    make_descriptions(&loop, model);
    lqg_loop_steady_init(&loop.steady, &steady);
    lqg_loop_plain_init(&loop.plain, &plain);
    lqg_loop_ud_init(&loop.ud, &ud);
    lqg_loop_ud_init(&loop.ud, &other);
    for (unsigned sample = 0; sample < 5; sample++) {
        const lqg_real y[MAX_NY] = {(lqg_real)sample, -1};
        lqg_loop_steady_step(&loop.steady, &steady, y);
        lqg_loop_plain_step(&loop.plain, &plain, y);
        lqg_loop_ud_step(&loop.ud, &ud, y);
        lqg_loop_ud_step(&loop.ud, &other, y);
        TEST_ASSERT_TRUE(memcmp(apart.x, ud.kalman.x, nx * sizeof *apart.x) == 0);
        TEST_ASSERT_TRUE(memcmp(apart.U, ud.kalman.U, LQG_STRICT_TRIANGLE(nx) * sizeof *apart.U) == 0);
        TEST_ASSERT_TRUE(memcmp(apart.d, ud.kalman.d, nx * sizeof *apart.d) == 0);
        TEST_ASSERT_TRUE(memcmp(apart.widening, ud.kalman.gate.widening, ny * sizeof *apart.widening) == 0);
        TEST_ASSERT_TRUE(memcmp(apart.innovation, ud.kalman.innovation, ny * sizeof *apart.innovation) == 0);
        TEST_ASSERT_TRUE(memcmp(apart.u_applied, ud.kalman.u_applied, nu * sizeof *u) == 0);
        TEST_ASSERT_TRUE(memcmp(u, ud.u, nu * sizeof *u) == 0);
        for (unsigned i = 0; i < nx; i++) /* the same filter, with other roundings */
            TEST_ASSERT_DOUBLE_WITHIN(1000 * EPSILON, (double)apart.x[i], (double)plain.kalman.x[i]);
    }
    check_and_free(steady_memory, steady_length);
    check_and_free(plain_memory, plain_length);
    check_and_free(ud_memory, ud_length);
}

static void stay_inside(const model_t *model)
{
    stay_inside_arrays(model);
    stay_inside_memory(model);
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
    lqg_loop_ud_state_t bare = {{s->x, s->U, s->d, NULL, NULL, {NULL, NULL}, s->work}, u_without};
    lqg_loop_ud_step(&without.ud, &bare, y);
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

/* What stands in memory before is no input: actuators get 0 until the first sample. */
static void test_init_clears_the_input(void)
{
    static loop_t loop;
    lqg_real u[3][1] = {{5}, {5}, {5}};
    state_t *s = &loop.state;
    make_loop(&loop, &double_integrator, STEADY, LQG_FILTER_FORM);
    lqg_loop_steady_state_t steady = {{s->x, NULL, NULL, {NULL, NULL}, s->work}, u[0]};
    lqg_loop_plain_state_t plain = {{s->x, s->P, NULL, NULL, {NULL, NULL}, s->work}, u[1]};
    lqg_loop_ud_state_t ud = {{s->x, s->U, s->d, NULL, NULL, {NULL, NULL}, s->work}, u[2]};
    lqg_loop_steady_init(&loop.steady, &steady);
    make_loop(&loop, &double_integrator, PLAIN, LQG_FILTER_FORM);
    lqg_loop_plain_init(&loop.plain, &plain);
    make_loop(&loop, &double_integrator, UD, LQG_FILTER_FORM);
    lqg_loop_ud_init(&loop.ud, &ud);
    for (unsigned filter = 0; filter < FILTERS; filter++)
        TEST_ASSERT_TRUE(u[filter][0] == 0);
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
    RUN_TEST(test_init_clears_the_input);
    return UNITY_END();
}
