// SPDX-License-Identifier: MIT
#include "design/number_memory.hpp"

#include <gmp.h>

#include <cstdlib>
#include <new>

namespace lqg::design {

namespace {

constexpr std::size_t step = 16, kinds = 32;  // pieces of 16, 32, … 512 bytes; longer ones are malloc's

union Piece {
  Piece* next;
};

thread_local Piece* store[kinds];

std::size_t kind_of(std::size_t size) { return size == 0 ? 0 : (size - 1) / step; }

void* checked(void* memory) {
  if (!memory) std::abort();
  return memory;
}

void* take(std::size_t size) {
  const std::size_t kind = kind_of(size);
  if (kind >= kinds) return checked(std::malloc(size));
  if (Piece* piece = store[kind]) {
    store[kind] = piece->next;
    return piece;
  }
  return checked(std::malloc((kind + 1) * step));
}

void give_back(void* memory, std::size_t size) {
  const std::size_t kind = kind_of(size);
  if (kind >= kinds) return std::free(memory);
  Piece* const piece = static_cast<Piece*>(memory);
  piece->next = store[kind];
  store[kind] = piece;
}

void* resize(void* memory, std::size_t old_size, std::size_t size) {
  if (kind_of(old_size) < kinds && kind_of(old_size) == kind_of(size)) return memory;
  if (kind_of(old_size) >= kinds && kind_of(size) >= kinds) return checked(std::realloc(memory, size));
  void* const moved = take(size);
  __builtin_memcpy(moved, memory, old_size < size ? old_size : size);
  give_back(memory, old_size);
  return moved;
}

}  // namespace

void use_number_stores() { mp_set_memory_functions(take, resize, give_back); }

}  // namespace lqg::design
