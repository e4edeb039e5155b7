// SPDX-License-Identifier: MIT
// A file that an editor changes while this program looks at it, and that this program may change, too.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace lqg::serve {

class FollowedFile {
 public:
  explicit FollowedFile(std::string path) : path_(std::move(path)) {}

  // The content where it is new: at the first call, and whenever the file has changed or was replaced since. Cheap
  // enough for every 50 ms. Nothing, too, where the file is gone or cannot be read: editors take it away for a moment.
  std::optional<std::string> changed();

  // Is there a regular file?
  bool is_there() const;

  enum class Written { yes, changed_meanwhile, failed };
  struct Outcome {
    Written written = Written::yes;
    std::string why = {};  // of `failed`: the path, and what the operating system says
  };

  // Puts `content` into the place of the file, whole or not at all, with the owner and the permissions that it has; a
  // link stays a link. Not where the file on the disk is another one than `expected`. Between the last look at it and
  // the exchange an editor has some microseconds in which it is not seen.
  Outcome replace(const std::string& expected, const std::string& content) const;

 private:
  struct Look {
    std::uint64_t device = 0, number = 0;
    std::int64_t size = -1, modified = 0, changed = 0;  // bytes; ns
    bool operator==(const Look& other) const {
      return device == other.device && number == other.number && size == other.size && modified == other.modified &&
             changed == other.changed;
    }
  };
  std::optional<Look> look() const;

  std::string path_;
  std::optional<Look> last_;
  std::optional<std::string> content_;
};

}  // namespace lqg::serve
