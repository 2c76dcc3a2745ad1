// Draws a bundle with one of the built-in shaders linked into it and prints the frame's hash: the whole CPU renderer
// and nothing else, so that it cross-compiles without a library.
//   hash_frame BUNDLE SHADER [lanes4|lanes8|lanes16|scalar] [THREADS]
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/parallel.h"
#include "raster/tiled/tiled_renderer.h"
#include "tools/aarch64/linked_shaders.h"

using namespace twinshade;

namespace {

Number number_named(const std::string& name) {
  const std::vector<std::pair<std::string, Number>> numbers = {
      {"lanes4", Number::lanes4}, {"lanes8", Number::lanes8}, {"lanes16", Number::lanes16}, {"scalar", Number::scalar}};
  for (const auto& [known, number] : numbers)
    if (name == known) return number;
  throw UserError("number " + name + " is not lanes4, lanes8, lanes16 or scalar");
}

ShaderModule module_named(const std::string& name) {
  std::string known;
  for (const LinkedShader& shader : linked_shaders()) {
    if (name == shader.identifier) {
      ShaderModule module = *shader.module;
      module.entries = shader.entries;
      module.entry_count = shader.entry_count;
      return module;
    }
    known.append(" ").append(shader.identifier);
  }
  throw UserError("no shader " + name + " is linked in; there are" + known);
}

int run(const std::vector<std::string>& arguments) {
  if (arguments.size() < 2 || arguments.size() > 4)
    throw UserError("usage: hash_frame BUNDLE SHADER [lanes4|lanes8|lanes16|scalar] [THREADS]");
  DrawOptions options;
  options.isa = Isa::baseline;
  if (arguments.size() > 2) options.number = number_named(arguments[2]);
  if (arguments.size() > 3) set_thread_count(std::atoi(arguments[3].c_str()));
  const Frame frame = draw_tiled(read_bundle(arguments[0]), module_named(arguments[1]), options);
  std::printf("%s\n", frame_hash(frame).c_str());
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run({argv + 1, argv + argc});
  } catch (const std::exception& error) {
    std::fprintf(stderr, "hash_frame: %s\n", error.what());
    return 2;
  }
}
