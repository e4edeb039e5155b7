// SPDX-License-Identifier: MIT
#include "view/session.hpp"

#include <chrono>
#include <cstdlib>
#include <utility>

#include "input/text.hpp"
#include "view/live_page.hpp"
#include "view/messages.hpp"
#include "view/neighbours.hpp"

namespace lqg::view {

namespace {

constexpr std::chrono::milliseconds between_looks(50);
constexpr int misses_of_a_moment = 10;  // an editor that replaces a file takes it away for less
constexpr std::chrono::seconds longest_wait(20);
const char* const has_changed = "the file has changed since: look at its new state first";

serve::Reply json(int status, std::string body) { return {status, "application/json", std::move(body), {}}; }

// N of "since=N"; 0, older than every state, for anything else.
long since(const std::string& query) {
  return query.rfind("since=", 0) == 0 ? std::strtol(query.c_str() + 6, nullptr, 10) : 0;
}

}  // namespace

Session::Session(std::string path, Worker& worker) : path_(std::move(path)), worker_(worker), file_(path_) {}

void Session::start(serve::Server& server) {
  server_ = &server;
  follow();
  server.every(between_looks, [this] { follow(); });
}

void Session::follow() {
  if (const std::optional<std::string> text = file_.changed()) {
    misses_ = 0;
    return load(*text);
  }
  if (file_.is_there()) {
    if (misses_ > misses_of_a_moment) load(text_);
    misses_ = 0;
  } else if (++misses_ == misses_of_a_moment + 1) {
    set_gone();
  }
}

void Session::load(const std::string& text) {
  text_ = text;
  is_shown_ = false;
  Worker::Job job;
  job.text = text;
  job.path = path_;
  job.done = [this](std::optional<Picture> picture, double) {
    if (picture) take(*std::move(picture));
  };
  worker_.start(std::move(job));
}

void Session::take(Picture picture) {
  if (misses_ > misses_of_a_moment) return;  // it is of a file that has gone meanwhile
  if (picture.page) last_good_ = picture.page;
  picture_ = std::move(picture);
  is_shown_ = true;
  publish();
}

void Session::set_gone() {
  picture_ = {};
  picture_.lines = {input::printable(path_) + ": cannot be read: it is not there, or no longer a file"};
  picture_.has_error = true;
  publish();
}

void Session::publish() {
  ++revision_;
  const std::map<long, serve::Answer> waiting = std::exchange(waiting_, {});
  if (waiting.empty()) return;
  const std::string message = state();
  for (const auto& [number, answer] : waiting) answer(json(200, message));
}

std::string Session::state() const {
  return state_message({revision_, path_, neighbours(path_)}, picture_, last_good_);
}

void Session::answer(const serve::Request& request, const serve::Answer& answer) {
  const bool is_get = request.method == "GET";
  const bool is_known_post = request.path == "/look" || request.path == "/solve" || request.path == "/write";
  if (is_get && request.path == "/") return answer(live_page(path_));
  if (is_get && request.path == "/state") return send_state(request, answer);
  if (!is_get && is_known_post) return try_numbers(request, answer);
  if (!is_get && request.path == "/other") return draw_other(request, answer);
  answer(json(404, error_message("there is no such page")));
}

void Session::send_state(const serve::Request& request, const serve::Answer& answer) {
  if (revision_ > since(request.query)) return answer(json(200, state()));
  const long number = ++asked_;
  waiting_[number] = answer;
  server_->after(longest_wait, [this, number] {
    const auto waits = waiting_.find(number);
    if (waits == waiting_.end()) return;
    const serve::Answer late = waits->second;
    waiting_.erase(waits);
    late(json(200, state()));
  });
}

void Session::try_numbers(const serve::Request& request, const serve::Answer& answer) {
  const std::optional<Numbers> numbers = numbers_in(request.body);
  if (!numbers) return answer(json(400, error_message("expected {revision, changes: [{key, value}]}")));
  if (numbers->revision != revision_ || !is_shown_) return answer(json(409, error_message(has_changed)));
  const auto text = input::set_numbers(text_, numbers->changes);
  if (const auto* failure = std::get_if<input::EditFailure>(&text))
    return answer(json(400, error_message(failure->key + ": " + failure->message)));
  if (request.path == "/write") return write_numbers(std::get<std::string>(text), answer);
  try_design(std::get<std::string>(text), path_, request.path == "/look" ? Depth::first_look : Depth::whole, answer);
}

void Session::draw_other(const serve::Request& request, const serve::Answer& answer) {
  const std::optional<std::string> name = name_in(request.body);
  if (!name) return answer(json(400, error_message("expected {name}")));
  const std::optional<Neighbour> other = read_neighbour(path_, *name);
  if (!other) return answer(json(400, error_message(*name + ": expected a design file beside " + path_)));
  try_design(other->text, other->path, Depth::whole, answer);
}

void Session::try_design(const std::string& text, const std::string& path, Depth depth, const serve::Answer& answer) {
  Worker::Job job;
  job.text = text;
  job.path = path;
  job.is_trial = true;
  job.like = picture_.scenarios;
  job.depth = depth;
  job.done = [answer](const std::optional<Picture>& picture, double milliseconds) {
    answer(json(200, picture ? trial_message(*picture, milliseconds) : superseded_message()));
  };
  worker_.start(std::move(job));
}

void Session::write_numbers(const std::string& text, const serve::Answer& answer) {
  const serve::FollowedFile::Outcome outcome = file_.replace(text_, text);
  switch (outcome.written) {
    case serve::FollowedFile::Written::yes: return answer(json(200, written_message()));
    case serve::FollowedFile::Written::changed_meanwhile: return answer(json(409, error_message(has_changed)));
    case serve::FollowedFile::Written::failed: return answer(json(500, error_message(outcome.why)));
  }
}

}  // namespace lqg::view
