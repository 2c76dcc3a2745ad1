// Translations in lower precision compile: whatever the translator's own tests have, and every function of real
// numbers.
#include <doctest/doctest.h>

#include "cpu_shaders/load/load_batch.h"
#include "cpu_shaders/translate/translate.h"
#include "tests/load/cache_fixture.h"

using namespace twinshade;

namespace {

const char* const kFunctions = R"(#version 450
in vec4 a; in vec4 b; uniform vec4 u; uniform sampler2D map; uniform sampler2DArray maps; uniform samplerCube cube;
layout(location = 0) out vec4 c; layout(location = 1) out ivec4 n; layout(location = 2) out vec4 m;
float late(in float x, out float y, inout float z) { y = x * 0.3; z += y; return sqrt(y); }
void main() {
  vec4 s = sin(a) + cos(u) + tan(a) + asin(a) + acos(u) + atan(a) + atan(a, u) + sinh(a) + cosh(a) + tanh(a) + asinh(a)
         + acosh(a) + atanh(a) + radians(a) + degrees(u);
  s += pow(a, b) + exp(a) + log(u) + exp2(a) + log2(a) + sqrt(a) + inversesqrt(u) + abs(a) + sign(a) + floor(a);
  s += trunc(a) + round(a) + roundEven(u) + ceil(a) + fract(a) + mod(a, u) + mod(a, 2.0) + min(a, u) + max(a, 0.1);
  s += clamp(a, 0.1, u.x) + clamp(a, b, u) + mix(a, b, u) + mix(a, u, 0.3) + mix(a, b, bvec4(true, false, a.x < b.x, u.x > 0.1));
  s += step(0.3, a) + step(a, u) + smoothstep(0.0, 1.0, a) + smoothstep(a, b, u) + fma(a, b, u) + dFdx(a) + dFdy(u) + fwidth(a);
  float whole; int e; float y; float z = 0.1;
  s.x += modf(a.x, whole) + frexp(a.y, e) + ldexp(a.z, n.x) + length(a) + distance(a, u) + dot(a, b) + whole + late(a.x, y, z);
  s.xyz += cross(a.xyz, u.xyz) + normalize(a.xyz) + faceforward(a.xyz, b.xyz, u.xyz) + reflect(a.xyz, u.xyz) + refract(a.xyz, b.xyz, 0.7);
  mat3 k = mat3(a.x, 0.1, u.x, b.x, 1.0, 2.0, a.yzw); mat4x3 w = outerProduct(a.xyz, b); mat2 q = mat2(a);
  s.xyz += inverse(k) * a.xyz * determinant(k) + (transpose(w) * b.xyz).xyz + matrixCompMult(k, k)[1] + (k * k / 3.0 - k)[2];
  s += texture(map, a.xy) + textureLod(maps, a.xyz, 0.0) + texture(cube, u.xyz) + textureProj(map, a.xyz)
     + textureOffset(map, u.xy, ivec2(1)) + texelFetch(map, ivec2(a.xy), 0) + textureGather(map, a.xy, 1);
  s.xy += unpackHalf2x16(packHalf2x16(a.xy)) + unpackSnorm2x16(packUnorm2x16(u.xy)) + vec2(textureSize(map, 0));
  s += unpackUnorm4x8(packSnorm4x8(a)) + float(isnan(a.x)) + float(any(isinf(b))) + float(a == b) + float(uint(a.w));
  float list[4] = float[4](a.x, 0.1, u.y, 3.0); vec3 table[2] = vec3[2](vec3(0.1), vec3(0.2));
  list[int(a.x)] = 0.7; s[int(b.x)] += list[int(b.y)] + table[int(a.z)].y;
  for (float t = 0.0; t < 1.0; t += 0.1) { if (t > a.x) break; s += t * a; }
  n = ivec4(lessThan(a, u)) + ivec4(a) + ivec4(notEqual(a, vec4(0.1))) + ivec4(a.x <= 0.1, u.x > 0.1, -a.x != 0.3, e);
  c = a.x > b.x ? s : gl_FragCoord * 0.1; m = vec4(-q); gl_FragDepth = s.x;
})";

}  // namespace

TEST_CASE("translations in half, in mediump and by line compile") {
  shared_cache();
  std::vector<ShaderSource> sources{resolve_shader("every_function", kFunctions, "every_function.frag")};
  std::string mobile = kFunctions;
  mobile.replace(0, mobile.find('\n'), "#version 320 es\nprecision mediump float; precision mediump sampler2DArray;");
  sources.push_back(resolve_shader("in_mediump", mobile, "in_mediump.frag"));
  sources.push_back(sources[0]);
  sources.back().precision = Precision::by_line;
  std::vector<std::string> cpp;
  for (ShaderSource& source : sources) {
    if (source.precision == Precision::full) source.precision = source.es ? Precision::mediump : Precision::half;
    cpp.push_back(translate(source).cpp);
  }
  BatchOptions options;
  options.compile.optimisation = 0;
  options.compile.numbers = 1;
  const std::vector<BatchModule> modules = load_batch(cpp, options);
  for (std::size_t i = 0; i < cpp.size(); ++i)
    CHECK_MESSAGE(modules[i].error.empty(), sources[i].name, ": ", modules[i].error);
}
