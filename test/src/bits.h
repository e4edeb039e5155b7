/* Every bit of the library's results in one number. */
#ifndef TEST_BITS_H
#define TEST_BITS_H

#include <stddef.h>

/* FNV-1a of more bytes. */
unsigned long long hash_bytes(unsigned long long hash, const void *data, size_t length);

/* Of the states of all filters and estimators after each of 1000 samples. Nothing but the library computes in it with
 * more than one rounding. */
unsigned long long hash_of_all_filters(void);

#endif
