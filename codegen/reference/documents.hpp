// SPDX-License-Identifier: MIT
// What is made from the table of keys for people and editors.
#pragma once

#include <string>

namespace lqg::reference {

// The JSON Schema (draft 2020-12) of a design file. That sizes of matrices agree it cannot say: lqgen checks that.
std::string schema();

// The page codegen/keys.md: a table of keys for each table of the design file.
std::string page();

// The section of the manual page, in roff.
std::string manual();

}  // namespace lqg::reference
