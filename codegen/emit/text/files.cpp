#include "emit/text/files.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

namespace lqg::emit {

namespace {

namespace fs = std::filesystem;

std::string because(const fs::path& path, int error) { return path.string() + ": " + std::strerror(error); }

std::optional<std::string> write_and_sync(const fs::path& path, const std::string& content) {
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (file < 0) return because(path, errno);
  std::size_t written = 0;
  int error = 0;
  while (error == 0 && written < content.size()) {
    const ssize_t count = ::write(file, content.data() + written, content.size() - written);
    if (count > 0) written += static_cast<std::size_t>(count);
    else if (errno != EINTR) error = errno;
  }
  if (error == 0 && ::fsync(file) != 0 && errno != EINVAL) error = errno;
  if (::close(file) != 0 && error == 0) error = errno;
  if (error != 0) return because(path, error);
  return std::nullopt;
}

// A name beside `path` that nobody else uses at the same time.
fs::path beside(const fs::path& path, const char* what) {
  return path.string() + "." + what + std::to_string(::getpid());
}

struct Pending {
  fs::path place, fresh, kept;
  bool is_kept = false, is_placed = false;
};

void undo(std::vector<Pending>& files) {
  std::error_code ignored;
  for (Pending& file : files) {
    if (file.is_placed && !file.is_kept) fs::remove(file.place, ignored);
    if (file.is_kept) fs::rename(file.kept, file.place, ignored);
    fs::remove(file.kept, ignored);  // a rename between two names of one file does nothing
    fs::remove(file.fresh, ignored);
  }
}

// The old file has a second name until all new ones are in their places, and is never missing from its own.
std::optional<std::string> put_in_place(Pending& file) {
  std::error_code error;
  const fs::file_status old = fs::symlink_status(file.place, error);
  if (fs::is_directory(old)) return because(file.place, EISDIR);
  if (fs::exists(old)) {
    fs::create_hard_link(file.place, file.kept, error);
    if (error) fs::rename(file.place, file.kept, error);  // a file system without links
    if (error) return because(file.place, error.value());
    file.is_kept = true;
  }
  fs::rename(file.fresh, file.place, error);
  if (error) return because(file.place, error.value());
  file.is_placed = true;
  return std::nullopt;
}

}  // namespace

std::optional<std::string> write_all(const std::string& folder, const std::vector<File>& files) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) return because(folder, error.value());

  std::vector<Pending> pending;
  for (const File& file : files) {
    const fs::path place = fs::path(folder) / file.name;
    pending.push_back({place, beside(place, "new"), beside(place, "old")});
    if (const auto failure = write_and_sync(pending.back().fresh, file.content)) {
      undo(pending);
      return failure;
    }
  }
  for (Pending& file : pending)
    if (const auto failure = put_in_place(file)) {
      undo(pending);
      return failure;
    }
  for (const Pending& file : pending)
    if (file.is_kept) fs::remove(file.kept, error);
  return std::nullopt;
}

}  // namespace lqg::emit
