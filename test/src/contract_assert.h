/* SPDX-License-Identifier: MIT */
/* The LQG_ASSERT of test_contract.c: it does not return. */
#ifndef TEST_CONTRACT_ASSERT_H
#define TEST_CONTRACT_ASSERT_H

void contract_broken(const char *condition);

#define LQG_ASSERT(condition) ((condition) ? (void)0 : contract_broken(#condition))

#endif
