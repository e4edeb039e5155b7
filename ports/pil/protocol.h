/* SPDX-License-Identifier: MIT */
/* What the host that simulates the plant and the target that runs the controller say to each other, over any serial
 * line. One text for both: C99, freestanding, no heap.
 *
 * A frame, numbers in little endian:
 *
 *     0xA5 | type | length | sequence (2) | payload (length) | CRC (2)
 *
 * The CRC is CRC-16/CCITT-FALSE (polynomial 0x1021, from 0xFFFF) of all between 0xA5 and itself. Floats travel as their
 * bits. */
#ifndef PIL_PROTOCOL_H
#define PIL_PROTOCOL_H

#include <stdint.h>

enum { PIL_VERSION = 1 };

enum { PIL_PAYLOAD_MAX = 128, PIL_FRAME_MAX = PIL_PAYLOAD_MAX + 7 };

/* Host to target is a request, target to host the answer, with the request's sequence number. */
enum {
    PIL_HELLO = 1,  /* request: empty           answer: pil_hello_t */
    PIL_START = 2,  /* request: empty           answer: empty; the controller is reset, the next sample is number 0 */
    PIL_SAMPLE = 3, /* request: y, ny floats    answer: PIL_INPUT at once, then PIL_COST */
    PIL_INPUT = 4,  /* u, nu floats; status (4) of update and control */
    PIL_COST = 5,   /* ticks of update, control, predict (4 each); status (4) of predict; CRC (2) of the state */
    PIL_REFUSAL = 6 /* instead of an answer: reason (1), what was expected (2), what was found (2) */
};

/* Why a target refuses. */
enum {
    PIL_BAD_CRC = 1,       /* bytes were damaged or lost: expected and found are the CRCs */
    PIL_WRONG_TYPE = 2,    /* no such request; expected: the last one there is */
    PIL_WRONG_LENGTH = 3,  /* of the payload */
    PIL_WRONG_SEQUENCE = 4 /* a sample was lost, or came twice */
};

typedef struct {
    uint8_t type, length;
    uint16_t sequence;
    uint8_t payload[PIL_PAYLOAD_MAX];
} pil_frame_t;

/* Who the target is. */
enum { PIL_NAME_SIZE = 32, PIL_DIGEST_SIZE = 32, PIL_HELLO_SIZE = 4 + 4 + PIL_DIGEST_SIZE + 8 + PIL_NAME_SIZE };

typedef struct {
    uint8_t version; /* PIL_VERSION */
    uint8_t nx, nu, ny;
    float sample_time;               /* s */
    uint8_t digest[PIL_DIGEST_SIZE]; /* SHA-256 of the design file */
    uint32_t ticks_of_thousand;      /* ticks of its counter for a thousand instructions that do nothing */
    uint32_t frequency;              /* Hz of the processor, 0: emulated */
    char name[PIL_NAME_SIZE];        /* of the controller; what is left is '\0' */
} pil_hello_t;

/* ---- numbers in a payload: each function returns what follows ------------------------------------------- */

uint8_t *pil_put_16(uint8_t *at, uint16_t value);
uint8_t *pil_put_32(uint8_t *at, uint32_t value);
uint8_t *pil_put_floats(uint8_t *at, const float *values, unsigned count);
const uint8_t *pil_get_16(const uint8_t *at, uint16_t *value);
const uint8_t *pil_get_32(const uint8_t *at, uint32_t *value);
const uint8_t *pil_get_floats(const uint8_t *at, float *values, unsigned count);

/* All PIL_HELLO_SIZE bytes. */
void pil_put_hello(uint8_t *payload, const pil_hello_t *hello);
void pil_get_hello(const uint8_t *payload, pil_hello_t *hello);

/* ---- frames --------------------------------------------------------------------------------------------- */

/* Of `count` bytes, after others whose CRC was `crc`; PIL_CRC_START before the first. */
enum { PIL_CRC_START = 0xFFFF };
uint16_t pil_crc(uint16_t crc, const uint8_t *bytes, unsigned count);

/* The CRC of floats, as the target of little endian has them in its memory. */
uint16_t pil_crc_of_floats(const float *values, unsigned count);

/* Writes a frame of at most PIL_FRAME_MAX bytes; returns their number. */
unsigned pil_encode(const pil_frame_t *frame, uint8_t bytes[PIL_FRAME_MAX]);

/* Finds frames in what comes in, byte by byte; begins as {0}. After damage it looks for the next frame in what it has
 * already. */
typedef struct {
    uint8_t bytes[PIL_FRAME_MAX];
    unsigned count;
    unsigned long skipped;            /* bytes that belonged to no frame */
    unsigned damaged;                 /* frames, or what looked like one, with a wrong CRC */
    uint16_t crc_expected, crc_found; /* of the last of these */
} pil_decoder_t;

/* Takes a byte, and may be given another only when pil_next has no frame left. */
void pil_take(pil_decoder_t *decoder, uint8_t byte);

/* 1: the next frame is in *frame. 0: it needs more bytes. */
int pil_next(pil_decoder_t *decoder, pil_frame_t *frame);

#endif
