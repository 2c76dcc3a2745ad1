// Every built-in function over swept arguments, by one compute shader per section, on the CPU and on llvmpipe, against
// the table's truth. docs/built-ins.md is what comes of it: TWINSHADE_UPDATE_DOCS=1 rewrites it, else it must be
// current.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <random>

#include "base/error.h"
#include "base/file.h"
#include "cpu_shaders/load/load.h"
#include "cpu_shaders/load/run_compute.h"
#include "raster/gl/gl_renderer.h"
#include "raster/tiled/bind.h"
#include "tests/built_ins/built_in_table.h"

using namespace twinshade;
using namespace twinshade::test;

namespace {

constexpr std::uint32_t kRows = 4096;
using Words = std::vector<std::uint32_t>;

float float_of(std::uint32_t word) {
  float x;
  std::memcpy(&x, &word, 4);
  return x;
}
std::uint32_t word_of(float x) {
  std::uint32_t word;
  std::memcpy(&word, &x, 4);
  return word;
}

// Where the words of a function begin in the buffers, row-major.
struct Place {
  std::uint32_t arguments, results, argument_words, result_words;
};

std::vector<Place> places_of(const std::vector<BuiltIn>& functions) {
  std::vector<Place> places;
  Place next{0, 0, 0, 0};
  for (const BuiltIn& f : functions) {
    next.argument_words = 0;
    for (const std::string& type : f.types) next.argument_words += std::uint32_t(component_count(type));
    next.result_words = std::uint32_t(component_count(f.result));
    places.push_back(next);
    next.arguments += next.argument_words * kRows;
    next.results += next.result_words * kRows;
  }
  return places;
}

// Row i of kRows takes the i-th of as many equal parts of the range, in an order of its own for each argument.
std::uint32_t swept(const Range& range, char scalar, std::uint32_t i, std::mt19937& random) {
  const double u = (i + double(random()) / 4294967296.0) / kRows;
  if (scalar != 'f') {
    const double x = std::floor(range.low + u * (range.high - range.low + 1));
    return scalar == 'i' ? std::uint32_t(std::int32_t(std::min(x, range.high)))
                         : std::uint32_t(std::min(x, range.high));
  }
  if (!range.logarithmic) return word_of(float(range.low + u * (range.high - range.low)));
  const double sign = range.low < 0 ? (u < 0.5 ? -1 : 1) : 1;
  const double part = range.low < 0 ? std::fabs(2 * u - 1) : u;
  return word_of(float(sign * range.high * std::exp2(-60 * part)));
}

Words arguments_of(const std::vector<BuiltIn>& functions, const std::vector<Place>& places) {
  Words words;
  for (std::size_t f = 0; f < functions.size(); ++f) {
    std::mt19937 random(std::uint32_t(1000 + f));
    words.resize(places[f].arguments + places[f].argument_words * kRows);
    std::uint32_t component = 0;
    for (std::size_t a = 0; a < functions[f].types.size(); ++a)
      for (int c = 0; c < component_count(functions[f].types[a]); ++c, ++component) {
        const std::uint32_t step = component == 0 ? 1 : 2 * (random() % (kRows / 2)) + 1;  // odd: meets every part
        for (std::uint32_t i = 0; i < kRows; ++i)
          words[places[f].arguments + i * places[f].argument_words + component] =
              swept(functions[f].ranges[a], scalar_letter(functions[f].types[a]), i * step % kRows, random);
      }
  }
  return words;
}

// One function of the shader for each of the table: reads its arguments, writes its results.
std::string shader_text(const std::vector<BuiltIn>& functions, const std::vector<Place>& places) {
  std::string text =
      "#version 450\nlayout(local_size_x = 64) in;\nlayout(std430) buffer Results { uint results[]; };\n"
      "layout(std430) readonly buffer Arguments { uint arguments[]; };\n"
      "float f_at(uint at) { return uintBitsToFloat(arguments[at]); }\n"
      "int i_at(uint at) { return int(arguments[at]); }\nuint u_at(uint at) { return arguments[at]; }\n"
      "uint word(float x) { return floatBitsToUint(x); }\nuint word(int x) { return uint(x); }\n"
      "uint word(uint x) { return x; }\n";
  std::string calls;
  for (std::size_t f = 0; f < functions.size(); ++f) {
    text += fmt::format("void function{}(uint row) {{\n  uint at = {}u + row * {}u, to = {}u + row * {}u;\n", f,
                        places[f].arguments, places[f].argument_words, places[f].results, places[f].result_words);
    int component = 0;
    for (std::size_t a = 0; a < functions[f].types.size(); ++a) {
      const std::string& type = functions[f].types[a];
      text += fmt::format("  {} {} = {}(", type, char('a' + a), type);
      for (int c = 0; c < component_count(type); ++c)
        text += fmt::format("{}{}_at(at + {}u)", c == 0 ? "" : ", ", scalar_letter(type), component++);
      text += ");\n";
    }
    text += "  " + functions[f].glsl + "\n";
    const int count = component_count(functions[f].result);
    const bool matrix = functions[f].result.rfind("mat", 0) == 0;
    const int rows = matrix ? functions[f].result.back() - '0' : 1;
    for (int c = 0; c < count; ++c)
      text += fmt::format("  results[to + {}u] = word(result{});\n", c,
                          matrix      ? fmt::format("[{}][{}]", c / rows, c % rows)
                          : count > 1 ? fmt::format("[{}]", c)
                                      : "");
    text += "}\n";
    calls += fmt::format("  function{}(gl_GlobalInvocationID.x);\n", f);
  }
  return text + "void main() {\n" + calls + "}\n";
}

Bundle bundle_of(const std::vector<BuiltIn>& functions, const std::vector<Place>& places) {
  const auto storage = [](const char* name, const Words& words) {
    Buffer buffer{name, true, std::vector<std::byte>(words.size() * 4)};
    std::memcpy(buffer.bytes.data(), words.data(), buffer.bytes.size());
    return buffer;
  };
  Bundle bundle;
  const Place& last = places.back();
  bundle.buffers = {storage("Results", Words(last.results + last.result_words * kRows)),
                    storage("Arguments", arguments_of(functions, places))};
  return bundle;
}

Words words_of(const std::vector<std::byte>& bytes) {
  Words words(bytes.size() / 4);
  std::memcpy(words.data(), bytes.data(), bytes.size());
  return words;
}

Words on_cpu(const Bundle& bundle, const ShaderSource& source) {
  const ShaderModule& module = load_module(source, Number::scalar);
  const tiled::BoundDraw draw = tiled::bind(bundle, module, AttributeMode::exact);
  run_compute(module, Number::scalar, draw.data(), {kRows / 64, 1, 1});
  const bool first = draw.buffer_names[0] == "Results";
  return words_of(draw.buffer_bytes[first ? 0 : 1]);
}

// Without fused multiply-add, which would make llvmpipe's polynomials those of one processor.
Words on_llvmpipe(const Bundle& bundle, const ShaderSource& source) {
  GlEnvironment unfused;
  unfused.host_fma = false;
  return words_of(dispatch_on_gl(GlBackend::egl, bundle, source, {kRows / 64, 1, 1}, unfused).at(0).bytes);
}

struct Worst {
  double ulp = 0;                // of float results
  std::uint32_t rows_wrong = 0;  // of others
  std::uint32_t row = 0;         // where the worst is
};

double ulp_at(long double magnitude) {
  int exponent = -126;
  if (magnitude != 0) (void)std::frexp(magnitude, &exponent);
  return std::ldexp(1.0, std::max(exponent - 1, -126) - 23);
}

Worst worst_of(const BuiltIn& f, const Place& place, const Words& arguments, const Words& results) {
  Worst worst;
  for (std::uint32_t i = 0; i < kRows; ++i) {
    Arguments row;
    std::size_t at = place.arguments + i * place.argument_words;
    for (const std::string& type : f.types)
      for (int c = 0; c < component_count(type); ++c, ++at) {
        const std::uint32_t w = arguments[at];
        row.words.push_back(w);
        row.x.push_back(scalar_letter(type) == 'f'   ? static_cast<long double>(float_of(w))
                        : scalar_letter(type) == 'i' ? static_cast<long double>(static_cast<std::int32_t>(w))
                                                     : static_cast<long double>(w));
      }
    const Truth truth = f.truth(row);
    TWINSHADE_CHECK_EQ(truth.values.size(), std::size_t(place.result_words));
    bool wrong = false;
    for (std::uint32_t c = 0; c < place.result_words; ++c) {
      const std::uint32_t word = results[place.results + i * place.result_words + c];
      const long double expected = truth.values[c];
      if (scalar_letter(f.result) == 'f') {
        const double unit = ulp_at(std::max(std::fabs(expected), truth.scale));
        const double error = double(std::fabs(static_cast<long double>(float_of(word)) - expected)) / unit;
        if (!(error <= worst.ulp)) worst.ulp = std::isnan(error) ? INFINITY : error, worst.row = i;
      } else {
        wrong |= (scalar_letter(f.result) == 'i' ? static_cast<long double>(static_cast<std::int32_t>(word))
                                                 : static_cast<long double>(word)) != expected;
      }
    }
    if (wrong && worst.rows_wrong++ == 0) worst.row = i;
  }
  return worst;
}

std::string shown_arguments(const BuiltIn& f, const Place& place, const Words& arguments, std::uint32_t row) {
  std::string text;
  std::size_t at = place.arguments + row * place.argument_words;
  for (const std::string& type : f.types)
    for (int c = 0; c < component_count(type); ++c, ++at)
      text += (text.empty() ? "" : ", ") + (scalar_letter(type) == 'f' ? fmt::format("{:a}", float_of(arguments[at]))
                                                                       : fmt::format("{:#x}", arguments[at]));
  return text;
}

std::string shown(const BuiltIn& f, const Worst& worst) {
  if (scalar_letter(f.result) != 'f')
    return worst.rows_wrong == 0 ? "exact" : fmt::format("{} of {} differ", worst.rows_wrong, kRows);
  if (worst.ulp == 0) return "exact";
  return worst.ulp < 100 ? fmt::format("{:.2f}", worst.ulp) : fmt::format("{:.3g}", worst.ulp);
}

std::string shown(const Range& range) {
  return fmt::format("{:g} to {:g}{}", range.low, range.high, range.logarithmic ? " (log)" : "");
}

// One section of the page; checks ours on the way.
std::string section(const std::vector<BuiltIn>& functions) {
  const std::vector<Place> places = places_of(functions);
  const ShaderSource source = resolve_shader("built_ins", shader_text(functions, places), "built_ins.comp");
  const Bundle bundle = bundle_of(functions, places);
  const Words arguments = words_of(bundle.buffers[1].bytes);
  const Words ours = on_cpu(bundle, source), theirs = on_llvmpipe(bundle, source);
  std::string text =
      "\n## " + functions.front().section + "\n\n| function | arguments | Twinshade | llvmpipe |\n|---|---|---|---|\n";
  for (std::size_t f = 0; f < functions.size(); ++f) {
    const BuiltIn& function = functions[f];
    const Worst own = worst_of(function, places[f], arguments, ours);
    const Worst other = worst_of(function, places[f], arguments, theirs);
    CHECK_MESSAGE(own.ulp <= function.most_ulp, function.name, " is off by ", own.ulp, " ULP at ",
                  shown_arguments(function, places[f], arguments, own.row));
    CHECK_MESSAGE(own.rows_wrong == 0, function.name, " is wrong at ",
                  shown_arguments(function, places[f], arguments, own.row));
    std::string ranges;
    for (const Range& range : function.ranges) ranges += (ranges.empty() ? "" : "; ") + shown(range);
    text +=
        fmt::format("| `{}` | {} | {} | {} |\n", function.name, ranges, shown(function, own), shown(function, other));
  }
  return text;
}

const char* const kIntroduction =
    R"(# Built-in functions: how exact they are

Made by `tests/built_ins` (`TWINSHADE_UPDATE_DOCS=1 built_ins_test` rewrites it; the test compares). Each function is called in a compute shader of
4,096 invocations, translated for the CPU and run by Mesa's llvmpipe, over arguments that meet every part of the ranges named; what is true comes
from the C library in long double, GLM in double, and integer arithmetic in 64 bits.

A number is the worst error in units in the last place (ULP) of the true value: 0.5 is the nearest float. Sums count it in ULP of their greatest
term, or of the bound of their terms: below that rounding leaves nothing to measure. *exact*: every row is the true value; of integers and packed words the
table counts the rows that are not. *(log)*: magnitudes over 60 powers of two below the greatest, evenly in their logarithm. Matrices have 8 added on the diagonal before their
determinant or inverse is taken. llvmpipe runs without
fused multiply-add, so that its column is the same on every processor.

Ours are the same bits everywhere; none of these but `sqrt`, `abs`, `floor`, `ceil`, `trunc`, `min`, `max`, `clamp`, `step` and the integer functions is
in the [exact dialect](exact-dialect.md), because llvmpipe's are others'.
)";

}  // namespace

TEST_CASE("every built-in function is as exact as docs/built-ins.md says, on the CPU and on llvmpipe") {
  std::string page = kIntroduction;
  std::vector<BuiltIn> functions;
  const std::vector<BuiltIn>& all = built_in_table();
  for (std::size_t k = 0; k < all.size(); ++k) {
    functions.push_back(all[k]);
    if (k + 1 < all.size() && all[k + 1].section == all[k].section) continue;
    page += section(functions);
    functions.clear();
  }
  const std::string path = std::string(TWINSHADE_SOURCE_DIR) + "/docs/built-ins.md";
  if (const char* update = std::getenv("TWINSHADE_UPDATE_DOCS"); update != nullptr && *update == '1')
    write_file(path, page);
  CHECK_MESSAGE(read_file(path) == page, path, " is not what was measured: run with TWINSHADE_UPDATE_DOCS=1");
}
