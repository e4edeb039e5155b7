// SPDX-License-Identifier: MIT
#include "serve/server.hpp"

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/signal_set.hpp>
#include <boost/asio/steady_timer.hpp>
#include <csignal>
#include <stdexcept>

#include "serve/connection.hpp"

namespace lqg::serve {

namespace asio = boost::asio;
using tcp = asio::ip::tcp;

struct Server::Inside {
  Service service;  // outlives the connections, which end with the context
  asio::io_context context{1};
  tcp::acceptor acceptor{context};
  asio::signal_set signals{context, SIGINT, SIGTERM, SIGHUP};

  void listen(unsigned port) {
    const tcp::endpoint place(asio::ip::address_v4::loopback(), static_cast<unsigned short>(port));
    acceptor.open(place.protocol());
    acceptor.set_option(tcp::acceptor::reuse_address(true));
    acceptor.bind(place);
    acceptor.listen();
    service.door.port = acceptor.local_endpoint().port();
  }

  void accept() {
    acceptor.async_accept([this](boost::system::error_code error, tcp::socket socket) {
      if (error == asio::error::operation_aborted) return;
      if (!error) open_connection(std::move(socket), service);
      accept();
    });
  }

  void repeat(std::shared_ptr<asio::steady_timer> timer, std::chrono::milliseconds time, std::function<void()> work) {
    timer->expires_after(time);
    timer->async_wait([this, timer, time, work](boost::system::error_code error) {
      if (error) return;
      work();
      repeat(timer, time, work);
    });
  }
};

Server::Server(unsigned port, const std::string& token, Handler handler) : inside_(std::make_unique<Inside>()) {
  inside_->service.door.token = token;
  inside_->service.handler = std::move(handler);
  try {
    inside_->listen(port);
  } catch (const boost::system::system_error& error) {
    throw std::runtime_error("127.0.0.1:" + std::to_string(port) + ": " + error.code().message());
  }
}

Server::~Server() = default;

unsigned Server::port() const { return inside_->service.door.port; }

std::string Server::address() const {
  return "http://127.0.0.1:" + std::to_string(port()) + "/" + inside_->service.door.token + "/";
}

void Server::post(std::function<void()> work) { asio::post(inside_->context, std::move(work)); }

void Server::after(std::chrono::milliseconds time, std::function<void()> work) {
  auto timer = std::make_shared<asio::steady_timer>(inside_->context, time);
  timer->async_wait([timer, work = std::move(work)](boost::system::error_code error) {
    if (!error) work();
  });
}

void Server::every(std::chrono::milliseconds time, const std::function<void()>& work) {
  inside_->repeat(std::make_shared<asio::steady_timer>(inside_->context), time, work);
}

void Server::run() {
  inside_->signals.async_wait([this](boost::system::error_code, int) { inside_->context.stop(); });
  inside_->accept();
  inside_->context.run();
  inside_->acceptor.close();
}

}  // namespace lqg::serve
