/* SPDX-License-Identifier: MIT */
#include "target.h"

#include <stdio.h>
#include <string.h>

/* ---- frames --------------------------------------------------------------------------------------------- */

static int send(target_t *target, const pil_frame_t *frame)
{
    uint8_t bytes[PIL_FRAME_MAX];

    return line_write(&target->line, bytes, pil_encode(frame, bytes));
}

/* Waits for any frame. */
static line_result receive(target_t *target, pil_frame_t *frame, double seconds)
{
    const double end = line_seconds() + seconds;

    while (!pil_next(&target->decoder, frame)) {
        uint8_t byte;
        const line_result result = line_read(&target->line, &byte, end - line_seconds());

        if (result != LINE_BYTE)
            return result;
        pil_take(&target->decoder, byte);
    }
    return LINE_BYTE;
}

/* ---- what can go wrong ---------------------------------------------------------------------------------- */

static const char *name_of(unsigned type)
{
    static const char *const names[] = {"?", "HELLO", "START", "SAMPLE", "INPUT", "COST", "REFUSAL"};

    return names[type < sizeof names / sizeof names[0] ? type : 0];
}

static void say_silence(const target_t *target, const char *what, unsigned sequence, line_result result)
{
    if (result == LINE_BROKEN)
        fprintf(stderr, "%s %u: the line to the target is broken.\n", what, sequence);
    else
        fprintf(stderr,
                "%s %u: expected the answer within %.1f s, found %u damaged frames and %lu bytes outside of frames.\n",
                what, sequence, target->patience, target->decoder.damaged, target->decoder.skipped);
}

static void say_refusal(const pil_frame_t *frame)
{
    static const char *const reasons[] = {"?", "the CRC of a frame", "a request of type",
                                          "a payload of so many bytes:", "sample number"};
    const unsigned reason = frame->payload[0];
    uint16_t expected, found;

    pil_get_16(pil_get_16(frame->payload + 1, &expected), &found);
    fprintf(stderr, "The target refuses: %s: expected %u, found %u.\n",
            reasons[reason < sizeof reasons / sizeof reasons[0] ? reason : 0], expected, found);
}

/* The answer of this type, length and sequence number, or what went wrong. */
static int expect(target_t *target, uint8_t type, uint8_t length, uint16_t sequence, pil_frame_t *frame)
{
    line_result result;

    do /* a target that was slow to start may still answer the second HELLO */
        result = receive(target, frame, target->patience);
    while (result == LINE_BYTE && frame->type == PIL_HELLO);
    if (result != LINE_BYTE) {
        say_silence(target, name_of(type), sequence, result);
        return -1;
    }
    if (frame->type == type && frame->sequence == sequence && frame->length == length)
        return 0;
    if (frame->type == PIL_REFUSAL && frame->length == 5)
        say_refusal(frame);
    else
        fprintf(stderr, "Expected %s %u of %u bytes, found %s %u of %u bytes; damaged frames until then: %u.\n",
                name_of(type), sequence, length, name_of(frame->type), frame->sequence, frame->length,
                target->decoder.damaged);
    return -1;
}

/* ---- requests ------------------------------------------------------------------------------------------- */

/* A target that waits for the rest of a damaged frame gets enough to see that it was damaged. */
static int flush_target(target_t *target)
{
    static const uint8_t nothing[PIL_FRAME_MAX];

    return line_write(&target->line, nothing, sizeof nothing);
}

/* Nothing of an earlier conversation may be taken for an answer. */
static int drain(target_t *target)
{
    pil_frame_t frame;
    line_result result;

    do
        result = receive(target, &frame, 0.05);
    while (result == LINE_BYTE);
    target->decoder = (pil_decoder_t){.count = 0};
    return result == LINE_TIMEOUT ? 0 : -1;
}

/* Half a second is enough for a HELLO at 9600 baud. What is said before the target listens is lost. */
int target_greet(target_t *target, pil_hello_t *hello)
{
    const double end = line_seconds() + 5.0 * target->patience;
    line_result result = LINE_TIMEOUT;

    for (uint16_t i = 1; line_seconds() < end && result != LINE_BROKEN; i++) {
        const pil_frame_t request = {.type = PIL_HELLO, .length = 0, .sequence = i};
        pil_frame_t frame;

        if (flush_target(target) != 0 || send(target, &request) != 0)
            break;
        while ((result = receive(target, &frame, 0.5)) == LINE_BYTE)
            if (frame.type == PIL_HELLO && frame.length == PIL_HELLO_SIZE) {
                pil_get_hello(frame.payload, hello);
                return drain(target);
            }
    }
    fprintf(stderr,
            "No target answers HELLO: is it running, and are line and baud rate right?\n"
            "Found %u damaged frames and %lu bytes outside of frames.\n",
            target->decoder.damaged, target->decoder.skipped);
    return -1;
}

int target_start(target_t *target)
{
    const pil_frame_t request = {.type = PIL_START, .length = 0, .sequence = 0};
    pil_frame_t frame;

    if (send(target, &request) != 0) {
        say_silence(target, "START", 0, LINE_BROKEN);
        return -1;
    }
    return expect(target, PIL_START, 0, 0, &frame);
}

int target_run_sample(target_t *target, uint16_t sequence, const float y[CONTROLLER_NY], answer_t *answer)
{
    const double before = line_seconds();
    pil_frame_t frame = {.type = PIL_SAMPLE, .length = 4 * CONTROLLER_NY, .sequence = sequence};
    const uint8_t *at = frame.payload;
    uint32_t status;

    pil_put_floats(frame.payload, y, CONTROLLER_NY);
    if (send(target, &frame) != 0) {
        say_silence(target, "SAMPLE", sequence, LINE_BROKEN);
        return -1;
    }
    if (expect(target, PIL_INPUT, 4 * CONTROLLER_NU + 4, sequence, &frame) != 0)
        return -1;
    answer->round_trip = line_seconds() - before;
    pil_get_32(pil_get_floats(frame.payload, answer->u, CONTROLLER_NU), &status);
    answer->status = (lqg_status_t)status;

    if (expect(target, PIL_COST, 3 * 4 + 4 + 2, sequence, &frame) != 0)
        return -1;
    for (int i = 0; i < 3; i++)
        at = pil_get_32(at, &answer->ticks[i]);
    pil_get_16(pil_get_32(at, &status), &answer->crc);
    answer->status_of_predict = (lqg_status_t)status;
    return 0;
}

/* ---- who it is ------------------------------------------------------------------------------------------ */

static void print_digest(const unsigned char *digest)
{
    for (unsigned i = 0; i < PIL_DIGEST_SIZE; i++)
        fprintf(stderr, "%02x", digest[i]);
}

int target_has_our_controller(const pil_hello_t *hello)
{
    if (hello->version != PIL_VERSION) {
        fprintf(stderr, "The target speaks version %u of the protocol, this program %u.\n", hello->version,
                PIL_VERSION);
        return 0;
    }
    if (strcmp(hello->name, controller_name) != 0 || hello->nx != CONTROLLER_NX || hello->nu != CONTROLLER_NU ||
        hello->ny != CONTROLLER_NY || memcmp(&hello->sample_time, &controller_sample_time, sizeof(float)) != 0) {
        fprintf(stderr,
                "Expected %s with %d states, %d inputs, %d outputs every %g s, found %s with %u, %u, %u every %g s.\n",
                controller_name, CONTROLLER_NX, CONTROLLER_NU, CONTROLLER_NY, (double)controller_sample_time,
                hello->name, hello->nx, hello->nu, hello->ny, (double)hello->sample_time);
        return 0;
    }
    if (memcmp(hello->digest, controller_digest, PIL_DIGEST_SIZE) != 0) {
        fprintf(stderr, "%s of another design: expected SHA-256 ", hello->name);
        print_digest(controller_digest);
        fprintf(stderr, ", found ");
        print_digest(hello->digest);
        fprintf(stderr, ". Build and flash the target again.\n");
        return 0;
    }
    return 1;
}
