// Operations of the runtime as functions over arrays of words, so that number policies and instruction sets can be
// compared with each other and with oracles. Each is compiled once per instruction set from the same text.
#pragma once

#include <cstddef>
#include <cstdint>

#include "cpu_shaders/runtime/shader_abi.h"

namespace twinshade::test {

inline constexpr int kMaxResults = 16;

struct Operation {
  const char* name;
  int results;        // words per row
  bool real_results;  // float bit patterns, so that NaN compares as a class
  // a, b, c: `count` words each, read as float, int or uint as the operation wants; result r of row i goes to out[r *
  // count + i]. count: a multiple of 16.
  void (*run)(const std::uint32_t* a, const std::uint32_t* b, const std::uint32_t* c, std::uint32_t* out,
              std::size_t count);
};

struct OperationSet {  // one policy's operations
  const char* policy;  // "lanes8", "scalar", "quad"
  const Operation* operations;
  int count;
};
struct OperationSets {
  const OperationSet* sets;
  int count;
};

// Every set of one instruction set; sets of all instruction sets list the same operations in the same order.
#define TWINSHADE_TEST_SETS(group)             \
  OperationSets group##_operations_baseline(); \
  OperationSets group##_operations_avx2();     \
  OperationSets group##_operations_avx512();
TWINSHADE_TEST_SETS(arithmetic)
TWINSHADE_TEST_SETS(builtin)
TWINSHADE_TEST_SETS(vector)
TWINSHADE_TEST_SETS(memory)
#undef TWINSHADE_TEST_SETS

// What the memory operations read; deterministic.
inline constexpr int kBufferWords = 37;
const TextureView& test_texture(
    int kind);  // 0: 2D 7 x 5 clamp, 1: 2D 8 x 4 repeat, 2: 2D 7 x 5 repeat, 3: array, 4: cube, 5: 2D nearest
BufferView test_buffer();

}  // namespace twinshade::test
