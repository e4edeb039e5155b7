/* SPDX-License-Identifier: MIT */
/* TinyLQG for Arduino: the library of lqg/lqg.h. A sketch with a controller that lqgen made includes this first: it is
 * how the IDE finds the library. */
#ifndef TINYLQG_ARDUINO_H
#define TINYLQG_ARDUINO_H

#include "lqg/lqg.h"

#endif
