// SPDX-License-Identifier: MIT
// The JSON of the session: session.hpp says what stands in it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "emit/page/page.hpp"
#include "input/edit.hpp"
#include "view/picture.hpp"

namespace lqg::view {

// What a POST asks; nothing where the body is something else.
struct Numbers {
  long revision = 0;
  std::vector<input::Change> changes;
};
std::optional<Numbers> numbers_in(const std::string& body);
std::optional<std::string> name_in(const std::string& body);  // of {name}

struct State {
  long revision = 0;
  std::string path;
  std::vector<std::string> others;
};
std::string state_message(const State& state, const Picture& picture, const std::optional<emit::PageData>& last_good);
std::string trial_message(const Picture& picture, double milliseconds);
std::string superseded_message();
std::string written_message();
std::string error_message(const std::string& why);

}  // namespace lqg::view
