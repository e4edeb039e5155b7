// SPDX-License-Identifier: MIT
// `lqgen check --json`: what there is to say of a design file, for editors and scripts.
#pragma once

#include <string>

#include "controller/controller.hpp"
#include "input/design_file.hpp"

namespace lqg::commands {

// {"status": …, "findings": [{"severity", "line", "column", "key", "message"}, …], "design": …}: the findings by their
// place, line and column from 1, both 0 where a finding has none; "design" is NAME.json, or null where there is none.
std::string check_json(int status, const input::DesignFile& file, design::Findings findings,
                       const controller::Controller* controller);

}  // namespace lqg::commands
