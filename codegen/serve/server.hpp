// SPDX-License-Identifier: MIT
// An HTTP/1.1 server on the loopback interface, by Boost.Beast, for one person. All of it runs in the thread that calls
// run(): requests, timers, and what other threads post.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>

namespace lqg::serve {

struct Request {
  std::string method;  // GET or POST
  std::string path;    // "/state", without the token
  std::string query;   // "since=1"
  std::string body;
};

struct Reply {
  int status = 200;
  std::string type = "application/json";
  std::string body;
  std::string policy = {};  // Content-Security-Policy; empty: nothing is allowed
};

// To be called once, in the thread of run(), at once or later.
using Answer = std::function<void(Reply)>;
using Handler = std::function<void(const Request&, Answer)>;

class Server {
 public:
  // Listens on 127.0.0.1 at `port`, 0: a free one. Throws std::runtime_error with the reason where it cannot.
  Server(unsigned port, const std::string& token, Handler handler);
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  unsigned port() const;

  // "http://127.0.0.1:PORT/TOKEN/"
  std::string address() const;

  // From any thread: `work` is done in the thread of run().
  void post(std::function<void()> work);

  // After `time`; every() again and again.
  void after(std::chrono::milliseconds time, std::function<void()> work);
  void every(std::chrono::milliseconds time, const std::function<void()>& work);

  // Serves until SIGINT, SIGTERM or SIGHUP comes; then the port is closed.
  void run();

 private:
  struct Inside;
  std::unique_ptr<Inside> inside_;
};

}  // namespace lqg::serve
