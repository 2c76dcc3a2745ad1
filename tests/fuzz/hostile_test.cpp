// Input that wants to crash, hang or fill the memory: one clear line instead.
#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>

#include "base/error.h"
#include "cpu_shaders/load/host_eval.h"
#include "cpu_shaders/load/load.h"
#include "cpu_shaders/translate/translate.h"

using namespace twinshade;

namespace {

ShaderSource shader(const std::string& text) { return resolve_shader("hostile", text, "hostile.frag"); }

ShaderSource body(const std::string& statements) {
  return shader("#version 450\nflat in int n;\nin float x;\nout vec4 color;\nvoid main() {\n" + statements +
                "\n  color = vec4(x);\n}\n");
}

std::string refusal(const ShaderSource& source) {
  try {
    translate(source);
  } catch (const UserError& error) {
    return error.what();
  }
  return "";
}

std::string repeated(const std::string& text, int times) {
  std::string all;
  for (int k = 0; k < times; ++k) all += text;
  return all;
}

}  // namespace

TEST_CASE("deep nesting is refused at its line, in brackets and in statements") {
  CHECK(refusal(body("float y = " + repeated("(", 100000) + "x" + repeated(")", 100000) + ";")) ==
        "hostile.frag:6: brackets are nested more than 200 deep");
  CHECK(refusal(body(repeated("if (x > 0.0) {\n", 250) + repeated("}", 250))) ==
        "hostile.frag:205: brackets are nested more than 200 deep");
  const std::string chain =
      refusal(body("if (n == 0) color = vec4(1.0);\n" + repeated("else if (n == 1) color = vec4(x);\n", 400)));
  CHECK_MESSAGE(chain.find(": statements are nested more than 200 deep") != std::string::npos, chain);
  CHECK(refusal(body("float y = " + repeated("(", 150) + "x" + repeated(")", 150) + ";")) == "");
}

TEST_CASE("huge variables are refused by name, huge texts by size") {
  CHECK(refusal(body("float huge[1000000];\nhuge[n] = x;\ncolor.x = huge[n + 1];")) ==
        "hostile.frag:5: huge has 1000000 numbers, and the variables of a shader at most 32768 together: put large "
        "tables "
        "into a texture or a buffer");
  CHECK(
      refusal(body("mat4 huge[65536][65536][65536];\nhuge[n][n][n][0][0] = x;")).find("huge has 2147483648 numbers") !=
      std::string::npos);
  CHECK(refusal(body("float fits[1000];\nfits[n] = x;")) == "");
  CHECK(refusal(shader("#version 450\n" + repeated("// padding\n", 500000) + "void main() {}\n"))
            .find("at most 4194304") != std::string::npos);
}

TEST_CASE("of the variables of functions those count that are there at once; the function that has the most is named") {
  const auto functions = [](int count, bool nested) {
    std::string text = "#version 450\nin float x; flat in int n; out vec4 color;\n", calls;
    for (int k = 0; k < count; ++k) {
      const std::string number = std::to_string(k), array = std::to_string(k == 7 ? 601 : 600);
      text += "float f" + number + "(inout vec3 v) { float t[" + array + "]; t[n] = v.x; " +
              (nested && k > 0 ? "v.y += f" + std::to_string(k - 1) + "(v); " : "") + "return t[n + 1]; }\n";
      if (!nested || k + 1 == count) calls += "  color.x += f" + number + "(color.xyz);\n";
    }
    return refusal(shader(text + "void main() {\n  color = vec4(x);\n" + calls + "}\n"));
  };
  CHECK(functions(200, false) == "");
  CHECK(functions(50, true) == "");
  const std::string message = functions(60, true);
  CHECK_MESSAGE(message.starts_with("hostile.frag:10: the variables of f7 have 6"), message);
  CHECK_MESSAGE(message.find("32768, of functions that call each other") != std::string::npos, message);
  std::string many;
  for (int k = 0; k < 70; ++k) many += "float g" + std::to_string(k) + "[500];\n";
  std::string used;
  for (int k = 0; k < 70; ++k)
    used += "g" + std::to_string(k) + "[n] = x; color.x += g" + std::to_string(k) + "[n + 1];\n";
  const std::string of_globals = refusal(
      shader("#version 450\nin float x; flat in int n; out vec4 color;\n" + many + "void main() {\n" + used + "}\n"));
  CHECK_MESSAGE(of_globals.starts_with("hostile.frag:3: the global variables have 35"), of_globals);
}

TEST_CASE("files that include each other end, chains of thousands are refused at the line that goes too far") {
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "twinshade_hostile_includes";
  std::filesystem::create_directories(folder);
  for (int k = 0; k < 300; ++k)
    std::ofstream(folder / (std::to_string(k) + ".glsl")) << "#include \"" << (k + 1) % 300 << ".glsl\"\n";
  std::ofstream(folder / "self.frag") << "#version 450\n#include \"self.frag\"\nvoid main() {}\n";
  std::ofstream(folder / "chain.frag") << "#version 450\n#include \"0.glsl\"\nvoid main() {}\n";
  CHECK_NOTHROW(load_shader((folder / "self.frag").string()));
  std::string what;
  try {
    load_shader((folder / "chain.frag").string());
  } catch (const UserError& error) {
    what = error.what();
  }
  CHECK_MESSAGE(what.find("99.glsl:1: files are included more than 100 deep") != std::string::npos, what);
  std::filesystem::remove_all(folder);
}

TEST_CASE("what glslang crashes on or never finishes is one failed shader") {
  // A struct's constructor in an array's: it looks for the member m of element 0 in the array itself. In desktop GLSL
  // it does not see `precise`.
  const std::string crash = refusal(
      shader("#version 320 es\nprecision highp float;\nstruct S { float a; float m; };\nin float x;\nout vec4 color;\n"
             "void main() {\n  S s = S(x, x);\n  S list[1] = S[1](s);\n  precise float y = list[0].m + x;\n"
             "  color = vec4(y);\n}\n"));
  CHECK_MESSAGE(crash.find("hostile.frag: glslang crashes on this shader") == 0, crash);
}

TEST_CASE("directives that say nonsense are glslang's to judge") {
  for (const char* line : {"#line", "#line x", "#line 99999999999999999999", "#line 3 4 5", "#line 3 \"", "#line \"a\"",
                           "#version", "#extension", "#include", "#pragma \"", "#if 1", "#define f(", "#\x01"})
    CHECK_NOTHROW([&] {
      try {
        translate(shader("#version 450\n" + std::string(line) + "\nvoid main() {}\n"));
      } catch (const UserError&) {
      }
    }());
}

TEST_CASE("calls that double with every function are refused") {
  std::string text = "#version 450\nin float x;\nout vec4 color;\nfloat f0(float v) { return v + 1.0; }\n";
  for (int k = 1; k <= 40; ++k) {
    const std::string call = "f" + std::to_string(k - 1) + "(v)";
    text += "float f" + std::to_string(k) + "(float v) { return " + call + " + " + call + "; }\n";
  }
  const std::string what = refusal(shader(text + "void main() { color = vec4(f40(x)); }\n"));
  CHECK_MESSAGE(what.find("calls functions that call functions") != std::string::npos, what);
}

TEST_CASE("loops that may not end count, loops that end by themselves do not") {
  const auto counts = [](const std::string& loop) {
    return translate(body("float s = 0.0;\n" + loop + "\ncolor = vec4(s);")).cpp.find("iterate(") != std::string::npos;
  };
  CHECK_FALSE(counts("for (int i = 0; i < 1000; ++i) s += x;"));
  CHECK_FALSE(counts("for (int i = 9; i >= 0; i -= 2) if (s > x) break;"));
  CHECK_FALSE(counts("for (uint i = 0u; i < 9u; i++) { if (s > 3.0) continue; s += x; }"));
  CHECK(counts("for (int i = 0; i < n; ++i) s += x;"));
  CHECK(counts("for (int i = n; i < 9; ++i) s += x;"));
  CHECK(counts("for (int i = 0; i < 9; ++i) { s += x; if (s > 3.0) --i; }"));
  CHECK(counts("for (int i = 0; i < 9; i -= 1) s += x;"));
  CHECK(counts("for (int i = 0; i <= 2147483647; ++i) s += x;"));
  CHECK(counts("for (uint i = 9u; i >= 0u; --i) s += x;"));
  CHECK(counts("for (int i = 0; i < 1000; ++i) for (int k = 0; k < 1000; ++k) s += x;"));
  CHECK(counts("while (s < x) s += 1.0;"));
  CHECK(counts("for (;;) { s += 1.0; if (s > x) break; }"));
  CHECK(counts("do { s += x; } while (s < 9.0);"));
}

TEST_CASE("a shader that never ends is stopped, with its file and line") {
  const ShaderSource source = shader(
      "#version 450\nin float x;\nout vec4 color;\nvoid main() {\n  float s = x;\n"
      "  while (s < 2.0) s = s * 0.5;\n  color = vec4(s);\n}\n");
  const ShaderModule& module = load_module(source, Number::scalar);
  CHECK(run_module(module, Number::scalar, {3.0}, 1) == std::vector<double>(4, 3.0));
  CHECK_THROWS_WITH_AS(run_module(module, Number::scalar, {1.0}, 1),
                       "hostile.frag:6: the shader does not end: this loop was stopped after 67108864 iterations",
                       UserError);
}
