/* SPDX-License-Identifier: MIT */
/* The controller on its processor: y comes in over the serial line, u goes out as soon as it is there, and after the
 * prediction what each of the three steps has taken. */
#include "board.h"
#include "controller.h"
#include "protocol.h"
#include "ticks.h"

/* ---- what a step takes ---------------------------------------------------------------------------------- */

static controller_t loop;
static float y[CONTROLLER_NY], u[CONTROLLER_NU];

typedef lqg_status_t step_t(void);

static lqg_status_t update(void)
{
    return controller_update(&loop, y);
}

static lqg_status_t control(void)
{
    return controller_control(&loop, u);
}

static lqg_status_t predict(void)
{
    return controller_predict(&loop, u);
}

static lqg_status_t do_nothing(void)
{
    return LQG_OK;
}

static lqg_status_t do_nothing_a_thousand_times(void)
{
    __asm__ volatile(
        ".rept 1000\n\t"
        "nop\n\t"
        ".endr");
    return LQG_OK;
}

static uint32_t ticks_of_frame; /* what measuring takes by itself */

/* Not inlined: what stands between the two readings is the same for every step. */
__attribute__((noinline)) static uint32_t ticks_of(step_t *step, lqg_status_t *status)
{
    const uint32_t before = counter_now();

    *status |= step();
    return pil_ticks(before, counter_now(), counter_mask, ticks_of_frame);
}

/* The least of several: the first fills the caches, where there are any, and another may be interrupted. */
static uint32_t least_ticks_of(step_t *step)
{
    enum { TIMES = 16 };
    lqg_status_t status = LQG_OK;
    uint32_t least = counter_mask;

    for (int i = 0; i < TIMES; i++) {
        const uint32_t ticks = ticks_of(step, &status);

        if (ticks < least)
            least = ticks;
    }
    return least;
}

/* ---- what is said --------------------------------------------------------------------------------------- */

static pil_decoder_t decoder;
static unsigned damaged; /* frames that have been complained about */
static uint16_t next_sample;
static uint32_t ticks_of_thousand;

static void send(const pil_frame_t *frame)
{
    uint8_t bytes[PIL_FRAME_MAX];
    const unsigned count = pil_encode(frame, bytes);

    for (unsigned i = 0; i < count; i++)
        uart_write(bytes[i]);
}

static void refuse(uint16_t sequence, uint8_t reason, uint16_t expected, uint16_t found)
{
    pil_frame_t frame = {.type = PIL_REFUSAL, .length = 5, .sequence = sequence};

    frame.payload[0] = reason;
    pil_put_16(pil_put_16(frame.payload + 1, expected), found);
    send(&frame);
}

static void answer_hello(const pil_frame_t *request)
{
    pil_hello_t hello = {.version = PIL_VERSION,
                         .nx = CONTROLLER_NX,
                         .nu = CONTROLLER_NU,
                         .ny = CONTROLLER_NY,
                         .sample_time = controller_sample_time,
                         .ticks_of_thousand = ticks_of_thousand,
                         .frequency = counter_frequency};
    pil_frame_t frame = {.type = PIL_HELLO, .length = PIL_HELLO_SIZE, .sequence = request->sequence};

    for (unsigned i = 0; i < PIL_DIGEST_SIZE; i++)
        hello.digest[i] = controller_digest[i];
    for (unsigned i = 0; i < sizeof controller_name && i < PIL_NAME_SIZE - 1; i++)
        hello.name[i] = controller_name[i];
    pil_put_hello(frame.payload, &hello);
    send(&frame);
}

static void start_anew(const pil_frame_t *request)
{
    const pil_frame_t frame = {.type = PIL_START, .length = 0, .sequence = request->sequence};

    controller_init(&loop);
    next_sample = 0;
    send(&frame);
}

static void send_input(uint16_t sequence, lqg_status_t status)
{
    pil_frame_t frame = {.type = PIL_INPUT, .length = 4 * CONTROLLER_NU + 4, .sequence = sequence};

    pil_put_32(pil_put_floats(frame.payload, u, CONTROLLER_NU), status);
    send(&frame);
}

static void send_cost(uint16_t sequence, const uint32_t ticks[3], lqg_status_t status)
{
    pil_frame_t frame = {.type = PIL_COST, .length = 3 * 4 + 4 + 2, .sequence = sequence};
    uint8_t *at = frame.payload;

    for (int i = 0; i < 3; i++)
        at = pil_put_32(at, ticks[i]);
    pil_put_16(pil_put_32(at, status), pil_crc_of_floats((const float *)&loop, CONTROLLER_FLOATS));
    send(&frame);
}

/* One sample as firmware runs it: u first, then the prediction. */
static void run_sample(const pil_frame_t *request)
{
    lqg_status_t status = LQG_OK, status_of_predict = LQG_OK;
    uint32_t ticks[3];

    if (request->sequence != next_sample) {
        refuse(request->sequence, PIL_WRONG_SEQUENCE, next_sample, request->sequence);
        return;
    }
    next_sample++;
    pil_get_floats(request->payload, y, CONTROLLER_NY);
    ticks[0] = ticks_of(update, &status);
    ticks[1] = ticks_of(control, &status);
    send_input(request->sequence, status);
    ticks[2] = ticks_of(predict, &status_of_predict);
    send_cost(request->sequence, ticks, status_of_predict);
}

static void serve(const pil_frame_t *request)
{
    const unsigned length = request->type == PIL_SAMPLE ? 4 * CONTROLLER_NY : 0;

    if (request->type < PIL_HELLO || request->type > PIL_SAMPLE)
        refuse(request->sequence, PIL_WRONG_TYPE, PIL_SAMPLE, request->type);
    else if (request->length != length)
        refuse(request->sequence, PIL_WRONG_LENGTH, (uint16_t)length, request->length);
    else if (request->type == PIL_HELLO)
        answer_hello(request);
    else if (request->type == PIL_START)
        start_anew(request);
    else
        run_sample(request);
}

static void complain_of_damage(void)
{
    if (decoder.damaged == damaged)
        return;
    damaged = decoder.damaged;
    refuse(next_sample, PIL_BAD_CRC, decoder.crc_expected, decoder.crc_found);
}

/* Some µs, far less than a byte takes. An emulator that is asked for a byte all the time does not come to fetch one. */
static void wait_a_little(void)
{
    for (volatile int i = 0; i < 20; i++)
        ;
}

int main(void)
{
    uart_start();
    counter_start();
    ticks_of_frame = least_ticks_of(do_nothing);
    ticks_of_thousand = least_ticks_of(do_nothing_a_thousand_times);
    controller_init(&loop);
    for (;;) {
        const int byte = uart_read();
        pil_frame_t request;

        if (byte < 0) {
            wait_a_little();
            continue;
        }
        pil_take(&decoder, (uint8_t)byte);
        while (pil_next(&decoder, &request))
            serve(&request);
        complain_of_damage();
    }
}
