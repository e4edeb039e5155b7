// SPDX-License-Identifier: MIT
#include "emit/text/folder.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <thread>

namespace lqg::emit {

namespace {

int error_of(int result) { return result == 0 ? 0 : errno; }

// Not every file system has this for a file or a folder of its own.
int sync_file(int file) { return ::fsync(file) == 0 || errno == EINVAL ? 0 : errno; }

int write_to(int file, const std::string& content) {
  for (std::size_t written = 0; written < content.size();) {
    const ssize_t count = ::write(file, content.data() + written, content.size() - written);
    if (count > 0)
      written += static_cast<std::size_t>(count);
    else if (errno != EINTR)
      return errno;
  }
  return sync_file(file);
}

}  // namespace

Folder::~Folder() {
  if (folder_ >= 0) ::close(folder_);  // and the lock is gone
}

int Folder::open_and_lock(std::chrono::milliseconds patience) {
  folder_ = ::open(path_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder_ < 0) return errno;
  const auto end = std::chrono::steady_clock::now() + patience;
  while (::flock(folder_, LOCK_EX | LOCK_NB) != 0) {
    if (errno != EWOULDBLOCK && errno != EINTR) return 0;
    if (std::chrono::steady_clock::now() >= end) return busy;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  is_locked_ = true;
  return 0;
}

int Folder::create(const std::string& name, const std::string& content) const {
  const int file = ::openat(folder_, name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
  if (file < 0) return errno;
  const int error = write_to(file, content);
  const int closed = error_of(::close(file));
  return error != 0 ? error : closed;
}

int Folder::rename(const std::string& from, const std::string& to) const {
  return error_of(::renameat(folder_, from.c_str(), folder_, to.c_str()));
}

int Folder::link(const std::string& from, const std::string& to) const {
  return error_of(::linkat(folder_, from.c_str(), folder_, to.c_str(), 0));
}

int Folder::remove(const std::string& name) const { return error_of(::unlinkat(folder_, name.c_str(), 0)); }

int Folder::sync() const { return sync_file(folder_); }

Folder::Kind Folder::kind_of(const std::string& name) const {
  struct stat status;
  if (::fstatat(folder_, name.c_str(), &status, AT_SYMLINK_NOFOLLOW) != 0) return Kind::nothing;
  if (S_ISDIR(status.st_mode)) return Kind::folder;
  return status.st_uid == ::geteuid() ? Kind::own : Kind::other;
}

}  // namespace lqg::emit
