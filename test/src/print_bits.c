/* SPDX-License-Identifier: MIT */
/* Prints the hash of every bit of the library's results, for bits_everywhere.cmake. */
#include <stdio.h>

#include "bits.h"

int main(void)
{
    printf("%016llx\n", hash_of_all_filters());
    return 0;
}
