/* SPDX-License-Identifier: MIT */
/* What a step took, from two readings of the target's counter to the numbers of the host's table. */
#include "ticks.h"
#include "timing.h"
#include "unity.h"

/* A frame of 200 ticks, and a thousand instructions in 30: a fast PC whose counter has nanoseconds. */
enum { FRAME = 200, OF_THOUSAND = 30 };

static const uint32_t bits_24 = 0xFFFFFF, bits_32 = 0xFFFFFFFF;

/* ---- ticks ---------------------------------------------------------------------------------------------- */

static void test_frame_is_left_out_of_a_step(void)
{
    TEST_ASSERT_EQUAL_UINT32(40, pil_ticks(1000, 1240, bits_32, FRAME));
    TEST_ASSERT_EQUAL_UINT32(40, pil_ticks(1000, 1240, bits_24, FRAME));
    TEST_ASSERT_EQUAL_UINT32(240, pil_ticks(1000, 1240, bits_32, 0));
}

static void test_step_that_takes_less_than_the_frame_counts_0(void)
{
    const uint32_t masks[] = {0xFF, 0xFFFF, bits_24, bits_32};

    for (unsigned i = 0; i < sizeof masks / sizeof masks[0]; i++)
        for (uint32_t ticks = 0; ticks <= FRAME; ticks++)
            TEST_ASSERT_EQUAL_UINT32(0, pil_ticks(7, (7 + ticks) & masks[i], masks[i], FRAME));
}

/* From every place of the last turn, so that most steps begin before the counter wraps and end behind. */
static void test_counter_may_wrap_in_a_step(void)
{
    const uint32_t masks[] = {0xFF, 0xFFFF, bits_24, bits_32};

    for (unsigned i = 0; i < sizeof masks / sizeof masks[0]; i++)
        for (uint32_t left = 0; left < 0xFF; left++)
            for (uint32_t ticks = 0; ticks <= 0xFF; ticks += 5) {
                const uint32_t before = masks[i] - left, after = (before + ticks) & masks[i];

                TEST_ASSERT_EQUAL_UINT32(ticks > 12 ? ticks - 12 : 0, pil_ticks(before, after, masks[i], 12));
            }
}

/* What a counter has above its mask counts for nothing: one that runs downwards in 24 bits of a wider word may have
 * ones there. */
static void test_bits_above_the_mask_are_not_read(void)
{
    TEST_ASSERT_EQUAL_UINT32(40, pil_ticks(0xAB000010, 0x12000048, bits_24, 16));
}

static void test_longest_step_of_a_counter_is_its_mask(void)
{
    TEST_ASSERT_EQUAL_UINT32(bits_24, pil_ticks(1, 0, bits_24, 0));
    TEST_ASSERT_EQUAL_UINT32(bits_32, pil_ticks(1, 0, bits_32, 0));
}

/* ---- the host's numbers --------------------------------------------------------------------------------- */

static timing_t timing;

void setUp(void);
void tearDown(void);

void setUp(void)
{
    timing = (timing_t){.count = 0};
}

void tearDown(void)
{
    timing_end(&timing);
}

/* Starts with a target of this counter, and adds a sample of these ticks. */
static void take(uint32_t ticks_of_thousand, uint32_t frequency, int emulated, uint32_t ticks)
{
    const pil_hello_t hello = {.ticks_of_thousand = ticks_of_thousand, .frequency = frequency};
    const answer_t answer = {.ticks = {ticks, 0, ticks}, .round_trip = 0.5e-3};

    TEST_ASSERT_EQUAL_INT(0, timing_start(&timing, 1, &hello, emulated));
    timing_add(&timing, 0, &answer);
}

static void expect(const char *unit, double number)
{
    TEST_ASSERT_EQUAL_STRING(unit, timing.unit);
    TEST_ASSERT_EQUAL_DOUBLE(number, timing.rows[TIMING_UPDATE][0]);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, timing.rows[TIMING_CONTROL][0]);
    TEST_ASSERT_EQUAL_DOUBLE(number, timing.rows[TIMING_PREDICT][0]);
    TEST_ASSERT_EQUAL_DOUBLE(2 * number, timing.rows[TIMING_ALL][0]);
}

/* It was 143 165 571 867 instructions: 2³² − 140 ticks of 0.03 an instruction. */
static void test_step_below_the_frame_is_no_instruction(void)
{
    take(OF_THOUSAND, 0, 1, pil_ticks(1000, 1060, bits_32, FRAME));
    expect("instructions", 0.0);
}

static void test_instructions_of_an_emulated_counter_are_whole(void)
{
    take(6400, 0, 1, 1025); /* 6.4 ticks each, and one more for where the readings fell */
    expect("instructions", 160.0);
}

/* 2³² − 1 ticks of 0.001 an instruction do not fit an integer of 32 bits. */
static void test_instructions_may_be_more_than_32_bits_hold(void)
{
    take(1, 0, 1, bits_32);
    expect("instructions", 4294967295e3);
}

static void test_ticks_of_a_board_are_cycles(void)
{
    take(1003, 84000000, 0, 700);
    expect("cycles", 700.0);
}

/* A thousand instructions that take no tick: their number is unknown, so what is known is shown. */
static void test_counter_that_is_too_coarse_shows_its_ticks(void)
{
    take(0, 0, 1, 3);
    expect("ticks", 3.0);
}

static void test_coarse_counter_of_a_board_counts_cycles(void)
{
    take(0, 84000000, 0, 3);
    expect("cycles", 3.0);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_frame_is_left_out_of_a_step);
    RUN_TEST(test_step_that_takes_less_than_the_frame_counts_0);
    RUN_TEST(test_counter_may_wrap_in_a_step);
    RUN_TEST(test_bits_above_the_mask_are_not_read);
    RUN_TEST(test_longest_step_of_a_counter_is_its_mask);
    RUN_TEST(test_step_below_the_frame_is_no_instruction);
    RUN_TEST(test_instructions_of_an_emulated_counter_are_whole);
    RUN_TEST(test_instructions_may_be_more_than_32_bits_hold);
    RUN_TEST(test_ticks_of_a_board_are_cycles);
    RUN_TEST(test_counter_that_is_too_coarse_shows_its_ticks);
    RUN_TEST(test_coarse_counter_of_a_board_counts_cycles);
    return UNITY_END();
}
