// SPDX-License-Identifier: MIT
// A folder that one process at a time changes, by names within it: where its path leads later does not matter.
#pragma once

#include <chrono>
#include <optional>
#include <string>

namespace lqg::emit {

class Folder {
 public:
  // errno values, here and below; 0: it went well.
  static constexpr int busy = -1;  // another process has kept its lock for `patience`

  explicit Folder(const std::string& path) : path_(path) {}
  ~Folder();
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  int open_and_lock(std::chrono::milliseconds patience);
  bool is_locked() const { return is_locked_; }  // false: the file system cannot

  // A new file, on the disk; EEXIST where anything has that name, a link too.
  int create(const std::string& name, const std::string& content) const;
  int rename(const std::string& from, const std::string& to) const;
  int link(const std::string& from, const std::string& to) const;
  int remove(const std::string& name) const;
  int sync() const;

  enum class Kind { nothing, folder, own, other };  // own: of this user, no folder
  Kind kind_of(const std::string& name) const;

  const std::string& path() const { return path_; }

 private:
  std::string path_;
  int folder_ = -1;
  bool is_locked_ = false;
};

}  // namespace lqg::emit
