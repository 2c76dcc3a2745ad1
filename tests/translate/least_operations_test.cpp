#include <doctest/doctest.h>

#include "cpu_shaders/translate/count_operations.h"

namespace twinshade {
namespace {

OperationCount least(const std::string& body, const std::string& declarations = "") {
  const std::string text = "#version 450\nin vec3 a;\nin float b;\nuniform float u;\nout vec3 result;\n" +
                           declarations + "\nvoid main() {\n  vec3 r = a;\n" + body + "\n  result = r;\n}\n";
  return least_operations(resolve_shader("least", text, "least.frag"));
}

const std::string kSampler = "uniform sampler2D map;\n";

}  // namespace

TEST_CASE("of branches the least of each kind counts") {
  CHECK(least("if (b > 0.0) for (int i = 0; i < 10000; ++i) r += a;").additions == 0);
  const OperationCount mixed = least(
      "if (b > 0.0) { r = texelFetch(map, ivec2(b), 0).rgb; r *= b; } else { r += a; r += b; r *= r; }", kSampler);
  CHECK(mixed.texels == 0);
  CHECK(mixed.additions == 0);
  CHECK(mixed.multiplications == 3);
  CHECK(least("r = b > 0.0 ? texelFetch(map, ivec2(b), 0).rgb : texelFetch(map, ivec2(b) + 1, 0).rgb;", kSampler)
            .texels == 1);
  CHECK(
      least("switch (int(b)) { case 0: r += a; break; case 1: r += b; break; default: r += a.x; r += b; }").additions ==
      3);
  CHECK(least("switch (int(b)) { case 0: r += a; break; case 1: r += b; break; }").additions == 0);
}

TEST_CASE("behind what some invocations leave by, nothing is sure") {
  CHECK(least("r *= a; if (b > 0.0) { result = r; return; } r += a;").total() == 3 + 1);
  CHECK(least("r *= a; if (b > 0.0) discard; r += a;").total() == 3 + 1);
  CHECK(least("f(b); r += a;", "void f(float x) { if (x > 0.5) discard; }").additions == 0);
  CHECK(least("g(b); r += a;", "void f(float x) { if (x > 0.5) discard; }\nvoid g(float x) { f(x * x); }").additions ==
        0);
  // A callee's return is the callee's
  const OperationCount called =
      least("r = f(a); r += a;", "vec3 f(vec3 x) { if (b > 0.0) { x = x * 2.0; return x / b; } return x * x; }");
  CHECK(called.additions == 3);
  CHECK(called.multiplications == 0);
}

TEST_CASE("loops count as often as they surely run") {
  const OperationCount nested =
      least("for (int i = 0; i < 1000; ++i) for (int j = 0; j < 1000; ++j) for (int k = 0; k < 1000; ++k) r += a * b;");
  CHECK(nested.additions == 3'000'000'000);  // more than an int holds
  CHECK(nested.multiplications == 3'000'000'000);
  CHECK_FALSE(nested.loops);
  const OperationCount skipping = least("for (int i = 0; i < 9; ++i) { r *= a; if (r.x > 1.0) continue; r += a; }");
  CHECK(skipping.multiplications == 27);
  CHECK(skipping.additions == 0);
  const OperationCount unknown = least("for (int i = 0; i < int(b); ++i) r += a; r *= b;");
  CHECK(unknown.additions == 0);
  CHECK(unknown.multiplications == 3);
  CHECK(unknown.loops);
  CHECK(least("do { r += a; } while (r.x < b);").additions == 3);
  // What a counter begins with is not known behind a branch or a loop that stores to it
  CHECK(least("int k = 3; if (b > 0.0) k = 0; for (; k < 5; ++k) r += a;").additions == 0);
  CHECK(least("int k = 0; while (r.x > b) { k += 4; r *= 0.5; } for (; k < 5; ++k) r += a;").additions == 0);
}

TEST_CASE("what is the same for all invocations costs none of them anything") {
  CHECK(least("float k = sqrt(u * 3.0) / (u + 1.0); r *= k;").total() == 3);
  CHECK(least("r = texelFetch(map, ivec2(u), 0).rgb;", kSampler).texels == 0);
}

TEST_CASE("texture() may read a single texel") { CHECK(least("r = texture(map, a.xy).rgb;", kSampler).texels == 1); }

TEST_CASE("built-in functions count as what they are made of") {
  const auto flops = [](const OperationCount& n) {
    return n.additions + n.multiplications + n.divisions + n.square_roots;
  };
  CHECK(flops(least("r = normalize(a);")) == 3 + 2 + 1 + 1 + 3);
  CHECK(flops(least("r *= length(a);")) == 3 + 2 + 1 + 3);
  CHECK(flops(least("r *= distance(a, vec3(b));")) == 3 + 3 + 2 + 1 + 3);
  CHECK(flops(least("r = cross(a, vec3(b, a.xy));")) == 6 + 3);
  CHECK(flops(least("r = mix(a, vec3(b), a.zyx);")) == 12);
  CHECK(flops(least("r = reflect(a, vec3(b));")) == 3 + 2 + 6 + 3);
  CHECK(flops(least("r = fma(a, a.yzx, vec3(b));")) == 6);
  CHECK(flops(least("r = smoothstep(vec3(0), a.yzx, a);")) == 3 * 7);
}

}  // namespace twinshade
