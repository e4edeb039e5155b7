// SPDX-License-Identifier: MIT
// The panel of the live page; embed.cmake makes it of the files in view/panel.
#pragma once

namespace lqg::view::panel {

extern const char* const body;    // panel.html
extern const char* const style;   // panel.css
extern const char* const script;  // panel.js

}  // namespace lqg::view::panel
