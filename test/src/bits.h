/* SPDX-License-Identifier: MIT */
/* Every bit of the library's results in one number. */
#ifndef TEST_BITS_H
#define TEST_BITS_H

/* Of the states of all filters and estimators after each of 1000 samples. Nothing but the library computes in it with
 * more than one rounding. */
unsigned long long hash_of_all_filters(void);

/* Of each function of lqg/functions.h for 1000 arguments, of float; of double, where the target has it. */
unsigned long long hash_of_all_functions(void);
unsigned long long hash_of_all_double_functions(void);

#endif
