/* SPDX-License-Identifier: MIT */
/* Many bits in one number. */
#ifndef TEST_HASH_H
#define TEST_HASH_H

#include <stddef.h>

#define NOTHING_HASHED 14695981039346656037ull

/* FNV-1a, 64 bits, of more bytes. */
static inline unsigned long long hash_bytes(unsigned long long hash, const void *data, size_t length)
{
    const unsigned char *bytes = (const unsigned char *)data;
    for (size_t i = 0; i < length; i++)
        hash = (hash ^ bytes[i]) * 1099511628211ull;
    return hash;
}

#endif
