// SPDX-License-Identifier: MIT
#include "design/number_memory.hpp"

#include <mpfr.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <utility>

namespace lqg::design {

namespace {

constexpr std::size_t step = 16, kinds = 32;  // pieces of 16, 32, … 512 bytes; what is longer is malloc's

struct Piece {
  Piece* next;
};

thread_local std::array<Piece*, kinds> store = {};

std::size_t kind_of(std::size_t size) { return size == 0 ? 0 : (size - 1) / step; }

// GMP has no way on without memory, and ends the program, too.
void* checked(void* memory) {
  if (!memory) std::abort();
  return memory;
}

void* take(std::size_t size) {
  const std::size_t kind = kind_of(size);
  if (kind >= kinds) return checked(std::malloc(size));
  Piece* const piece = store[kind];
  if (!piece) return checked(std::malloc((kind + 1) * step));
  store[kind] = piece->next;
  return piece;
}

void give_back(void* memory, std::size_t size) {
  const std::size_t kind = kind_of(size);
  if (kind >= kinds) return std::free(memory);
  Piece* const piece = static_cast<Piece*>(memory);
  piece->next = store[kind];
  store[kind] = piece;
}

void* resize(void* memory, std::size_t old_size, std::size_t size) {
  const std::size_t before = kind_of(old_size), kind = kind_of(size);
  if (before >= kinds && kind >= kinds) return checked(std::realloc(memory, size));
  if (before == kind) return memory;
  void* const moved = take(size);
  std::memcpy(moved, memory, std::min(old_size, size));
  give_back(memory, old_size);
  return moved;
}

}  // namespace

void use_number_stores() { mp_set_memory_functions(take, resize, give_back); }

void empty_number_store() {
  for (Piece*& first : store)
    while (first) std::free(std::exchange(first, first->next));
}

}  // namespace lqg::design
