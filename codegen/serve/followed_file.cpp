// SPDX-License-Identifier: MIT
#include "serve/followed_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <climits>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <memory>

namespace lqg::serve {

namespace {

constexpr std::size_t largest_content = (4u << 20) + 1;  // bytes; one more than the largest design file
constexpr std::int64_t second = 1000000000;              // ns

#ifdef __APPLE__
std::int64_t modified_at(const struct stat& status) {
  return status.st_mtimespec.tv_sec * second + status.st_mtimespec.tv_nsec;
}
std::int64_t changed_at(const struct stat& status) {
  return status.st_ctimespec.tv_sec * second + status.st_ctimespec.tv_nsec;
}
#else
std::int64_t modified_at(const struct stat& status) { return status.st_mtim.tv_sec * second + status.st_mtim.tv_nsec; }
std::int64_t changed_at(const struct stat& status) { return status.st_ctim.tv_sec * second + status.st_ctim.tv_nsec; }
#endif

// Two changes within one tick of the file system's clock look like one: until it is past, the content decides.
bool is_fresh(std::int64_t modified) {
  const std::int64_t now =
      std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::system_clock::now().time_since_epoch()).count();
  return now - modified < 2 * second;
}

class OpenFile {
 public:
  explicit OpenFile(int file) : file_(file) {}
  ~OpenFile() { close(); }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
  int get() const { return file_; }
  int close() {
    const int result = file_ >= 0 ? ::close(file_) : 0;
    file_ = -1;
    return result;
  }

 private:
  int file_;
};

std::optional<std::string> content_of(const std::string& path) {
  const OpenFile file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  struct stat status;
  if (file.get() < 0 || ::fstat(file.get(), &status) != 0 || !S_ISREG(status.st_mode)) return std::nullopt;
  std::string content;
  char part[65536];
  while (content.size() < largest_content) {
    const ssize_t count = ::read(file.get(), part, sizeof part);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return std::nullopt;
    if (count == 0) break;
    content.append(part, static_cast<std::size_t>(count));
  }
  return content;
}

bool write_whole(int file, const std::string& content) {
  for (std::size_t written = 0; written < content.size();) {
    const ssize_t count = ::write(file, content.data() + written, content.size() - written);
    if (count < 0 && errno != EINTR) return false;
    if (count > 0) written += static_cast<std::size_t>(count);
  }
  return true;
}

// Owner, group and permissions of the old file for the new one. Only root may give a file away: for others the group
// is tried, and the permissions hold in any case.
bool take_over(int file, const struct stat& old) {
  struct stat now;
  if (::fstat(file, &now) != 0) return false;
  if (now.st_uid != old.st_uid && ::fchown(file, old.st_uid, old.st_gid) != 0) return false;
  if (now.st_uid == old.st_uid && now.st_gid != old.st_gid && ::fchown(file, old.st_uid, old.st_gid) != 0) return false;
  return ::fchmod(file, old.st_mode & 07777) == 0;
}

void sync_folder(const std::filesystem::path& folder) {
  const OpenFile open(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (open.get() >= 0) (void)::fsync(open.get());
}

}  // namespace

std::optional<FollowedFile::Look> FollowedFile::look() const {
  struct stat status;
  if (::stat(path_.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return std::nullopt;
  return Look{static_cast<std::uint64_t>(status.st_dev), static_cast<std::uint64_t>(status.st_ino),
              static_cast<std::int64_t>(status.st_size), modified_at(status), changed_at(status)};
}

bool FollowedFile::is_there() const { return look().has_value(); }

std::optional<std::string> FollowedFile::changed() {
  const std::optional<Look> now = look();
  if (!now || (last_ && *now == *last_ && !is_fresh(now->modified))) return std::nullopt;
  std::optional<std::string> content = content_of(path_);
  if (!content) return std::nullopt;
  last_ = now;
  if (content == content_) return std::nullopt;
  content_ = content;
  return content;
}

FollowedFile::Outcome FollowedFile::replace(const std::string& expected, const std::string& content) const {
  const auto failed = [](const std::string& path) {
    return Outcome{Written::failed, path + ": " + std::strerror(errno)};
  };
  const std::unique_ptr<char, decltype(&std::free)> real(::realpath(path_.c_str(), nullptr), &std::free);
  struct stat old;
  if (!real || ::stat(real.get(), &old) != 0) return failed(path_);
  if (::access(real.get(), W_OK) != 0) return failed(path_);
  const std::filesystem::path place = real.get();
  const std::string fresh =
      (place.parent_path() / ("." + place.filename().string() + ".lqgen-watch-" + std::to_string(::getpid()))).string();
  OpenFile file(::open(fresh.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0600));
  if (file.get() < 0) return failed(fresh);
  const bool is_ready = write_whole(file.get(), content) && take_over(file.get(), old) &&
                        (::fsync(file.get()) == 0 || errno == EINVAL) && file.close() == 0;
  const bool is_as_expected = is_ready && content_of(place.string()) == expected;
  const bool is_placed = is_as_expected && ::rename(fresh.c_str(), place.c_str()) == 0;
  if (!is_placed) {
    const Outcome outcome = is_ready && !is_as_expected ? Outcome{Written::changed_meanwhile} : failed(fresh);
    (void)::unlink(fresh.c_str());
    return outcome;
  }
  sync_folder(place.parent_path());
  return {};
}

}  // namespace lqg::serve
