// What a typed header says. That it compiles and computes is shown by the package tests.
#include "cpu_shaders/package/cpp_header.h"

#include <doctest/doctest.h>

#include "base/error.h"
#include "cpu_shaders/package/declaration_order.h"
#include "cpu_shaders/package/reserved_names.h"
#include "cpu_shaders/package/value_tree.h"

using namespace twinshade;

namespace {

CppHeader header_of(const std::string& glsl) {
  const ShaderSource source = resolve_shader("mine", glsl, "folder/mine.frag");
  return cpp_header("mine", translate(source), source, {"baseline"});
}

bool comes_before(const std::string& text, const std::string& a, const std::string& b) {
  return text.find(a) != std::string::npos && text.find(a) < text.find(b) && text.find(b) != std::string::npos;
}

}  // namespace

TEST_CASE("shaders of one name that differ have no symbol in common, the same shader has the same ones") {
  const std::string glsl = "in float x;\nout float r;\nvoid main() { r = x; }\n";
  const ShaderSource source = resolve_shader("mine", glsl, "folder/mine.frag");
  const std::vector<std::string> isas = {"baseline"};
  TranslateOptions options;
  options.identifier = package_identifier("mine", source, isas);
  CHECK(options.identifier == package_identifier("mine", resolve_shader("mine", glsl, "folder/mine.frag"), isas));
  for (const ShaderSource& other :
       {resolve_shader("mine", glsl + " ", "folder/mine.frag"), resolve_shader("mine", glsl, "elsewhere/mine.frag")})
    CHECK(options.identifier != package_identifier("mine", other, isas));
  CHECK(options.identifier != package_identifier("mine", source, {"baseline", "avx2"}));

  const Translation translation = translate(source, options);
  const CppHeader typed = cpp_header("mine", translation, source, isas);
  const std::string namespaces = "namespace mine {\ninline namespace " + options.identifier + " {\n";
  CHECK(typed.header.find(namespaces) != std::string::npos);
  CHECK(typed.calls.find(namespaces) != std::string::npos);
  CHECK(typed.calls.find("#include \"mine.h\"") != std::string::npos);
  CHECK(typed.calls.find(" twinshade_entries_" + options.identifier + "_baseline[]") != std::string::npos);
  for (const char* symbol : {"namespace shader_", "twinshade_module_", "twinshade_entries_", "twinshade_entry_count_"})
    for (std::size_t at = translation.cpp.find(symbol); at != std::string::npos;
         at = translation.cpp.find(symbol, at + 1))
      CHECK(translation.cpp.compare(at + std::string(symbol).size(), options.identifier.size(), options.identifier) ==
            0);
}

TEST_CASE("a compute shader gets no header, which would have neither inputs nor outputs") {
  const ShaderSource source = resolve_shader(
      "k", "layout(local_size_x = 8) in;\nbuffer B { float d[]; };\nvoid main() { d[0] = 1.0; }\n", "k.comp");
  std::string refused;
  try {
    cpp_header("k", translate(source), source, {"baseline"});
  } catch (const UserError& error) {
    refused = error.what();
  }
  CHECK_MESSAGE(refused.rfind("k.comp: a compute shader", 0) == 0, refused);
}

TEST_CASE("names that no header and namespace can have are refused") {
  for (const char* name :
       {"errno", "EOF", "linux", "assert", "NULL", "main", "class", "std", "limits", "s::t", "_x", "2d", "a-b", ""})
    CHECK_MESSAGE(!header_name_refusal(name).empty(), name);
  for (const char* name : {"sunlight", "s2", "a_b", "string", "Uniforms", "Real", "Errno"})
    CHECK_MESSAGE(header_name_refusal(name).empty(), name);
  CHECK(header_name_refusal("_x").find("begin with a letter") != std::string::npos);
}

TEST_CASE("names are listed as they are declared, whatever stands in comments and functions") {
  CHECK(declared_names("// in vec3 no;\nuniform float a, b; /* out x */\nfloat f() { return 1.0; }\nflat in\nint c;") ==
        std::vector<std::string>{"float", "a", "b", "int", "c"});
  CHECK(declared_names("layout(location = 1) out vec4 d;\nuniform Block { vec4 inside; };") ==
        std::vector<std::string>{"vec4", "d", "Block"});
  CHECK(declared_names("in float x; // no end of line").size() == 2);
  CHECK(declared_names("/* no end").empty());
}

TEST_CASE("members come in the order of the source, not of use") {
  const std::string header = header_of(
                                 "in float second;\nin float first;\nuniform vec2 b;\nuniform vec2 a;\nout vec2 r;\n"
                                 "void main() { r = a * first + b * second; }\n")
                                 .header;
  CHECK(comes_before(header, " second{}", " first{}"));
  CHECK(comes_before(header, " b{}", " a{}"));
  CHECK(header.find("/folder") == std::string::npos);
}

TEST_CASE("what a shader does not have is not in its header") {
  const std::string plain = header_of("in float x;\nout float r;\nvoid main() { r = x; }\n").header;
  for (const char* name : {"gl_FragCoord", "gl_FrontFacing", "gl_PrimitiveID", "gl_FragDepth", "discarded", "quad"})
    CHECK_MESSAGE(plain.find(name) == std::string::npos, name);
  CHECK(plain.find("InputsDouble") != std::string::npos);
  const std::string bits = header_of("flat in uint x;\nout float r;\nvoid main() { r = uintBitsToFloat(x); }\n").header;
  CHECK(bits.find("InputsDouble") == std::string::npos);
  CHECK(bits.find("// Not in double: folder/mine.frag:3: ") != std::string::npos);
}

TEST_CASE("flat names become structs and arrays, arrays of arrays too") {
  std::vector<ValueNode> nodes;
  add_value(nodes, "lights[0].colour", 0, "Colour", "vec3");
  add_value(nodes, "lights[0].samples[1]", 4, "float", "float");
  add_value(nodes, "lights[1].colour", 0, "Colour", "vec3");
  add_value(nodes, "lights[1].samples[1]", 4, "float", "float");
  add_value(nodes, "new", 0, "int", "int");
  name_members(nodes, {});
  CHECK(declare_values(nodes, "") ==
        "struct lights_struct {\n"
        "  Colour colour{};  // vec3 colour\n"
        "  std::array<std::array<float, 4>, 2> samples{};  // float samples[2][4]\n"
        "};\n"
        "std::array<lights_struct, 2> lights{};  // struct lights[2]\n"
        "int new_{};  // int new\n");
  CHECK(cpp_path(nodes, "lights[1].samples[1]") == "lights[1].samples[1]");
  CHECK(cpp_path(nodes, "new") == "new_");
}

TEST_CASE("names are unique in their scope and GLSL's where they can be") {
  std::vector<ValueNode> nodes;
  for (const char* name : {"new", "new_", "a.b.a_struct", "a.b.b_struct", "a_struct", "INT_MAX", "MVP", "kept", "std"})
    add_value(nodes, name, 0, "float", "float");
  name_members(nodes, {"kept"});
  CHECK(declare_values(nodes, "") ==
        "float new__{};  // float new\n"
        "float new_{};  // float new_\n"
        "struct a_struct_ {\n"
        "  struct b_struct_ {\n"
        "    float a_struct{};  // float a_struct\n"
        "    float b_struct{};  // float b_struct\n"
        "  };\n"
        "  b_struct_ b{};  // struct b\n"
        "};\n"
        "a_struct_ a{};  // struct a\n"
        "float a_struct{};  // float a_struct\n"
        "float INT_MAX_{};  // float INT_MAX\n"
        "float MVP{};  // float MVP\n"
        "float kept_{};  // float kept\n"
        "float std_{};  // float std\n");
  CHECK(cpp_path(nodes, "a.b.b_struct") == "a.b.b_struct");
  CHECK(cpp_path(nodes, "new") == "new__");
}

TEST_CASE("names that only compilers know as words get underscores, others with underscores in front stay") {
  for (const char* name : {"typeof", "_Alignas", "_Complex", "__is_class", "__FILE__", "INT_WIDTH", "LC_NAME"})
    CHECK_MESSAGE(is_reserved_name(name), name);
  for (const char* name : {"_MainTex", "_Color", "_x", "a__b", "SYS_read", "EXPOSURE", "emit", "LC_TABLE"})
    CHECK_MESSAGE(!is_reserved_name(name), name);
}

TEST_CASE("macros of the author's names are put aside and put back, those of names that C++ has otherwise are not") {
  const CppHeader typed = header_of(
      "struct S { float emit; };\nuniform S s;\nuniform float EOF;\nin float near;\nout float far;\n"
      "void main() { far = s.emit + EOF + near; }\n");
  for (const char* name : {"emit", "s", "near", "far"}) {
    const std::string undef = std::string("#undef ") + name + "\n", quoted = std::string("macro(\"") + name + "\")\n";
    CHECK(comes_before(typed.header, "#pragma push_" + quoted + undef, "struct Uniforms"));
    CHECK(comes_before(typed.header, "OutputsDouble> outputs);", "#pragma pop_" + quoted));
    CHECK(comes_before(typed.calls, undef, "struct Bound"));
  }
  CHECK(typed.header.find("macro(\"EOF") == std::string::npos);
}

TEST_CASE("an output named discarded keeps its name where nothing is discarded") {
  const std::string shader = "in float x;\nout float discarded;\nvoid main() { discarded = x; }\n";
  CHECK(header_of(shader).header.find(" Real discarded{};") != std::string::npos);
  const std::string discards =
      "in float x;\nout float discarded;\nvoid main() { if (x < 0.0) discard; discarded = x; }\n";
  CHECK(header_of(discards).header.find(" Real discarded_{};") != std::string::npos);
  CHECK(header_of(discards).calls.find("out.discarded_)") != std::string::npos);
}

TEST_CASE("uniforms have the values that the shader gives them") {
  const std::string header = header_of(
                                 "uniform float a = -0.0, b = 1.0e30, c = 0.1;\nuniform ivec2 d = ivec2(-1, 0);\n"
                                 "uniform mat2 e[1] = mat2[1](mat2(1.0));\nuniform bool f = true, g = false;\n"
                                 "out float r;\n"
                                 "void main() { r = a + b + c + float(d.x) + e[0][1].x + (f && g ? 1.0 : 2.0); }\n")
                                 .header;
  for (const char* member : {" a{-0.0f};", " b{1e+30f};", " c{0.1f};", " d{{-1, 0}};",
                             " e{{{{{{1.0f, 0.0f}}, {{0.0f, 1.0f}}}}}};", " f{true};", " g{};"})
    CHECK_MESSAGE(header.find(member) != std::string::npos, member, header);
}
