// twinshade-translate: GLSL to C++ at build time.
//   twinshade-translate INPUT.frag [-I FOLDER]... [--define NAME=VALUE]... [--name IDENTIFIER] [--readable] -o OUT.cpp
//   twinshade-translate --builtin TECHNIQUE[:vertex] [--name IDENTIFIER] [--readable] -o OUT.cpp
#include <cstdio>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/file.h"
#include "cpu_shaders/translate/translate.h"
#include "lighting/registry.h"

namespace {

using namespace twinshade;

int run(const std::vector<std::string>& arguments) {
  std::string input, output, builtin, defines;
  std::vector<std::string> folders;
  TranslateOptions options;
  for (std::size_t k = 0; k < arguments.size(); ++k) {
    const std::string& a = arguments[k];
    const auto next = [&]() -> const std::string& {
      if (k + 1 == arguments.size()) throw UserError(a + " wants a value");
      return arguments[++k];
    };
    if (a == "-I")
      folders.push_back(next());
    else if (a == "-o")
      output = next();
    else if (a == "--name")
      options.identifier = next();
    else if (a == "--builtin")
      builtin = next();
    else if (a == "--readable")
      options.readable = true;
    else if (a == "--define") {
      std::string define = next();
      const std::size_t equals = define.find('=');
      if (equals != std::string::npos) define[equals] = ' ';
      defines += "#define " + define + "\n";
    } else if (a[0] == '-')
      throw UserError("unknown option " + a);
    else if (!input.empty())
      throw UserError("one shader at a time: " + input + " or " + a);
    else
      input = a;
  }
  if (input.empty() == builtin.empty()) throw UserError("name a shader file or --builtin TECHNIQUE");
  if (output.empty()) throw UserError("name the file to write: -o OUT.cpp");
  ShaderSource source;
  if (!builtin.empty()) {
    const std::size_t colon = builtin.find(':');
    const bool vertex = colon != std::string::npos && builtin.substr(colon + 1) == "vertex";
    source = technique_source(find_technique(builtin.substr(0, colon)),
                              vertex ? CoefficientStorage::vertex : CoefficientStorage::lightmap);
  } else {
    source = load_shader(input, folders);
    const std::size_t after_version = source.text.rfind("#version", 0) == 0 ? source.text.find('\n') + 1 : 0;
    source.text.insert(after_version, defines);
  }
  write_file(output, translate(source, options).cpp);
  return 0;
}

}  // namespace

int main(int count, char** arguments) {
  try {
    return run({arguments + 1, arguments + count});
  } catch (const std::exception& error) {
    std::fprintf(stderr, "twinshade-translate: %s\n", error.what());
    return 2;
  }
}
