// SPDX-License-Identifier: MIT
// What the live page and lqgen say to each other. All of it happens in the server's thread.
//
//   GET  /              the page
//   GET  /state?since=N  the state of the file, at once if it is newer than revision N, else as soon as it is, or after
//                       20 s: {revision, path, lines, line, has_error, has_page, tunables, others, page}; others:
//                       names of the design files beside it
//   POST /look, /solve  {revision, changes: [{key, value}]}: the design with these numbers, at a first look or whole:
//                       {lines, line, has_error, has_page, milliseconds, page}; {superseded: true} where a newer
//                       question came first
//   POST /write         the same: puts the numbers into the file
//   POST /other         {name}: the whole design of one of the others, answered as /solve is
//
// `page` is that of emit::page_json, or null; where a state has none (has_page) it is the last one. 400: a question
// that nobody asked for, a key that is no number of the file, or a name that is none of the others; 409: the file has
// changed since that revision. Both with {error}.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "serve/followed_file.hpp"
#include "serve/server.hpp"
#include "view/worker.hpp"

namespace lqg::view {

class Session {
 public:
  // `path`: of the design file. Follows it from start() on; all three outlive the session's last answer.
  Session(std::string path, Worker& worker);

  void start(serve::Server& server);
  void answer(const serve::Request& request, const serve::Answer& answer);

 private:
  void follow();
  void load(const std::string& text);
  void take(Picture picture);
  void set_gone();
  void publish();
  void send_state(const serve::Request& request, const serve::Answer& answer);
  void try_numbers(const serve::Request& request, const serve::Answer& answer);
  void write_numbers(const std::string& text, const serve::Answer& answer);
  void draw_other(const serve::Request& request, const serve::Answer& answer);
  void try_design(const std::string& text, const std::string& path, Depth depth, const serve::Answer& answer);
  std::string state() const;

  std::string path_;
  Worker& worker_;
  serve::Server* server_ = nullptr;
  serve::FollowedFile file_;
  std::string text_;       // of the file, as it was last seen
  bool is_shown_ = false;  // the newest revision is that of the text
  int misses_ = 0;         // how often in a row it was not there
  Picture picture_;
  std::optional<emit::PageData> last_good_;
  long revision_ = 0;
  std::map<long, serve::Answer> waiting_;  // for a newer revision, by a number of their own
  long asked_ = 0;
};

}  // namespace lqg::view
