// SPDX-License-Identifier: MIT
#include "serve/connection.hpp"

#include <array>
#include <boost/asio/buffer.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http.hpp>
#include <optional>

namespace lqg::serve {

namespace {

namespace beast = boost::beast;
namespace http = beast::http;
using tcp = boost::asio::ip::tcp;

constexpr int most_connections = 64;
constexpr std::uint32_t largest_head = 16 * 1024;   // bytes
constexpr std::uint64_t largest_body = 256 * 1024;  // bytes: every number of a design of 100 states
constexpr std::chrono::seconds patience(30);
constexpr std::chrono::seconds farewell(2);

std::string text_of(beast::string_view text) { return {text.data(), text.size()}; }

std::string quoted(const std::string& text) { return "{\"error\": \"" + text + "\"}\n"; }

class Connection : public std::enable_shared_from_this<Connection> {
 public:
  Connection(tcp::socket socket, Service& service) : stream_(std::move(socket)), service_(service) {
    ++service_.connections;
  }
  ~Connection() { --service_.connections; }
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  void read_head() {
    parser_.emplace();
    parser_->header_limit(largest_head);
    parser_->body_limit(largest_body);
    stream_.expires_after(patience);
    http::async_read_header(
        stream_, buffer_, *parser_,
        [self = shared_from_this()](beast::error_code error, std::size_t) { self->on_head(error); });
  }

 private:
  void on_head(beast::error_code error) {
    if (error) return on_bad(error);
    const auto& head = parser_->get();
    asked_ = {};
    asked_.method = text_of(head.method_string());
    asked_.target = text_of(head.target());
    asked_.host = text_of(head[http::field::host]);
    asked_.origin = text_of(head[http::field::origin]);
    asked_.content_type = text_of(head[http::field::content_type]);
    asked_.site = text_of(head["Sec-Fetch-Site"]);
    asked_.hosts = head.count(http::field::host);
    if (const auto refusal = refuse(asked_, service_.door))
      return write({refusal->status, "application/json", quoted(refusal->why)}, true);
    http::async_read(stream_, buffer_, *parser_,
                     [self = shared_from_this()](beast::error_code failed, std::size_t) { self->on_request(failed); });
  }

  void on_request(beast::error_code error) {
    if (error) return on_bad(error);
    stream_.expires_never();  // an answer may wait
    const bool closes = !parser_->get().keep_alive();
    service_.handler({asked_.method, path_of(asked_), query_of(asked_), parser_->get().body()},
                     [self = shared_from_this(), closes](Reply reply) { self->write(std::move(reply), closes); });
  }

  void on_bad(beast::error_code error) {
    if (error == http::error::body_limit) return write({413, "application/json", quoted("too large")}, true);
    if (error == http::error::header_limit) return write({431, "application/json", quoted("too large")}, true);
    const bool is_over = error == http::error::end_of_stream || error == beast::error::timeout ||
                         error.category() == boost::system::system_category();
    if (!is_over) write({400, "application/json", quoted("not HTTP")}, true);
  }

  void write(Reply reply, bool closes) {
    response_ = {static_cast<http::status>(reply.status), 11, std::move(reply.body)};
    response_.set(http::field::content_type, reply.type);
    response_.set(http::field::cache_control, "no-store");
    response_.set("Content-Security-Policy",
                  reply.policy.empty() ? "default-src 'none'; frame-ancestors 'none'" : reply.policy);
    response_.set("X-Frame-Options", "DENY");
    response_.set("X-Content-Type-Options", "nosniff");
    response_.set("Referrer-Policy", "no-referrer");
    response_.set("Cross-Origin-Opener-Policy", "same-origin");
    response_.set("Cross-Origin-Resource-Policy", "same-origin");
    if (reply.status == 405) response_.set(http::field::allow, "GET, POST");
    response_.keep_alive(!closes);
    response_.prepare_payload();
    stream_.expires_after(patience);
    http::async_write(stream_, response_, [self = shared_from_this(), closes](beast::error_code error, std::size_t) {
      if (error) return;
      if (closes)
        self->say_farewell();
      else
        self->read_head();
    });
  }

  // What the other side still sends is read for a while: closing at once could take the answer away from it.
  void say_farewell() {
    beast::error_code ignored;
    stream_.socket().shutdown(tcp::socket::shutdown_send, ignored);
    stream_.expires_after(farewell);
    drain();
  }

  void drain() {
    stream_.async_read_some(boost::asio::buffer(rest_),
                            [self = shared_from_this()](beast::error_code error, std::size_t) {
                              if (!error) self->drain();
                            });
  }

  beast::tcp_stream stream_;
  Service& service_;
  beast::flat_buffer buffer_;
  std::optional<http::request_parser<http::string_body>> parser_;
  http::response<http::string_body> response_;
  Asked asked_;
  std::array<char, 4096> rest_ = {};
};

}  // namespace

void open_connection(tcp::socket socket, Service& service) {
  if (service.connections >= most_connections) return;
  std::make_shared<Connection>(std::move(socket), service)->read_head();
}

}  // namespace lqg::serve
