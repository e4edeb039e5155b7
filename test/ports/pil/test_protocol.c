/* SPDX-License-Identifier: MIT */
/* The protocol between host and target: what is sent is found again, whatever else is on the line. */
#include <math.h>
#include <string.h>

#include "protocol.h"
#include "unity.h"

static pil_decoder_t decoder;
static pil_frame_t found;
static unsigned found_count;

void setUp(void);
void tearDown(void);

void setUp(void)
{
    decoder = (pil_decoder_t){.count = 0};
    found_count = 0;
}

void tearDown(void) {}

/* A frame with a sync byte in all places where one can be. */
static const pil_frame_t sample = {
    .type = PIL_SAMPLE, .length = 8, .sequence = 0xA5A5, .payload = {0xA5, 1, 2, 0xA5, 0xA5, 5, 6, 0xA5}};

static void hear(const uint8_t *bytes, unsigned count)
{
    for (unsigned i = 0; i < count; i++) {
        pil_take(&decoder, bytes[i]);
        while (pil_next(&decoder, &found))
            found_count++;
    }
}

static void hear_frame(const pil_frame_t *frame)
{
    uint8_t bytes[PIL_FRAME_MAX];

    hear(bytes, pil_encode(frame, bytes));
}

static void expect_frame(const pil_frame_t *frame)
{
    TEST_ASSERT_EQUAL_UINT8(frame->type, found.type);
    TEST_ASSERT_EQUAL_UINT16(frame->sequence, found.sequence);
    TEST_ASSERT_EQUAL_UINT8(frame->length, found.length);
    if (frame->length > 0)
        TEST_ASSERT_EQUAL_UINT8_ARRAY(frame->payload, found.payload, frame->length);
}

/* The check value of CRC-16/CCITT-FALSE in every catalogue. */
static void test_crc_has_the_check_value(void)
{
    TEST_ASSERT_EQUAL_HEX16(0x29B1, pil_crc(PIL_CRC_START, (const uint8_t *)"123456789", 9));
}

static void test_crc_may_be_made_in_parts(void)
{
    const uint16_t first = pil_crc(PIL_CRC_START, (const uint8_t *)"1234", 4);

    TEST_ASSERT_EQUAL_HEX16(0x29B1, pil_crc(first, (const uint8_t *)"56789", 5));
}

static void test_frame_has_the_documented_bytes(void)
{
    const pil_frame_t frame = {.type = PIL_START, .length = 2, .sequence = 0x1234, .payload = {0xAB, 0xCD}};
    const uint8_t expected[] = {0xA5, 2, 2, 0x34, 0x12, 0xAB, 0xCD};
    uint8_t bytes[PIL_FRAME_MAX];

    TEST_ASSERT_EQUAL_UINT(sizeof expected + 2, pil_encode(&frame, bytes));
    TEST_ASSERT_EQUAL_UINT8_ARRAY(expected, bytes, sizeof expected);
    TEST_ASSERT_EQUAL_HEX16(pil_crc(PIL_CRC_START, bytes + 1, 6), bytes[7] | bytes[8] << 8);
}

static void test_frames_of_every_length_come_back(void)
{
    pil_frame_t frame = {.type = PIL_COST};

    for (unsigned length = 0; length <= PIL_PAYLOAD_MAX; length++) {
        frame.length = (uint8_t)length;
        frame.sequence = (uint16_t)(517 * length);
        for (unsigned i = 0; i < length; i++)
            frame.payload[i] = (uint8_t)(37 * i + length);
        hear_frame(&frame);
        TEST_ASSERT_EQUAL_UINT(length + 1, found_count);
        expect_frame(&frame);
    }
    TEST_ASSERT_EQUAL_UINT(0, decoder.skipped);
    TEST_ASSERT_EQUAL_UINT(0, decoder.damaged);
}

static void test_floats_keep_every_bit_when_they_are_not_finite(void)
{
    const uint32_t bits[] = {0x7FC12345, 0xFFA00001, 0x7F800000, 0x80000000, 0x00000001, 0x3F800001};
    enum { COUNT = sizeof bits / sizeof bits[0] };
    float values[COUNT], back[COUNT];
    uint8_t payload[4 * COUNT];

    memcpy(values, bits, sizeof bits);
    TEST_ASSERT_EQUAL_PTR(payload + sizeof payload, pil_put_floats(payload, values, COUNT));
    TEST_ASSERT_EQUAL_HEX8(0x45, payload[0]);
    pil_get_floats(payload, back, COUNT);
    TEST_ASSERT_EQUAL_HEX32_ARRAY(bits, (const uint32_t *)(const void *)back, COUNT);
}

static void test_hello_comes_back(void)
{
    const pil_hello_t hello = {.version = 1,
                               .nx = 4,
                               .nu = 1,
                               .ny = 2,
                               .sample_time = 0.004f,
                               .digest = {1, 2, 0xFF},
                               .ticks_of_thousand = 0x89ABCDEF,
                               .frequency = 16000000,
                               .name = "balancing_robot"};
    uint8_t payload[PIL_HELLO_SIZE];
    pil_hello_t back;

    pil_put_hello(payload, &hello);
    pil_get_hello(payload, &back);
    TEST_ASSERT_EQUAL_UINT8(hello.nx, back.nx);
    TEST_ASSERT_EQUAL_UINT8(hello.ny, back.ny);
    TEST_ASSERT_EQUAL_HEX32(hello.ticks_of_thousand, back.ticks_of_thousand);
    TEST_ASSERT_EQUAL_UINT32(hello.frequency, back.frequency);
    TEST_ASSERT_EQUAL_UINT8_ARRAY(hello.digest, back.digest, PIL_DIGEST_SIZE);
    TEST_ASSERT_EQUAL_STRING(hello.name, back.name);
    TEST_ASSERT_TRUE(hello.sample_time >= back.sample_time && hello.sample_time <= back.sample_time);
}

static void test_garbage_before_a_frame_is_skipped(void)
{
    const uint8_t garbage[] = {0, 1, 0xFF, 0x7E, 0x0D, 0x0A};

    hear(garbage, sizeof garbage);
    hear_frame(&sample);
    TEST_ASSERT_EQUAL_UINT(1, found_count);
    expect_frame(&sample);
    TEST_ASSERT_EQUAL_UINT(sizeof garbage, decoder.skipped);
}

/* The beginning of a long frame that never goes on swallows the frames behind it, until it is seen to be none. */
static void test_frames_inside_of_what_looked_like_one_are_found(void)
{
    const uint8_t beginning[] = {0xA5, PIL_SAMPLE, 60, 0, 0};
    unsigned sent = 0;

    hear(beginning, sizeof beginning);
    for (; sent < 5; sent++)
        hear_frame(&sample);
    TEST_ASSERT_EQUAL_UINT(sent, found_count);
    TEST_ASSERT_EQUAL_UINT(1, decoder.damaged);
    expect_frame(&sample);
}

/* CRC-16 finds any burst of up to 16 bits, so certainly any single one. */
static void test_every_single_wrong_bit_is_found_and_the_next_frame_is_read(void)
{
    uint8_t good[PIL_FRAME_MAX], bytes[PIL_FRAME_MAX];
    const unsigned count = pil_encode(&sample, good);
    const pil_frame_t next = {.type = PIL_HELLO, .length = PIL_PAYLOAD_MAX, .sequence = 7};

    for (unsigned bit = 0; bit < 8 * count; bit++) {
        setUp();
        memcpy(bytes, good, count);
        bytes[bit / 8] = (uint8_t)(bytes[bit / 8] ^ 1u << bit % 8);
        hear(bytes, count);
        TEST_ASSERT_EQUAL_UINT(0, found_count);
        hear_frame(&next);
        TEST_ASSERT_EQUAL_UINT(1, found_count);
        expect_frame(&next);
    }
}

static void test_every_lost_byte_is_found_and_the_next_frame_is_read(void)
{
    uint8_t bytes[PIL_FRAME_MAX];
    const unsigned count = pil_encode(&sample, bytes);
    const pil_frame_t next = {.type = PIL_HELLO, .length = PIL_PAYLOAD_MAX, .sequence = 7};

    for (unsigned lost = 0; lost < count; lost++) {
        setUp();
        hear(bytes, lost);
        hear(bytes + lost + 1, count - lost - 1);
        TEST_ASSERT_EQUAL_UINT(0, found_count);
        hear_frame(&next);
        TEST_ASSERT_EQUAL_UINT(1, found_count);
        expect_frame(&next);
    }
}

static void test_length_beyond_the_largest_is_no_frame(void)
{
    const uint8_t too_long[] = {0xA5, PIL_SAMPLE, PIL_PAYLOAD_MAX + 1, 0, 0};

    hear(too_long, sizeof too_long);
    TEST_ASSERT_EQUAL_UINT(0, decoder.count);
    hear_frame(&sample);
    TEST_ASSERT_EQUAL_UINT(1, found_count);
}

/* A million random bytes, one in eight a sync byte: the buffer is never left, and a good frame gets through
 * afterwards. */
static void test_noise_never_blocks_the_line(void)
{
    uint32_t state = 2463534242u;
    const uint8_t silence[PIL_FRAME_MAX] = {0};

    for (unsigned i = 0; i < 1000000; i++) {
        uint8_t byte;

        state ^= state << 13;
        state ^= state >> 17;
        state ^= state << 5;
        byte = state >> 29 == 0 ? 0xA5 : (uint8_t)(state >> 8 & 0xFF);
        hear(&byte, 1);
        TEST_ASSERT_TRUE(decoder.count < PIL_FRAME_MAX);
    }
    hear(silence, sizeof silence);
    found_count = 0;
    hear_frame(&sample);
    TEST_ASSERT_EQUAL_UINT(1, found_count);
    expect_frame(&sample);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_crc_has_the_check_value);
    RUN_TEST(test_crc_may_be_made_in_parts);
    RUN_TEST(test_frame_has_the_documented_bytes);
    RUN_TEST(test_frames_of_every_length_come_back);
    RUN_TEST(test_floats_keep_every_bit_when_they_are_not_finite);
    RUN_TEST(test_hello_comes_back);
    RUN_TEST(test_garbage_before_a_frame_is_skipped);
    RUN_TEST(test_frames_inside_of_what_looked_like_one_are_found);
    RUN_TEST(test_every_single_wrong_bit_is_found_and_the_next_frame_is_read);
    RUN_TEST(test_every_lost_byte_is_found_and_the_next_frame_is_read);
    RUN_TEST(test_length_beyond_the_largest_is_no_frame);
    RUN_TEST(test_noise_never_blocks_the_line);
    return UNITY_END();
}
