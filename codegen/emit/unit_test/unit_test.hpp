// SPDX-License-Identifier: MIT
// NAME_test.c: a Unity test that holds the emitted C against the host's reference.
#pragma once

#include <string>

#include "emit/controller.hpp"

namespace lqg::emit {

std::string unit_test(const Controller& controller);

}  // namespace lqg::emit
