// SPDX-License-Identifier: MIT
// `lqgen new`: a commented design file to begin with.
#pragma once

#include <optional>
#include <string>

namespace lqg::commands {

// A line for each starter: its name, and what it controls.
std::string list_of_starters();

// The starter's text with `name` in place of its own; nothing where there is no such starter.
std::optional<std::string> text_of_starter(const std::string& starter, const std::string& name);

// The name of the starter that is spelt most alike, or "".
std::string nearest_starter(const std::string& word);

// Why there can be no design of this name, "expected …, found …"; nothing where there can.
std::optional<std::string> refuse_name(const std::string& name);

// Writes FOLDER/NAME.toml, unless there is one, and returns why it failed: then there is no new file.
std::optional<std::string> write_new(const std::string& folder, const std::string& name, const std::string& text);

}  // namespace lqg::commands
