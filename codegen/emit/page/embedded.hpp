// SPDX-License-Identifier: MIT
// What the page brings along; embed.cmake makes it of the files in emit/page/live and of Chart.js.
#pragma once

namespace lqg::emit::embedded {

extern const char* const style;     // page.css
extern const char* const chart_js;  // Chart.js, with its licence; no address of a network
extern const char* const data;      // our own scripts, to be joined in this order
extern const char* const chart;
extern const char* const figure;
extern const char* const copy;
extern const char* const page;

}  // namespace lqg::emit::embedded
