// SPDX-License-Identifier: MIT
// `lqgen run`: the emitted controller behind a pipe, for simulators of other languages.
#pragma once

#include <iosfwd>
#include <string>

#include "controller/controller.hpp"

namespace lqg::commands {

// Runs `controller` sample by sample: a line of numbers in, a line of numbers out, those of the compiled header; only a
// zero may have the other sign.
//
//   in    y, with r behind it or not; r keeps what it was. Without a filter x in place of y. Of an estimator alone y
//         and the u that acts from now on. Blanks or commas stand between the numbers; nan is an output that is
//         missing.
//   reset begins anew, as at the start, and answers nothing.
//   out   u within its limits, x̂ that it was made of, the status as a number: the bits of lqg/status.h. Of an
//         estimator alone without u. Each number is the shortest decimal that reads back as the same double.
//
// Each answer is flushed. Ends where `in` ends, with nothing returned, or where `out` fails. A line that is wrong ends
// it, too: then the reason is returned, with the number of the line.
std::string run(const controller::Controller& controller, std::istream& in, std::ostream& out);

}  // namespace lqg::commands
