#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>

#include "base/error.h"
#include "cpu_shaders/shader_source.h"
#include "cpu_shaders/source/builtin_shaders.h"
#include "cpu_shaders/source/glsl_tokens.h"
#include "cpu_shaders/source/line_names.h"
#include "cpu_shaders/source/macro_list.h"
#include "cpu_shaders/source/preprocess.h"

using namespace twinshade;

namespace {

struct Folder {
  std::filesystem::path path = std::filesystem::temp_directory_path() / "twinshade_source_test";
  Folder() {
    std::filesystem::remove_all(path);
    std::filesystem::create_directories(path / "inner");
  }
  ~Folder() { std::filesystem::remove_all(path); }
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(path / name, std::ios::binary) << text;
    return (path / name).string();
  }
};

// The folder that the program runs in, for as long as this lives.
class CurrentFolder {
 public:
  explicit CurrentFolder(const std::filesystem::path& folder) : before_(std::filesystem::current_path()) {
    std::filesystem::current_path(folder);
  }
  ~CurrentFolder() { std::filesystem::current_path(before_); }
  CurrentFolder(const CurrentFolder&) = delete;
  CurrentFolder& operator=(const CurrentFolder&) = delete;

 private:
  std::filesystem::path before_;
};

std::string error_of(const std::function<void()>& body) {
  try {
    body();
  } catch (const UserError& error) {
    return error.what();
  }
  return "";
}

// The line that a compiler honouring #line reports for the first line containing `needle`.
std::string reported_position(const std::string& text, const std::string& needle) {
  std::string file;
  int next = 1;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line); ++next) {
    if (line.rfind("#line ", 0) == 0) {
      const std::size_t space = line.find(' ', 6);
      next = std::stoi(line.substr(6, space - 6)) - 1;
      file = line.substr(space + 1);
    } else if (line.find(needle) != std::string::npos) {
      return file + ":" + std::to_string(next);
    }
  }
  return "not found";
}

std::size_t count_of(const std::string& text, const std::string& needle) {
  std::size_t count = 0;
  for (std::size_t at = text.find(needle); at != std::string::npos; at = text.find(needle, at + 1)) ++count;
  return count;
}

}  // namespace

TEST_CASE("includes are resolved beside the including file, in the include folders and among the built-ins") {
  Folder folder;
  folder.write("inner/leaf.glsl", "float leaf() { return 1.0; }\n");
  folder.write("branch.glsl", "#include \"inner/leaf.glsl\"\nfloat branch() { return leaf(); }\n");
  const std::string main = folder.write("main.frag",
                                        "#include \"branch.glsl\"\n"
                                        "#include <leaf.glsl>\n"
                                        "#include \"exact/attributes.glsl\"\n"
                                        "void main() {}\n");
  const ShaderSource source = load_shader(main, {{(folder.path / "inner").string()}});
  CHECK(source.name == "main");
  CHECK(source.files.size() == 4);
  CHECK(source.files[0] == main);
  CHECK(source.files[3] == "shaders/exact/attributes.glsl");
  CHECK(count_of(source.text, "float leaf()") == 1);  // reached twice, included once
  CHECK(source.text.find("exact_barycentrics") != std::string::npos);
  CHECK(reported_position(source.text, "void main") == '"' + main + "\":4");
  CHECK(reported_position(source.text, "float branch") == '"' + source.files[1] + "\":2");
  CHECK(reported_position(gl_text(source, "#version 330", ""), "float branch") == "1:2");
}

TEST_CASE("a text that is no file includes nothing of the current folder") {
  Folder folder;
  std::filesystem::create_directories(folder.path / "exact");
  folder.write("exact/dot.glsl", "float somebody_elses;\n");
  folder.write("t.frag", "");
  const CurrentFolder current(folder.path);
  const std::string text = "#include \"exact/dot.glsl\"\n";
  CHECK(resolve_shader("t", text, "made by the program").text.find("somebody_elses") == std::string::npos);
  CHECK(resolve_shader("t", text, "made by the program", {{"."}}).text.find("somebody_elses") != std::string::npos);
  CHECK(resolve_shader("t", text, "t.frag").text.find("somebody_elses") != std::string::npos);
  CHECK(error_of([] { resolve_shader("t", "#include \"lost.glsl\"\n", "made by the program"); }) ==
        "made by the program:1: cannot include \"lost.glsl\": not found in built-in shaders");
}

TEST_CASE("a file is a built-in shader by what is in it, not by its name") {
  Folder folder;
  std::filesystem::create_directories(folder.path / "shaders" / "exact");
  folder.write("shaders/exact/dot.glsl", "float own;\n");
  folder.write("shaders/exact/exp2.glsl", std::string(builtin_shader("exact/exp2.glsl").value()));
  folder.write("t.frag",
               "#include \"shaders/exact/dot.glsl\"\n#include \"shaders/exact/exp2.glsl\"\n#include "
               "\"exact/normalize.glsl\"\n");
  const CurrentFolder current(folder.path);
  const ShaderSource source = load_shader("t.frag");
  CHECK(source.files[1] == "./shaders/exact/dot.glsl");
  CHECK(source.files[2] == "shaders/exact/exp2.glsl");
  CHECK(source.builtin_files.count("./shaders/exact/dot.glsl") == 0);
  CHECK(source.builtin_files.count("shaders/exact/exp2.glsl") == 1);
  CHECK(source.builtin_files.count("shaders/exact/dot.glsl") == 1);  // which normalize.glsl includes
}

TEST_CASE("lines stay right after continued lines and comments") {
  const ShaderSource source =
      resolve_shader("t",
                     "#define A 1 + \\\n  2\n"
                     "/* #include \"nowhere\"\n*/ // #include \"nowhere\" \\\n #include \"nowhere\"\n"
                     "#include /* a */ \"exact/attributes.glsl\"\r\n"
                     "float marker;\n",
                     "t.frag");
  CHECK(reported_position(source.text, "marker") == "\"t.frag\":7");
}

TEST_CASE("a comment that begins or ends on the line of a directive keeps its other half") {
  const ShaderSource version =
      resolve_shader("t", "/* Licence\n text */ #version 330 /* the\n version */\nfloat marker;\n", "t.frag");
  CHECK(version.version == 330);
  CHECK(reported_position(version.text, "marker") == "\"t.frag\":4");
  CHECK(count_of(version.text, "/*") == 2);
  CHECK(count_of(version.text, "*/") == 2);
  const ShaderSource included = resolve_shader(
      "t", "/* helpers\n*/ #include \"exact/attributes.glsl\" /* from\n there */\nfloat marker;\n", "t.frag");
  CHECK(reported_position(included.text, "marker") == "\"t.frag\":4");
  CHECK(included.text.find("helpers\n*/") < included.text.find("exact_barycentrics"));
  const ShaderSource split = resolve_shader(
      "t", "#include /* a\n b */ \"exact/attributes.glsl\"\n#extension GL_X : enable /* c\n d */\nfloat marker;\n",
      "t.frag");
  CHECK(split.files.size() == 2);
  CHECK(reported_position(split.text, "marker") == "\"t.frag\":5");
}

TEST_CASE("an #include that the preprocessor does not read is none") {
  Folder folder;
  folder.write("leaf.glsl", "float leaf;\n");
  const std::string main = folder.write("main.frag",
                                        "#define TWO 2\n"
                                        "#if TWO > 3\n#include \"leaf.glsl\"\n#include \"missing.glsl\"\n#else\n"
                                        "#ifdef TWO\n#include \"leaf.glsl\"\n#endif\n#endif\nfloat marker;\n");
  const ShaderSource source = load_shader(main);
  CHECK(source.files.size() == 2);
  CHECK(count_of(source.text, "float leaf") == 1);
  CHECK(reported_position(source.text, "marker") == '"' + main + "\":10");
  CHECK(error_of([] {
          resolve_shader("t", "#if 1\n#include \"lost.glsl\"\n#endif\n", "t.frag");
        }).rfind("t.frag:2: cannot include", 0) == 0);
  std::string many;
  for (int i = 0; i < 1100; ++i) many += "#if 0\n#include \"lost.glsl\"\n#endif\n";
  CHECK(error_of([&] { resolve_shader("t", many, "t.frag"); }).find("more than 1000") != std::string::npos);
}

TEST_CASE("__FILE__ is the number of the file, as drivers have it") {
  Folder folder;
  folder.write("leaf.glsl", "int leaf() { return __FILE__; }\n");
  const std::string main = folder.write("main.frag", "#include \"leaf.glsl\"\nint own = __FILE__, not__FILE__;\n");
  const std::string text = load_shader(main).text;
  CHECK(text.find("return 1;") != std::string::npos);
  CHECK(text.find("own = 0, not__FILE__;") != std::string::npos);
}

TEST_CASE("__FILE__ is what the author's #line says, and stays a name where it is asked for") {
  const std::string text = resolve_shader("t",
                                          "int a = __FILE__;\n#line 5 10\nint b = __FILE__;\n#line 7\n"
                                          "#include \"exact/dot.glsl\"\nint c = __FILE__;\n"
                                          "#ifdef __FILE__\n#endif\n#if defined ( __FILE__) && __FILE__ == 0\n#endif\n",
                                          "t.frag")
                               .text;
  CHECK(text.find("a = 0;") != std::string::npos);
  CHECK(text.find("b = __FILE__;") != std::string::npos);
  CHECK(text.find("c = 0;") != std::string::npos);
  CHECK(text.find("#ifdef __FILE__\n") != std::string::npos);
  CHECK(text.find("#if defined ( __FILE__) && 0 == 0\n") != std::string::npos);
}

TEST_CASE("a #version that the preprocessor does not read is none") {
  const ShaderSource source = resolve_shader("t", "#version 330\n#if 0\n#version 450\n#endif\nfloat a;\n", "t.frag");
  CHECK(source.version == 330);
  CHECK(count_of(source.text, "#version") == 1);
  CHECK(reported_position(source.text, "float a") == "\"t.frag\":5");
}

TEST_CASE("versions that there are not, or that are too old, are refused by line before anything is preprocessed") {
  const auto refusal = [](const std::string& version) {
    return error_of([&] {
      resolve_shader("t", "// old\n#version " + version + "\n#if 1\n#include \"exact/dot.glsl\"\n#endif\n", "t.frag");
    });
  };
  CHECK(refusal("120") == "t.frag:2: GLSL 120 is not supported: write #version 330 or later");
  CHECK(refusal("100") == "t.frag:2: GLSL ES 100 is not supported: write #version 300 es or later");
  CHECK(refusal("331") == "t.frag:2: GLSL 331 is not known: write #version 330 to 460");
  CHECK(refusal("301 es") == "t.frag:2: GLSL ES 301 is not known: write #version 300 es to 320 es");
  CHECK(refusal("330") == "");
}

TEST_CASE("what GLSL 4.50 has of an extension can be required") {
  const auto text = [](const std::string& line) { return resolve_shader("t", line + "\n", "t.frag").text; };
  CHECK(text("#extension GL_ARB_arrays_of_arrays : require").find("GL_ARB_arrays_of_arrays : enable\n") !=
        std::string::npos);
  CHECK(text("#extension GL_ARB_gpu_shader5 : require").find("GL_ARB_gpu_shader5 : require\n") != std::string::npos);
}

TEST_CASE("defines stand in front of the main file, behind #version and #extension, and move no line") {
  const ShaderSource source = resolve_shader("t",
                                             "#version 330\n#extension GL_ARB_gpu_shader5 : enable\n"
                                             "#if LEVEL > 1 && defined(FAST)\nfloat marker = SCALE;\n#endif\n",
                                             "t.frag", {{}, {"LEVEL=2", "FAST", "SCALE=2.0 * 3.0", "EMPTY="}});
  CHECK(source.text.find("#define LEVEL 2\n#define FAST 1\n#define SCALE 2.0 * 3.0\n#define EMPTY \n") >
        source.text.find("GL_ARB_gpu_shader5"));
  CHECK(reported_position(source.text, "marker") == "\"t.frag\":4");
  const std::string text = preprocess(source);
  CHECK(text.find("marker") != std::string::npos);
  CHECK(text.find("2.0") != std::string::npos);
}

TEST_CASE("what is no define is refused by itself") {
  for (const char* define :
       {"", "=1", "1A", "A-B=2", "F(x)=x", "GL_ES", "gl_x=1", "A__B", "defined", "A=1\n2", "A=1\\"})
    CHECK_MESSAGE(error_of([&] { require_define(define); }).find("--define " + std::string(define) + ": ") == 0,
                  define);
  for (const char* define : {"A", "_a1=", "A=B=C"}) CHECK_NOTHROW(require_define(define));
}

TEST_CASE("form feeds and vertical tabs are white space") {
  CHECK(resolve_shader("t", "float\fa\v;\n", "t.frag").text.find("float a ;\n") != std::string::npos);
}

TEST_CASE("lines may end as on old Macs, profiles are those of GLSL") {
  CHECK(reported_position(resolve_shader("t", "float a;\rfloat marker;\r\nfloat b;", "t.frag").text, "marker") ==
        "\"t.frag\":2");
  CHECK(error_of([] {
          resolve_shader("t", "\n#version 450 cor\n", "t.frag");
        }).rfind("t.frag:2: #version 450 cor", 0) == 0);
}

TEST_CASE("#version comes first, #extension before all code") {
  const ShaderSource source = resolve_shader("t",
                                             "// a comment\n#version 310 es\nfloat a;\n"
                                             "#extension GL_OES_sample_variables : enable\n"
                                             "#extension GL_GOOGLE_include_directive : require\n"
                                             "#ifdef X\n#extension GL_KEPT_in_place : enable\n#endif\nfloat b;\n",
                                             "t.frag");
  CHECK(source.version == 310);
  CHECK(source.es);
  CHECK(source.text.rfind("#version 310 es\n", 0) == 0);
  CHECK(source.text.find("GL_OES_sample_variables") < source.text.find("float a"));
  CHECK(source.text.find("GL_KEPT_in_place") > source.text.find("float a"));
  CHECK(source.text.find("include_directive") == std::string::npos);
  CHECK(reported_position(source.text, "float b") == "\"t.frag\":9");

  const std::string text = gl_text(source, "#version 450", "uniform float extra;");
  CHECK(text.rfind("#version 450\n", 0) == 0);
  CHECK(count_of(text, "#version") == 1);
  CHECK(text.find("GL_OES_sample_variables") < text.find("extra"));
  CHECK(text.find("extra") < text.find("float a"));
  CHECK(reported_position(text, "float b") == "0:9");
}

TEST_CASE("#version is refused behind code, directives and another #version") {
  for (const std::string before : {"in vec2 v;\n", "#define X 1\n", "#ifndef GL_ES\n", "#include \"exact/dot.glsl\"\n",
                                   "/* a comment */ #pragma optimize(on)\n"})
    CHECK(error_of([&] { resolve_shader("t", before + "#version 330\n", "t.frag"); }) ==
          "t.frag:2: #version must come first, before all but comments: move it to the top of the file");
  CHECK(error_of([] { resolve_shader("t", "#version 330\nin vec2 v;\n#version 450\n", "t.frag"); }) ==
        "t.frag:3: a second #version: leave one of them out");
  CHECK(error_of([] { resolve_shader("t", "#version 330\n#version 330\n", "t.frag"); }) ==
        "t.frag:2: a second #version: leave one of them out");
  CHECK(resolve_shader("t", "\n/* a\n * comment */ // and\n\t\n  # version 330\nin vec2 v;\n", "t.frag").version ==
        330);
}

TEST_CASE("a text without #version has none and counts as 450") {
  const ShaderSource source = resolve_shader("t", "void main() {}\n", "t.frag");
  CHECK(source.version == 450);
  CHECK_FALSE(source.es);
  CHECK(source.text.find("#version") == std::string::npos);
}

TEST_CASE("what cannot be included is named with file, line and places") {
  const std::string missing = error_of([] { resolve_shader("t", "\n#include \"lost.glsl\"\n", "a/t.frag", {{"b"}}); });
  CHECK(missing == "a/t.frag:2: cannot include \"lost.glsl\": not found in a, b, built-in shaders");
  CHECK(error_of([] { resolve_shader("t", "#include LOST\n", "t.frag"); }).rfind("t.frag:1: ", 0) == 0);
  CHECK(error_of([] { load_shader("/nonexistent.frag"); }).find("/nonexistent.frag") != std::string::npos);
}

TEST_CASE("a file named like a shader of another stage is refused, not taken for a fragment shader") {
  for (const std::string name :
       {"s.vert", "s.vs", "s.vsh", "s.geom", "s.tesc", "s.tese", "s.mesh", "s.task", "s.rgen", "a/s.vert.glsl"}) {
    const std::string refused = error_of([&] { resolve_shader("s", "#include \"lost.glsl\"\n", name); });
    CHECK_MESSAGE(refused.rfind(name + ": .", 0) == 0, refused);
    CHECK_MESSAGE(refused.find(" .frag") != std::string::npos, refused);
  }
  CHECK(error_of([] { resolve_shader("s", "", "s.vert"); }) ==
        "s.vert: .vert is the ending of a vertex shader, a stage that is not supported: name fragment shaders .frag, "
        "compute shaders .comp");
  for (const char* name : {"s", "s.frag", "s.fs", "s.glsl", "s.vert.frag", "s.frag.glsl", "of.vert/s.frag"})
    CHECK_MESSAGE(resolve_shader("s", "", name).stage == ShaderStage::fragment, name);
  CHECK(resolve_shader("s", "", "s.comp").stage == ShaderStage::compute);
  CHECK(resolve_shader("s", "", "s.comp.glsl").stage == ShaderStage::compute);
}

TEST_CASE("a file that includes itself is included once") {
  Folder folder;
  const std::string main =
      folder.write("loop.frag", "#include \"loop.frag\"\n#include \"./inner/../loop.frag\"\nfloat once;\n");
  CHECK(count_of(load_shader(main).text, "float once") == 1);
}

TEST_CASE("a list of macro calls is included again, for the macros that are there then") {
  Folder folder;
  folder.write("lights.def", "// all lights\nLIGHT(sun, (1 + 1))\nLIGHT(sky, 3);\n");
  folder.write("part.glsl", "float part() { return 1.0; }\n");
  const std::string main =
      folder.write("main.frag",
                   "#define LIGHT(name, n) const int name = n;\n#include \"lights.def\"\n#undef LIGHT\n"
                   "#define LIGHT(name, n) + name\nconst int all = 0\n#include \"lights.def\"\n"
                   "#include \"part.glsl\"\n#include \"part.glsl\"\nfloat marker;\n");
  const ShaderSource source = load_shader(main);
  CHECK(count_of(source.text, "LIGHT(sun, (1 + 1))") == 2);
  CHECK(count_of(source.text, "float part()") == 1);
  CHECK(reported_position(source.text, "marker") == '"' + main + "\":9");
  folder.write("endless.def", "X(1)\n#include \"endless.def\"\n");
  CHECK(error_of([&] {
          load_shader(folder.write("endless.frag", "#define X(n)\n#include \"endless.def\"\n"));
        }).find("more than 100 deep") != std::string::npos);
}

TEST_CASE("files of macro calls alone are told from others") {
  for (const char* text : {"X(1)", "X(a, f(b)); X(c),\n// d\nX(/* e */ g)\n#undef X\n"})
    CHECK_MESSAGE(is_list_of_macro_calls(text), text);
  for (const char* text : {"", "#define X 1\n", "float f(int);", "X", "X(1", "f(1) g", "const float pi = 3.14;",
                           "#pragma once\nX(1)\n", "X(1) { }"})
    CHECK_FALSE_MESSAGE(is_list_of_macro_calls(text), text);
}

TEST_CASE("driver logs are mapped back to files") {
  ShaderSource source;
  source.files = {"main.frag", "shaders/exact/dot.glsl"};
  CHECK(map_driver_log(source, "1:12(5): error: `x' undeclared\n0:3(1): warning: y\n7:1(1): other\nlinking failed") ==
        "shaders/exact/dot.glsl:12: error: `x' undeclared\nmain.frag:3: warning: y\n7:1(1): other\nlinking failed");
  CHECK(map_driver_log(source, "1(40) : error C1008\n") == "shaders/exact/dot.glsl:40 : error C1008\n");
}

TEST_CASE("files whose names have quotes, which #line cannot hold, keep their names and numbers") {
  Folder folder;
  const std::string inner = folder.write("in\"1.glsl", "float inner;\n");
  const ShaderSource source = load_shader(folder.write("q\"3.frag", "#include \"in\"1.glsl\"\nfloat outer;\n"));
  REQUIRE(source.files.size() == 2);
  CHECK(source.files[1] == inner);
  CHECK(source.text.find("#line 1 \"" + line_name(inner) + "\"") != std::string::npos);
  CHECK(reported_position(gl_text(source, "#version 450", ""), "inner") == "1:1");
  CHECK(reported_position(gl_text(source, "#version 450", ""), "outer") == "0:2");
  CHECK(with_real_names(source.files, line_name(inner) + ":1: no") == inner + ":1: no");
  CHECK(with_real_names({"q'3.frag"}, "q'3.frag:1: no") == "q'3.frag:1: no");
  const TokenList tokens = tokenize(source);
  REQUIRE(tokens.files.size() == 2);
  CHECK(position(source, tokens.tokens[0]) == inner + ":1: ");
  const std::string wrong = folder.write("q\"4.frag", "#error no\n");
  CHECK(error_of([&] { preprocess(load_shader(wrong)); }).rfind(wrong + ":1: ", 0) == 0);
}

TEST_CASE("the hash depends on text, version and dialect") {
  ShaderSource a;
  a.text = "void main() {}";
  ShaderSource b = a, c = a, d = a;
  b.text += ' ';
  c.version = 330;
  d.es = true;
  CHECK(source_hash(a).size() == 64);
  CHECK(source_hash(a) != source_hash(b));
  CHECK(source_hash(a) != source_hash(c));
  CHECK(source_hash(a) != source_hash(d));
}

TEST_CASE("every file under shaders/ is in the binary") {
  const auto names = builtin_shader_names();
  const std::filesystem::path root = std::filesystem::path(TWINSHADE_SOURCE_DIR) / "shaders";
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root)) {
    const std::string ending = entry.path().extension().string();
    if (ending != ".glsl" && ending != ".frag") continue;
    const std::string name = std::filesystem::relative(entry.path(), root).string();
    CAPTURE(name);
    CHECK(std::find(names.begin(), names.end(), name) != names.end());
    std::ifstream file(entry.path(), std::ios::binary);
    const std::string text((std::istreambuf_iterator<char>(file)), {});
    CHECK(builtin_shader(name) == text);
  }
}
