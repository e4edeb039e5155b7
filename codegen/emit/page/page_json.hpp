// SPDX-License-Identifier: MIT
// The charts of a page for its script.
#pragma once

#include <string>

#include "emit/page/page.hpp"

namespace lqg::emit {

//   title   of the page
//   body    what people see of it but the pictures, HTML; only with `with_body`
//   lists   of of numbers, null where a value is not finite
//   charts  [{id, title, group, square, x: {label, log}, y, view: [x low, x high, y low, y high],
//             curves: [{label, owner, mark, colour, role, x: which of the lists, y: which,
//             texts: [of each point]}],
//             bands: [{label, owner, colour, x: which of the lists, low, high}], circles: [{x, y, radius}],
//             guides: [{axis, at, label}], notes: [{x, y, dx, dy, text}], events: [{at, label}]}]
//
// Numbers have six digits. The text can stand in a script element: it has neither < nor anything beyond ASCII.
std::string json_of(const PageData& data, bool with_body);

}  // namespace lqg::emit
