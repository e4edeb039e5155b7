/* SPDX-License-Identifier: MIT */
/* TinyLQG: version of the library, and the number by which a generated header and the library know each other. */
#ifndef LQG_VERSION_H
#define LQG_VERSION_H

#define LQG_VERSION_MAJOR 0
#define LQG_VERSION_MINOR 2
#define LQG_VERSION_PATCH 0

/* Changes whenever a header made by an older lqgen can no longer be used with this library. */
#define LQG_HEADER_FORMAT 3

#endif
