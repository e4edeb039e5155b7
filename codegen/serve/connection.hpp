// SPDX-License-Identifier: MIT
// One connection of the server: reads a request, has it answered, and reads the next.
#pragma once

#include <boost/asio/ip/tcp.hpp>

#include "serve/rules.hpp"
#include "serve/server.hpp"

namespace lqg::serve {

// What all connections share; outlives them.
struct Service {
  Door door;
  Handler handler;
  int connections = 0;  // that are open
};

// Serves `socket` until the other side ends, is silent for 30 s, or is refused. One connection too many is closed.
void open_connection(boost::asio::ip::tcp::socket socket, Service& service);

}  // namespace lqg::serve
