// SPDX-License-Identifier: MIT
// From the text of a design file to its page, on the way that `lqgen check` goes.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "design/scenario.hpp"
#include "emit/page/page.hpp"
#include "view/tunables.hpp"

namespace lqg::view {

struct Picture {
  std::vector<std::string> lines;           // what the terminal would say: "servo.toml:9:5: plant.B: expected …"
  int line = 0;                             // of the first error; 0: none has a line
  bool has_error = false;                   // one of the lines is an error
  std::vector<Tunable> tunables;            // of a file without an error in it, even where its design is impossible
  std::vector<design::Scenario> scenarios;  // what the page shows at work
  std::optional<emit::PageData> page;       // none where there is nothing to see
};

// A first look has the curves of design::first_look and no lines beyond those of the file: where it finds no page,
// only the whole tells why. What [require] asks for and is missed is an error with a page: a person sees how far the
// design is from it. The whole of a design with another error has the page of a first look where there is one.
enum class Depth { first_look, whole };

// `path`: how the messages call the file. Where it has no scenarios, those of `like` say when things happen, if they
// have the same names: the curves of two pictures then lie over each other.
Picture picture_of(const std::string& text, const std::string& path, Depth depth,
                   const std::vector<design::Scenario>& like = {});

// A page that says that there is nothing to see yet.
emit::PageData empty_page(const std::string& path);

}  // namespace lqg::view
