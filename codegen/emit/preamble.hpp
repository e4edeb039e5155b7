// The comment at the top of every emitted file.
#pragma once

#include <string>

#include "emit/controller.hpp"

namespace lqg::emit {

std::string version();
std::string header_format();

// Who made the file, of what, and what may be done with it: lines of a comment.
std::string provenance(const Controller& controller);

// The whole comment that opens the header.
std::string preamble(const Controller& controller);

}  // namespace lqg::emit
