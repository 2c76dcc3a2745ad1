// Compute shaders: indices, shared memory, barriers, denormals.
#include "cpu_shaders/load/run_compute.h"

#include <doctest/doctest.h>

#include <cstring>
#include <vector>

#include "cpu_shaders/load/load.h"

using namespace twinshade;

namespace {

ShaderSource compute_shader(const std::string& text) { return resolve_shader("test", text, "test.comp"); }

// The module's one buffer afterwards.
std::vector<std::uint32_t> run(const ShaderSource& source, Number number, std::vector<std::uint32_t> words,
                               const std::array<std::uint32_t, 3>& groups) {
  const BufferView buffer{reinterpret_cast<std::byte*>(words.data()), words.size() * 4};
  run_compute(load_module(source, number), number, ShaderData{nullptr, nullptr, &buffer}, groups);
  return words;
}

}  // namespace

TEST_CASE("all invocations of a work group meet at barriers, also in a loop, and share their memory") {
  // 21 x 3 invocations fill no block of lanes; the sum of 1 .. 63 is 2016.
  const ShaderSource source = compute_shader(R"(#version 450
layout(local_size_x = 21, local_size_y = 3) in;
layout(std430) buffer Data { uint data[]; };
struct Item { mat2 m; bool odd; uint list[2]; };
shared Item items[63];
shared uint arrived;
void main() {
  uint i = gl_LocalInvocationIndex;
  uint group = gl_WorkGroupID.x + gl_NumWorkGroups.x * (gl_WorkGroupID.y + gl_NumWorkGroups.y * gl_WorkGroupID.z);
  items[i].m = mat2(float(gl_GlobalInvocationID.x), 0.0, 0.0, float(gl_GlobalInvocationID.y));
  items[i].odd = (i & 1u) == 1u;
  items[i].list[i & 1u] = data[group * 63u + i];
  atomicAdd(arrived, 1u);
  barrier();
  for (uint step = 32u; step > 0u; step >>= 1) {
    uint other = 0u;
    if (i + step < 63u) other = items[i + step].list[items[i + step].odd ? 1 : 0];
    barrier();
    items[i].list[i & 1u] += other;
    barrier();
  }
  uint sum = items[0].list[0];
  data[group * 63u + i] = i == 0u ? sum : i == 1u ? arrived : uint(items[63u - i].m[0].x + 1000.0 * items[63u - i].m[1].y);
}
)");
  const std::array<std::uint32_t, 3> groups = {2, 3, 2};
  std::vector<std::uint32_t> words(63 * 12);
  for (std::size_t k = 0; k < words.size(); ++k) words[k] = std::uint32_t(k % 63 + 1 + 100 * (k / 63));
  for (const Number number : {Number::scalar, Number::lanes4}) {
    const std::vector<std::uint32_t> after = run(source, number, words, groups);
    for (std::uint32_t k = 0; k < after.size(); ++k) {
      const std::uint32_t group = k / 63, i = k % 63, opposite = 63 - i;
      const std::uint32_t expected = i == 0 ? 2016 + 6300 * group
                                     : i == 1
                                         ? 63
                                         : group % 2 * 21 + opposite % 21 + 1000 * (group / 2 % 3 * 3 + opposite / 21);
      CHECK_MESSAGE(after[k] == expected, "invocation ", i, " of group ", group, ", number ", int(number));
    }
  }
}

TEST_CASE("invocations that meet at barriers may have as large variables as others") {
  const ShaderSource source = compute_shader(R"(#version 450
layout(local_size_x = 24) in;
layout(std430) buffer Data { uint data[]; };
shared uint first;
void main() {
  uint list[30000];
  for (uint k = 0u; k < 30000u; ++k) list[k] = k * gl_LocalInvocationIndex;
  if (gl_LocalInvocationIndex == 0u) first = data[0];
  barrier();
  data[gl_LocalInvocationIndex] = list[first];
}
)");
  for (const Number number : {Number::scalar, Number::lanes4}) {
    const std::vector<std::uint32_t> after = run(source, number, std::vector<std::uint32_t>(24, 29999), {1, 1, 1});
    for (std::uint32_t i = 0; i < after.size(); ++i) CHECK(after[i] == 29999 * i);
  }
}

TEST_CASE("denormals stay in compute shaders") {
  const ShaderSource source = compute_shader(R"(#version 310 es
layout(local_size_x = 4) in;
layout(std430, binding = 0) buffer Data { highp float data[]; };
void main() { highp uint i = gl_GlobalInvocationID.x; data[i] = data[i] * 0.5; }
)");
  CHECK(run(source, Number::scalar, {0x00800000, 0x00000004, 0x80000006, 0x007ffffe}, {1, 1, 1}) ==
        std::vector<std::uint32_t>{0x00400000, 0x00000002, 0x80000003, 0x003fffff});
}
