// Strings with places to fill in; nothing of a design.
#pragma once

#include <map>
#include <string>

namespace lqg::emit {

using Words = std::map<std::string, std::string>;

// `text` with every {word} replaced by its meaning.
std::string fill(const std::string& text, const Words& words);

std::string upper(std::string text);

}  // namespace lqg::emit
