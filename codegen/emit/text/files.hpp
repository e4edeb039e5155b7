// SPDX-License-Identifier: MIT
// Writing output files: all of them, or none.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

namespace lqg::emit {

struct File {
  std::string name;  // within the output folder
  std::string content;
};

// Puts `files` into `folder`, which is made if it is not there, and returns why it failed: then every old file is as it
// was.
//
// No file system replaces several files at once. It renames one at a time, and what is promised is made of that:
// - A file is never seen half written. Temporary files begin with a dot; a link in the place of one is not followed.
// - Whenever the process ends, by kill -9 too: what stands in the folder is of one run, the old set or the new one. The
//   first file is always there (where the file system has hard links), others may be missing.
// - The next call in that folder brings back what is missing, of the old set or of the new one, and removes what is
//   left over.
// - One call in a folder at a time: others wait, for `patience`, then fail. Where the file system cannot lock a folder,
//   as NFS, two calls at once may mix their files, and what is left over stays.
// - After a loss of power the same holds where the file system keeps the order of renames, as those with a journal.
std::optional<std::string> write_all(const std::string& folder, const std::vector<File>& files,
                                     std::chrono::milliseconds patience = std::chrono::seconds(30));

}  // namespace lqg::emit
