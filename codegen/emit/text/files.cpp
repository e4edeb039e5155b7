// SPDX-License-Identifier: MIT
#include "emit/text/files.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <map>

#include "emit/text/folder.hpp"

namespace lqg::emit {

namespace {

namespace fs = std::filesystem;

std::string because(const fs::path& path, int error) { return path.string() + ": " + std::strerror(error); }

// What a temporary file is: the new first file, another new one, an old one that comes back if the new ones do not
// come. As long as there is a first one, the old set is the one that counts.
const std::string first = "first", fresh = "new", old = "old", mark = ".lqgen-";

// ".two_mass.h.lqgen-new-4711"
std::string temporary(const std::string& name, const std::string& role) {
  return "." + name + mark + role + "-" + std::to_string(::getpid());
}

struct Temporary {
  std::string name, role;  // of the file that it stands for
  std::string process;
};

std::optional<Temporary> parse_temporary(const std::string& name) {
  const std::size_t at = name.rfind(mark), dash = name.rfind('-');
  if (name[0] != '.' || at == name.npos || at < 2 || dash < at + mark.size()) return std::nullopt;
  const std::size_t behind = at + mark.size();
  const Temporary found = {name.substr(1, at - 1), name.substr(behind, dash - behind), name.substr(dash + 1)};
  const bool has_role = found.role == first || found.role == fresh || found.role == old;
  const bool has_number = !found.process.empty() && found.process.find_first_not_of("0123456789") == found.process.npos;
  return has_role && has_number ? std::optional(found) : std::nullopt;
}

// What one process that was killed has left.
class Leftovers {
 public:
  void add(const std::string& entry, const Temporary& what) {
    Entries& entries = what.role == first ? first_ : what.role == fresh ? fresh_ : old_;
    entries[entry] = what.name;
  }

  void settle(const Folder& folder) const {
    if (first_.empty()) {
      put(fresh_, folder);
      remove(old_, folder);
    } else {
      put(old_, folder);
      remove(fresh_, folder);
      remove(first_, folder);
    }
  }

 private:
  using Entries = std::map<std::string, std::string>;  // the temporary file, and the one for which it stands

  // A rename between two names of one file does nothing.
  static void put(const Entries& entries, const Folder& folder) {
    for (const auto& [entry, place] : entries) folder.rename(entry, place);
    remove(entries, folder);
  }
  static void remove(const Entries& entries, const Folder& folder) {
    for (const auto& [entry, place] : entries) folder.remove(entry);
  }

  Entries first_, fresh_, old_;
};

// Only what this user has written comes back; what others have put there is removed, where that is allowed.
void clean_up(const Folder& folder) {
  std::map<std::string, Leftovers> processes;
  std::error_code error;
  for (fs::directory_iterator entry(folder.path(), error), end; !error && entry != end; entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    const std::optional<Temporary> found = parse_temporary(name);
    if (!found) continue;
    if (folder.kind_of(name) == Folder::Kind::own)
      processes[found->process].add(name, *found);
    else
      folder.remove(name);
  }
  for (const auto& [process, leftovers] : processes) leftovers.settle(folder);
}

// The files of one call, on their way to their places. The new first file is there before all others, and takes its
// place when the last old file has gone and before the first new one comes.
class Transaction {
 public:
  Transaction(const Folder& folder, const std::vector<File>& files) : folder_(folder), files_(files) {
    for (const File& file : files)
      steps_.push_back({file.name, temporary(file.name, steps_.empty() ? first : fresh), temporary(file.name, old)});
  }

  std::optional<std::string> run() {
    if (const auto failure = stage()) return undone(*failure);
    for (std::size_t i = steps_.size(); i-- > 0;)
      if (const int error = put_aside(steps_[i], i == 0)) return undone(because(place(i), error));
    for (std::size_t i = 0; i < steps_.size(); ++i) {
      if (const int error = folder_.rename(steps_[i].fresh, steps_[i].name)) return undone(because(place(i), error));
      steps_[i].is_placed = true;
    }
    folder_.sync();
    for (const Step& step : steps_)
      if (step.has_old) folder_.remove(step.old);
    return std::nullopt;
  }

 private:
  struct Step {
    std::string name, fresh, old;  // in its place, and the temporary ones
    bool is_created = false, has_old = false, is_placed = false;
  };

  fs::path place(std::size_t i) const { return fs::path(folder_.path()) / steps_[i].name; }

  std::optional<std::string> stage() {
    for (std::size_t i = 0; i < steps_.size(); ++i) {
      if (folder_.kind_of(steps_[i].name) == Folder::Kind::folder) return because(place(i), EISDIR);
      const int error = folder_.create(steps_[i].fresh, files_[i].content);
      steps_[i].is_created = error != EEXIST;
      if (error) return because(error == EEXIST ? fs::path(folder_.path()) / steps_[i].fresh : place(i), error);
    }
    if (const int error = folder_.sync()) return because(folder_.path(), error);
    return std::nullopt;
  }

  // The first file keeps its place beside its second name.
  int put_aside(Step& step, bool is_first) {
    if (folder_.kind_of(step.name) == Folder::Kind::nothing) return 0;
    int error = is_first ? folder_.link(step.name, step.old) : folder_.rename(step.name, step.old);
    const bool has_no_links = is_first && error != 0 && error != EEXIST;
    if (has_no_links) error = folder_.rename(step.name, step.old);
    step.has_old = error == 0;
    return error;
  }

  // All steps backwards, so that whoever is killed among them leaves what clean_up understands.
  std::string undone(const std::string& why) {
    for (std::size_t i = steps_.size(); i-- > 0;)
      if (steps_[i].is_placed) folder_.rename(steps_[i].name, steps_[i].fresh);
    for (const Step& step : steps_)
      if (step.has_old) {
        folder_.rename(step.old, step.name);
        folder_.remove(step.old);  // two names of one file
      }
    for (std::size_t i = steps_.size(); i-- > 0;)
      if (steps_[i].is_created) folder_.remove(steps_[i].fresh);
    return why;
  }

  const Folder& folder_;
  const std::vector<File>& files_;
  std::vector<Step> steps_;
};

}  // namespace

std::optional<std::string> write_all(const std::string& path, const std::vector<File>& files,
                                     std::chrono::milliseconds patience) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error) return because(path, error.value());
  Folder folder(path);
  const int opened = folder.open_and_lock(patience);
  if (opened == Folder::busy)
    return path + ": another program keeps this folder locked: wait for its end, or write elsewhere";
  if (opened != 0) return because(path, opened);
  if (folder.is_locked()) clean_up(folder);
  return Transaction(folder, files).run();
}

}  // namespace lqg::emit
