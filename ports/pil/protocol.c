/* SPDX-License-Identifier: MIT */
#include "protocol.h"

enum { SYNC = 0xA5, HEADER = 5, CRC = 2 };

/* ---- numbers -------------------------------------------------------------------------------------------- */

uint8_t *pil_put_16(uint8_t *at, uint16_t value)
{
    *at++ = (uint8_t)(value & 0xFF);
    *at++ = (uint8_t)(value >> 8);
    return at;
}

uint8_t *pil_put_32(uint8_t *at, uint32_t value)
{
    return pil_put_16(pil_put_16(at, (uint16_t)(value & 0xFFFF)), (uint16_t)(value >> 16));
}

typedef union {
    float value;
    uint32_t bits;
} float_bits;

uint8_t *pil_put_floats(uint8_t *at, const float *values, unsigned count)
{
    for (unsigned i = 0; i < count; i++) {
        const float_bits number = {.value = values[i]};

        at = pil_put_32(at, number.bits);
    }
    return at;
}

const uint8_t *pil_get_16(const uint8_t *at, uint16_t *value)
{
    *value = (uint16_t)(at[0] | at[1] << 8);
    return at + 2;
}

const uint8_t *pil_get_32(const uint8_t *at, uint32_t *value)
{
    uint16_t low, high;

    at = pil_get_16(pil_get_16(at, &low), &high);
    *value = low | (uint32_t)high << 16;
    return at;
}

const uint8_t *pil_get_floats(const uint8_t *at, float *values, unsigned count)
{
    for (unsigned i = 0; i < count; i++) {
        float_bits number;

        at = pil_get_32(at, &number.bits);
        values[i] = number.value;
    }
    return at;
}

void pil_put_hello(uint8_t *payload, const pil_hello_t *hello)
{
    *payload++ = hello->version;
    *payload++ = hello->nx;
    *payload++ = hello->nu;
    *payload++ = hello->ny;
    payload = pil_put_floats(payload, &hello->sample_time, 1);
    for (unsigned i = 0; i < PIL_DIGEST_SIZE; i++)
        *payload++ = hello->digest[i];
    payload = pil_put_32(pil_put_32(payload, hello->ticks_of_thousand), hello->frequency);
    for (unsigned i = 0; i < PIL_NAME_SIZE; i++)
        *payload++ = (uint8_t)hello->name[i];
}

void pil_get_hello(const uint8_t *payload, pil_hello_t *hello)
{
    hello->version = *payload++;
    hello->nx = *payload++;
    hello->nu = *payload++;
    hello->ny = *payload++;
    payload = pil_get_floats(payload, &hello->sample_time, 1);
    for (unsigned i = 0; i < PIL_DIGEST_SIZE; i++)
        hello->digest[i] = *payload++;
    payload = pil_get_32(pil_get_32(payload, &hello->ticks_of_thousand), &hello->frequency);
    for (unsigned i = 0; i < PIL_NAME_SIZE; i++)
        hello->name[i] = (char)*payload++;
    hello->name[PIL_NAME_SIZE - 1] = '\0';
}

/* ---- frames --------------------------------------------------------------------------------------------- */

uint16_t pil_crc(uint16_t crc, const uint8_t *bytes, unsigned count)
{
    for (unsigned i = 0; i < count; i++) {
        crc = (uint16_t)(crc ^ bytes[i] << 8);
        for (int bit = 0; bit < 8; bit++)
            crc = (uint16_t)(crc & 0x8000 ? crc << 1 ^ 0x1021 : crc << 1);
    }
    return crc;
}

uint16_t pil_crc_of_floats(const float *values, unsigned count)
{
    uint16_t crc = PIL_CRC_START;

    for (unsigned i = 0; i < count; i++) {
        uint8_t bytes[4];

        pil_put_floats(bytes, &values[i], 1);
        crc = pil_crc(crc, bytes, sizeof bytes);
    }
    return crc;
}

unsigned pil_encode(const pil_frame_t *frame, uint8_t bytes[PIL_FRAME_MAX])
{
    uint8_t *at = bytes;

    *at++ = SYNC;
    *at++ = frame->type;
    *at++ = frame->length;
    at = pil_put_16(at, frame->sequence);
    for (unsigned i = 0; i < frame->length; i++)
        *at++ = frame->payload[i];
    pil_put_16(at, pil_crc(PIL_CRC_START, bytes + 1, HEADER - 1u + frame->length));
    return HEADER + frame->length + CRC;
}

/* Drops the first `count` bytes, and all after them up to where a frame may begin. */
static void drop(pil_decoder_t *decoder, unsigned count)
{
    unsigned kept = 0;

    while (count < decoder->count && decoder->bytes[count] != SYNC) {
        count++;
        decoder->skipped++;
    }
    while (count < decoder->count)
        decoder->bytes[kept++] = decoder->bytes[count++];
    decoder->count = kept;
}

static void skip_first(pil_decoder_t *decoder)
{
    decoder->skipped++;
    drop(decoder, 1);
}

static void deliver(pil_decoder_t *decoder, pil_frame_t *frame)
{
    const uint8_t *at = decoder->bytes + 1;

    frame->type = *at++;
    frame->length = *at++;
    at = pil_get_16(at, &frame->sequence);
    for (unsigned i = 0; i < frame->length; i++)
        frame->payload[i] = *at++;
    drop(decoder, HEADER + frame->length + CRC);
}

static int has_good_crc(pil_decoder_t *decoder, unsigned length)
{
    const uint16_t crc = pil_crc(PIL_CRC_START, decoder->bytes + 1, HEADER - 1u + length);
    uint16_t sent;

    pil_get_16(decoder->bytes + HEADER + length, &sent);
    if (sent == crc)
        return 1;
    decoder->damaged++;
    decoder->crc_expected = crc;
    decoder->crc_found = sent;
    return 0;
}

void pil_take(pil_decoder_t *decoder, uint8_t byte)
{
    decoder->bytes[decoder->count++] = byte;
    if (decoder->bytes[0] != SYNC)
        skip_first(decoder);
}

/* Whatever starts the buffer may be a frame: if it is not, its first byte goes, and what remains is looked at again. */
int pil_next(pil_decoder_t *decoder, pil_frame_t *frame)
{
    while (decoder->count >= HEADER) {
        const unsigned length = decoder->bytes[2];

        if (length > PIL_PAYLOAD_MAX) {
            skip_first(decoder);
            continue;
        }
        if (decoder->count < HEADER + length + CRC)
            return 0;
        if (has_good_crc(decoder, length)) {
            deliver(decoder, frame);
            return 1;
        }
        skip_first(decoder);
    }
    return 0;
}
