/* SPDX-License-Identifier: MIT */
/* What Unity calls around each test, for tests that need nothing done there. In an archive: who has his own does not
 * meet these. */
void setUp(void);
void tearDown(void);

void setUp(void) {}

void tearDown(void) {}
