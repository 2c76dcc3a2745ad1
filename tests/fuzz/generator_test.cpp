// Generated programs are what they promise to be, and the interpreter knows what they mean.
#include <doctest/doctest.h>

#include <bit>
#include <set>

#include "base/hash.h"
#include "cpu_shaders/lint/lint.h"
#include "cpu_shaders/translate/compile_glsl.h"
#include "cpu_shaders/translate/translate.h"
#include "tests/fuzz/program_generator.h"
#include "tests/fuzz/spirv_interpreter.h"

using namespace twinshade;
using fuzz::Interpreter;
using fuzz::Words;

namespace {

std::vector<std::uint32_t> spirv(const std::string& text) {
  return compile_glsl(resolve_shader("program", text, "program.frag"));
}

std::uint32_t bits(float x) { return std::bit_cast<std::uint32_t>(x); }

}  // namespace

TEST_CASE("the same seed gives the same program on every machine") {
  std::string all;
  for (std::uint64_t seed = 1; seed <= 50; ++seed) all += fuzz::generate_program(seed).text;
  CHECK(sha256_hex(all) == "56209627979760a809fc63344a8266c65401598e37e4f30ecd17adb0c1e99099");
}

TEST_CASE("generated programs are translated, stay in the exact dialect and end") {
  std::set<std::string> texts;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    CAPTURE(seed);
    const fuzz::GeneratedProgram program = fuzz::generate_program(seed);
    texts.insert(program.text);
    const ShaderSource source = resolve_shader("program", program.text, "program.frag");
    // Divisors and components chosen while running are in range by construction, which the lint cannot see. Arithmetic
    // within arms of ?: is a matter of graphics cards alone, and here the point: lanes take both arms.
    for (const LintFinding& finding : lint(source))
      CHECK_MESSAGE((finding.rule == "division" || finding.rule == "vector-store" || finding.rule == "arm"),
                    describe(finding));
    CHECK_NOTHROW(translate(source));
    Interpreter interpreter(compile_glsl(source));
    std::map<std::string, Words> values;
    for (const auto* list : {&program.inputs, &program.uniforms})
      for (const fuzz::Interface& v : *list) values[v.name] = fuzz::interface_value(seed, v, 0);
    CHECK(interpreter.run(values).steps < 1'000'000);
  }
  CHECK(texts.size() == 200);
}

TEST_CASE("the interpreter runs control flow, functions with out and inout, structs and arrays") {
  Interpreter interpreter(spirv(R"(#version 450
struct Pair { int count; vec2 list[2]; };
flat in int n;
out ivec4 answer;
out vec2 second;
int add(inout Pair p, out int twice, int by) {
  p.count += by;
  p.list[by & 1].y = float(by) * 0.5;
  twice = 2 * by;
  return p.count * 10;
}
void main() {
  Pair p = Pair(1, vec2[2](vec2(1.0), vec2(2.0)));
  int sum = 0, twice = 0;
  for (int i = 0; i < 10; ++i) {
    if (i == 2) continue;
    if (i == n) break;
    switch (i) { case 0: sum += 100; case 1: sum += 1000; break; default: sum += i; }
  }
  int result = add(p, twice, n);
  if (n == 7) discard;
  answer = ivec4(sum, twice, result, p.count);
  second = p.list[1];
})"));
  const fuzz::Invocation five = interpreter.run({{"n", {5}}});
  CHECK(five.outputs.at("answer") == Words{100 + 1000 + 1000 + 3 + 4, 10, 60, 6});
  CHECK(five.outputs.at("second") == Words{bits(2.0f), bits(2.5f)});
  CHECK(interpreter.run({{"n", {7}}}).discarded);
  CHECK_THROWS_AS(interpreter.run({{"n", {5}}}, 20), fuzz::CannotInterpret);
}

TEST_CASE("the interpreter defines what GLSL leaves open, and knows every operator") {
  Interpreter interpreter(spirv(R"(#version 450
flat in int i;
flat in uint u;
in float f;
out ivec4 a;
out uvec4 b;
out vec4 c;
void main() {
  a = ivec4(i / (i - i), (i << 33), bitfieldExtract(i, 1, 3), findMSB(i));
  b = uvec4(u / (u - u), u % (u - u), bitfieldReverse(u), uint(f));
  c = vec4(min(f, 2.0), clamp(f, -1.0, 1.0), step(3.0, f), any(greaterThan(ivec2(i), ivec2(0, -9))) ? floor(f) : 0.5);
})"));
  const fuzz::Invocation r =
      interpreter.run({{"i", {static_cast<std::uint32_t>(-6)}}, {"u", {6}}, {"f", {bits(3.75f)}}});
  CHECK(r.outputs.at("a") == Words{0, static_cast<std::uint32_t>(-12), static_cast<std::uint32_t>(-3), 2});
  CHECK(r.outputs.at("b") == Words{~0u, ~0u, 0x60000000u, 3});
  CHECK(r.outputs.at("c") == Words{bits(2.0f), bits(1.0f), bits(1.0f), bits(3.0f)});
}
