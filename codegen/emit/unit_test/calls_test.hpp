// SPDX-License-Identifier: MIT
// The test that makes every call of the header, and holds what it answers against the host.
#pragma once

#include <string>

#include "emit/vectors/calls.hpp"

namespace lqg::emit {

// The turns as data, and what hands them over.
std::string turns_as_data(const Controller& controller, const Calls& calls);

// test_NAME_answers_every_call_as_the_host_does
std::string calls_test(const Controller& controller);

}  // namespace lqg::emit
