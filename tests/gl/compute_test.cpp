// Compute shaders on the CPU and on llvmpipe: the same storage buffers, bit for bit.
#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <random>

#include "cpu_shaders/load/load.h"
#include "cpu_shaders/load/run_compute.h"
#include "raster/gl/gl_renderer.h"
#include "raster/tiled/bind.h"
#include "tests/gl/test_shaders.h"

using namespace twinshade;

namespace {

using Words = std::vector<std::uint32_t>;
using Groups = std::array<std::uint32_t, 3>;

Buffer storage(const std::string& name, const Words& words) {
  Buffer buffer{name, true, std::vector<std::byte>(words.size() * 4)};
  std::memcpy(buffer.bytes.data(), words.data(), buffer.bytes.size());
  return buffer;
}
Words words_of(const std::vector<std::byte>& bytes) {
  Words words(bytes.size() / 4);
  std::memcpy(words.data(), bytes.data(), bytes.size());
  return words;
}

ShaderSource compute_shader(const std::string& text) { return resolve_shader("test", text, "test.comp"); }

// Contents of the first storage buffer afterwards.
Words on_cpu(const Bundle& bundle, const ShaderSource& source, Number number, const Groups& groups) {
  const ShaderModule& module = load_module(source, number);
  const tiled::BoundDraw draw = tiled::bind(bundle, module, AttributeMode::exact);
  run_compute(module, number, draw.data(), groups);
  for (std::size_t slot = 0; slot < draw.buffer_names.size(); ++slot)
    if (draw.buffer_names[slot] == bundle.buffers[0].name) return words_of(draw.buffer_bytes[slot]);
  FAIL("no buffer ", bundle.buffers[0].name);
  return {};
}
Words on_gl(const Bundle& bundle, const ShaderSource& source, const Groups& groups) {
  return words_of(dispatch_on_gl(GlBackend::egl, bundle, source, groups).at(0).bytes);
}

std::string first_difference(const Words& a, const Words& b) {
  if (a.size() != b.size()) return "sizes";
  for (std::size_t k = 0; k < a.size(); ++k)
    if (a[k] != b[k]) return "word " + std::to_string(k) + ": " + std::to_string(a[k]) + ", " + std::to_string(b[k]);
  return "";
}

}  // namespace

TEST_CASE("a work group adds up in shared memory between barriers, as llvmpipe does") {
  // 21 x 3 invocations: blocks of lanes that are not full, and a loop whose barrier all of them reach.
  const ShaderSource source = compute_shader(R"(#version 450
layout(local_size_x = 21, local_size_y = 3) in;
layout(std430) buffer Data { uint data[]; };
struct Item { mat2 m; bool odd; uint list[2]; };
shared Item items[63];
shared uint highest;
uniform uint factor = 3u;
void main() {
  uint i = gl_LocalInvocationIndex;
  uint group = gl_WorkGroupID.x + gl_NumWorkGroups.x * (gl_WorkGroupID.y + gl_NumWorkGroups.y * gl_WorkGroupID.z);
  uvec3 at = gl_GlobalInvocationID;
  if (i == 0u) highest = 0u;
  items[i].m = mat2(float(i), 1.0, 2.0, float(at.y));
  items[i].odd = (i & 1u) == 1u;
  items[i].list[i & 1u] = data[group * 63u + i];
  items[i].list[1u - (i & 1u)] = gl_LocalInvocationID.x + 100u * gl_LocalInvocationID.y;
  barrier();
  for (uint step = 32u; step > 0u; step >>= 1) {
    uint other = 0u;
    if (i + step < 63u) other = items[i + step].list[items[i + step].odd ? 1 : 0];
    barrier();
    items[i].list[i & 1u] += other * factor;
    memoryBarrierShared();
    barrier();
  }
  atomicMax(highest, items[62u - i].list[0]);
  barrier();
  data[group * 63u + i] = items[i].list[i & 1u] ^ highest ^ uint(items[62u - i].m[1].y + items[i].m[0].x) ^ at.x << 8 ^ at.z << 20;
}
)");
  Bundle bundle;
  std::mt19937 random(7);
  Words data(63 * 12);
  for (std::uint32_t& word : data) word = static_cast<std::uint32_t>(random());
  bundle.buffers = {storage("Data", data)};
  const Groups groups = {2, 3, 2};
  const Words expected = on_gl(bundle, source, groups);
  CHECK(expected != data);
  for (const Number number : {Number::scalar, Number::lanes4})
    CHECK_MESSAGE(first_difference(on_cpu(bundle, source, number, groups), expected) == "", int(number));
}

TEST_CASE("columns of row-major matrices in a buffer are stored whole, whatever expression they are given") {
  const ShaderSource source = compute_shader(R"(#version 450
layout(local_size_x = 16) in;
layout(std430, row_major) buffer Data { mat2 a[16]; mat4x2 b[16]; mat3 c[16]; };
void main() {
  uint i = gl_GlobalInvocationID.x;
  a[i][1] = a[i][0] * a[i][1].yx;
  b[i][2] = -b[i][3];
  if (i > 4u) b[i][1] = b[i][0] + b[i][1];
  c[i][1] = c[i][0] * c[i][2].x;
  c[i][i % 3u] = cross(c[i][0], c[i][1]);
}
)");
  Bundle bundle;
  Words data(16 * (4 + 8 + 12));
  for (std::size_t k = 0; k < data.size(); ++k) data[k] = std::bit_cast<std::uint32_t>(float(k % 7));
  bundle.buffers = {storage("Data", data)};
  const Groups groups = {1, 1, 1};
  const Words expected = on_gl(bundle, source, groups);
  CHECK(expected != data);
  for (const Number number : {Number::scalar, Number::lanes4})
    CHECK_MESSAGE(first_difference(on_cpu(bundle, source, number, groups), expected) == "", int(number));
}

TEST_CASE("a matrix in a buffer is stored at the index that was there before, though the index is in the matrix") {
  const ShaderSource source = compute_shader(R"(#version 450
layout(local_size_x = 16) in;
layout(std430) buffer Data { mat2 a[16]; layout(row_major) mat3 b[16]; };
void main() {
  uint i = gl_GlobalInvocationID.x;
  a[i] = mat2(i);
  a[int(a[i][0].x)] = mat2(40, 50, 60, 70);
  b[i] = mat3(i);
  b[int(b[i][0].x)] = mat3(1, 2, 3, 4, 5, 6, 7, 8, 9);
  b[i][int(b[i][0].x)] = vec3(20, 21, 22);
}
)");
  Bundle bundle;
  bundle.buffers = {storage("Data", Words(16 * (4 + 12)))};
  const Groups groups = {1, 1, 1};
  const Words expected = on_gl(bundle, source, groups);
  for (const Number number : {Number::scalar, Number::lanes4})
    CHECK_MESSAGE(first_difference(on_cpu(bundle, source, number, groups), expected) == "", int(number));
}

TEST_CASE("what modf overwrites in memory has been read by what stands before it, as a variable has") {
  const ShaderSource source = compute_shader(R"(#version 450
layout(local_size_x = 4) in;
layout(std430) buffer Data { float data[]; };
shared float kept[4];
void main() {
  uint i = gl_LocalInvocationIndex;
  float variable = data[i];
  kept[i] = data[i];
  data[i + 4u] = variable + modf(2.25, variable);
  data[i + 8u] = kept[i] + modf(2.25, kept[i]);
  data[i + 12u] = data[i] + modf(2.25, data[i]);
}
)");
  Bundle bundle;
  bundle.buffers = {storage("Data", Words(16, std::bit_cast<std::uint32_t>(5.0f)))};
  Words expected(16, std::bit_cast<std::uint32_t>(5.25f));
  std::fill_n(expected.begin(), 4, std::bit_cast<std::uint32_t>(2.0f));
  for (const Number number : {Number::scalar, Number::lanes4})
    CHECK_MESSAGE(first_difference(on_cpu(bundle, source, number, {1, 1, 1}), expected) == "", int(number));
}

TEST_CASE("denormals stay in compute shaders") {
  const ShaderSource source = compute_shader(R"(#version 310 es
layout(local_size_x = 4) in;
layout(std430, binding = 0) buffer Data { highp float data[]; };
void main() { highp uint i = gl_GlobalInvocationID.x; data[i] = data[i] * 0.5; }
)");
  Bundle bundle;
  const Words data = {0x00800000, 0x00000004, 0x80000006, 0x007fffff};
  bundle.buffers = {storage("Data", data)};
  const Words expected = {0x00400000, 0x00000002, 0x80000003, 0x00400000};
  CHECK(on_cpu(bundle, source, Number::scalar, {1, 1, 1}) == expected);
  CHECK(on_gl(bundle, source, {1, 1, 1}) == expected);
}

TEST_CASE("a fragment shader is no compute shader, and a driver's message has the author's line") {
  const ShaderModule& fragment =
      load_module(test::shader("#version 450\nout vec4 c; void main() { c = vec4(1); }\n"), Number::scalar);
  CHECK(test::error_of([&] {
          run_compute(fragment, Number::scalar, ShaderData{}, {1, 1, 1});
        }) == "shader test is no compute shader");
  const ShaderSource wrong = compute_shader("#version 450\nlayout(local_size_x = 1) in;\nvoid main() { nothing(); }\n");
  CHECK(test::error_of([&] {
          (void)dispatch_on_gl(GlBackend::egl, Bundle(), wrong, {1, 1, 1});
        }).rfind("test.comp:3", 0) == 0);
}
