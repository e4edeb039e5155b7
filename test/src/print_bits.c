/* SPDX-License-Identifier: MIT */
/* Prints the hashes of every bit of the library's results, for bits_everywhere.cmake. */
#include <stdio.h>

#include "bits.h"

int main(void)
{
    printf("%016llx\n", hash_of_all_filters());
    printf("%016llx %016llx\n", hash_of_all_functions(), hash_of_all_double_functions());
    return 0;
}
