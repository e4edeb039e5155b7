/* SPDX-License-Identifier: MIT */
/* lqg/functions.h where arguments or results are special. How large the errors are: functions/. */
#include "lqg/functions.h"

#include <math.h>

#include "unity.h"

void setUp(void) {}
void tearDown(void) {}

static void assert_bits(float expected, float found)
{
    TEST_ASSERT_EQUAL_HEX32(lqg_bitsf(expected), lqg_bitsf(found));
}

static void assert_nan(float found)
{
    TEST_ASSERT_EQUAL_HEX32(0x7fc00000u, lqg_bitsf(found));
}

/* Within a unit in the last place of results below 4. */
static void assert_near(float expected, float found)
{
    TEST_ASSERT_FLOAT_WITHIN(2.4e-7f, expected, found);
    TEST_ASSERT_EQUAL_HEX32(lqg_bitsf(expected) >> 31, lqg_bitsf(found) >> 31);
}

static void test_nan_gives_the_one_nan(void)
{
    static float (*const functions[])(float) = {lqg_sinf,  lqg_cosf, lqg_tanf, lqg_asinf, lqg_acosf, lqg_atanf,
                                                lqg_sqrtf, lqg_expf, lqg_logf, lqg_tanhf, lqg_wrapf};
    static const uint32_t nans[] = {0x7fc00000u, 0xffc00000u, 0x7f800001u, 0xff800001u, 0xffffffffu};

    for (unsigned n = 0; n < sizeof nans / sizeof *nans; n++) {
        const float nan = lqg_of_bitsf(nans[n]);
        float sine, cosine;
        for (unsigned f = 0; f < sizeof functions / sizeof *functions; f++)
            assert_nan(functions[f](nan));
        lqg_sin_cosf(nan, &sine, &cosine);
        assert_nan(sine);
        assert_nan(cosine);
        assert_nan(lqg_atan2f(nan, 1));
        assert_nan(lqg_atan2f(1, nan));
    }
}

static void test_zeros_keep_their_sign(void)
{
    static float (*const functions[])(float) = {lqg_sinf,  lqg_tanf,  lqg_asinf, lqg_atanf,
                                                lqg_sqrtf, lqg_tanhf, lqg_wrapf};

    for (unsigned f = 0; f < sizeof functions / sizeof *functions; f++) {
        assert_bits(0.0f, functions[f](0.0f));
        assert_bits(-0.0f, functions[f](-0.0f));
    }
}

static void test_beyond_the_range_is_nan(void)
{
    const float outside[] = {8192.001f, -8192.001f, 1e30f, INFINITY, -INFINITY};

    for (unsigned i = 0; i < sizeof outside / sizeof *outside; i++) {
        float sine, cosine;
        assert_nan(lqg_sinf(outside[i]));
        assert_nan(lqg_cosf(outside[i]));
        assert_nan(lqg_tanf(outside[i]));
        assert_nan(lqg_wrapf(outside[i]));
        assert_nan(lqg_asinf(outside[i]));
        assert_nan(lqg_acosf(outside[i]));
        lqg_sin_cosf(outside[i], &sine, &cosine);
        assert_nan(sine);
        assert_nan(cosine);
    }
    assert_nan(lqg_asinf(1.0000001f));
    assert_nan(lqg_acosf(-1.0000001f));
    assert_nan(lqg_sqrtf(-1e-45f));
    assert_nan(lqg_sqrtf(-INFINITY));
    assert_nan(lqg_logf(-1e-45f));
    assert_nan(lqg_logf(-INFINITY));
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, -0.956173153f, lqg_sinf(LQG_ANGLE_MAXF));
}

static void test_infinities_are_those_of_annex_f(void)
{
    assert_bits(1.57079637f, lqg_atanf(INFINITY));
    assert_bits(-1.57079637f, lqg_atanf(-INFINITY));
    assert_bits(INFINITY, lqg_sqrtf(INFINITY));
    assert_bits(INFINITY, lqg_expf(INFINITY));
    assert_bits(0.0f, lqg_expf(-INFINITY));
    assert_bits(INFINITY, lqg_logf(INFINITY));
    assert_bits(-INFINITY, lqg_logf(0.0f));
    assert_bits(-INFINITY, lqg_logf(-0.0f));
    assert_bits(1.0f, lqg_tanhf(INFINITY));
    assert_bits(-1.0f, lqg_tanhf(-INFINITY));
}

static void test_exact_results_are_exact(void)
{
    assert_bits(1.0f, lqg_cosf(0.0f));
    assert_bits(1.0f, lqg_expf(-0.0f));
    assert_bits(0.0f, lqg_logf(1.0f));
    assert_bits(0.0f, lqg_acosf(1.0f));
    assert_bits(3.14159274f, lqg_acosf(-1.0f));
    assert_bits(1.57079637f, lqg_asinf(1.0f));
    assert_bits(1e-45f, lqg_sinf(1e-45f));
    assert_bits(-1e-45f, lqg_tanhf(-1e-45f));
    for (uint32_t i = 0; i < 4096; i++)
        assert_bits((float)i, lqg_sqrtf((float)(i * i)));
}

static void test_exp_overflows_and_underflows_where_floats_end(void)
{
    TEST_ASSERT_TRUE(lqg_expf(88.7228317f) < INFINITY);
    assert_bits(INFINITY, lqg_expf(88.7228394f));
    assert_bits(INFINITY, lqg_expf(88.8f));
    assert_bits(INFINITY, lqg_expf(88.9f));
    assert_bits(1e-45f, lqg_expf(-103.9f));
    assert_bits(0.0f, lqg_expf(-103.98f));
    assert_bits(0.0f, lqg_expf(-104.1f));
}

/* The angle in eighths of a turn, and y and x, of which 2 is an infinity. */
static void test_atan2_knows_each_quadrant_zero_and_infinity(void)
{
    static const struct {
        float y, x;
        int eighths;
    } rows[] = {{1, 1, 1},       {1, 0.0f, 2}, {1, -0.0f, 2}, {1, -1, 3},   {0.0f, -1, 4}, {0.0f, -0.0f, 4},
                {0.0f, 0.0f, 0}, {0.0f, 1, 0}, {2, 1, 2},     {2, 2, 1},    {2, -2, 3},    {1, 2, 0},
                {1, -2, 4},      {0.0f, 2, 0}, {2, 0.0f, 2},  {0.0f, -2, 4}};
    static const float angles[] = {0.0f, 0.785398185f, 1.57079637f, 2.35619450f, 3.14159274f};

    for (unsigned i = 0; i < sizeof rows / sizeof *rows; i++) {
        const float y = rows[i].y == 2 ? INFINITY : rows[i].y;
        const float x = rows[i].x == 2 ? INFINITY : rows[i].x == -2 ? -INFINITY : rows[i].x;
        assert_near(angles[rows[i].eighths], lqg_atan2f(y, x));
        assert_near(-angles[rows[i].eighths], lqg_atan2f(-y, x));
    }
}

static void test_tanh_rises_to_one_and_stays(void)
{
    float before = 0;

    for (unsigned i = 0; i < 4000; i++) {
        const float here = lqg_tanhf((float)i / 256);
        TEST_ASSERT_TRUE(here >= before);
        TEST_ASSERT_TRUE(here <= 1.0f);
        before = here;
    }
    assert_bits(1.0f, before);
}

static void test_wrap_stays_within_half_a_turn_and_keeps_what_is_there(void)
{
    float x = -8192.0f;

    assert_bits(3.1415925f, lqg_wrapf(3.1415925f));
    assert_bits(-3.1415925f, lqg_wrapf(-3.1415925f));
    assert_bits(-3.1415925f, lqg_wrapf(3.14159274f));
    assert_bits(3.1415925f, lqg_wrapf(-3.14159274f));
    while (x <= 8192.0f) {
        const float wrapped = lqg_wrapf(x);
        TEST_ASSERT_TRUE(-3.1415926 < (double)wrapped && (double)wrapped < 3.1415926);
        TEST_ASSERT_FLOAT_WITHIN(1e-6f, lqg_sinf(x), lqg_sinf(wrapped));
        x += 1.234567f;
    }
}

/* Next to odd multiples of π/4, where the nearest multiple of π/2 is found only nearly. test/proof rests on it. */
static void test_reduced_angles_are_hardly_beyond_an_eighth_of_a_turn(void)
{
    for (uint32_t n = 1; n < 5200; n += 7) {
        const uint32_t middle = lqg_bitsf(((float)n + 0.5f) * 1.57079637f);
        for (uint32_t bits = middle - 3; bits <= middle + 3; bits++) {
            uint32_t quarters;
            float rest;
            const float r = lqg_reducef(lqg_of_bitsf(bits), &rest, &quarters);
            TEST_ASSERT_TRUE(-0.7862f <= r && r <= 0.7862f);
            TEST_ASSERT_TRUE(-1e-7f <= rest && rest <= 1e-7f);
        }
    }
}

#if LQG_HAS_DOUBLE
static void assert_bits_of_double(double expected, double found)
{
    TEST_ASSERT_EQUAL_HEX32(lqg_bits(expected) >> 32, lqg_bits(found) >> 32);
    TEST_ASSERT_EQUAL_HEX32(lqg_bits(expected) & 0xffffffffu, lqg_bits(found) & 0xffffffffu);
}

static void test_double_is_special_where_float_is(void)
{
    const double nan = lqg_of_bits(LQG_NAN);
    static double (*const functions[])(double) = {lqg_sin,  lqg_cos, lqg_tan, lqg_asin, lqg_acos, lqg_atan,
                                                  lqg_sqrt, lqg_exp, lqg_log, lqg_tanh, lqg_wrap};

    for (unsigned f = 0; f < sizeof functions / sizeof *functions; f++)
        assert_bits_of_double(nan, functions[f](lqg_of_bits(0xfff0000000000001u)));
    assert_bits_of_double(nan, lqg_sin(1048576.0000001));
    assert_bits_of_double(nan, lqg_acos(1.0000000000000002));
    assert_bits_of_double(nan, lqg_log(-1));
    assert_bits_of_double(nan, lqg_sqrt(-5e-324));
    assert_bits_of_double(-(double)INFINITY, lqg_log(0));
    assert_bits_of_double((double)INFINITY, lqg_exp(709.782712893385));
    assert_bits_of_double(5e-324, lqg_exp(-745.13));
    assert_bits_of_double(0, lqg_exp(-745.14));
    assert_bits_of_double(1, lqg_tanh(22.5));
    assert_bits_of_double(-3.1415926535897931, lqg_atan2(-0.0, -0.0));
    assert_bits_of_double(-0.0, lqg_atan2(-0.0, 0.0));
    assert_bits_of_double(2.3561944901923448, lqg_atan2((double)INFINITY, -(double)INFINITY));
    assert_bits_of_double(3.1415926535897931, lqg_wrap(3.1415926535897931));
    assert_bits_of_double(-3.1415926535897931, lqg_wrap(3.1415926535897936));
    assert_bits_of_double(-0.0, lqg_tanh(-0.0));
    assert_bits_of_double(94906265.624251559, lqg_sqrt(9007199254740994.0));
}
#endif

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_nan_gives_the_one_nan);
    RUN_TEST(test_zeros_keep_their_sign);
    RUN_TEST(test_beyond_the_range_is_nan);
    RUN_TEST(test_infinities_are_those_of_annex_f);
    RUN_TEST(test_exact_results_are_exact);
    RUN_TEST(test_exp_overflows_and_underflows_where_floats_end);
    RUN_TEST(test_atan2_knows_each_quadrant_zero_and_infinity);
    RUN_TEST(test_tanh_rises_to_one_and_stays);
    RUN_TEST(test_wrap_stays_within_half_a_turn_and_keeps_what_is_there);
    RUN_TEST(test_reduced_angles_are_hardly_beyond_an_eighth_of_a_turn);
#if LQG_HAS_DOUBLE
    RUN_TEST(test_double_is_special_where_float_is);
#endif
    return UNITY_END();
}
