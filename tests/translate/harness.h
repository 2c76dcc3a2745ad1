// Runs a translated shader over invocations made by the test.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "cpu_shaders/runtime/shader_abi.h"

namespace twinshade {

struct Invocations {
  std::uint32_t count = 64;  // multiple of 16
  // Value of a component of an input: (name, component, invocation); integers as they are.
  std::function<double(const std::string&, std::uint32_t, std::uint32_t)> input;
  std::function<bool(std::uint32_t)> live = [](std::uint32_t) { return true; };
  std::map<std::string, std::vector<float>> uniforms;     // packed values; integers by value
  std::map<std::string, std::vector<std::byte>> buffers;  // written to by shaders that write
  struct Image {
    std::int32_t width, height, layers;
    std::vector<float> texels;
    TextureKind kind = TextureKind::two_d;
  };
  std::map<std::string, Image> textures;
};

struct Answer {
  std::map<std::string, std::vector<std::vector<double>>> outputs;  // by name, component, invocation; integers by value
  std::vector<double> depth;
  std::vector<bool> kept;
};

// Fails (doctest) if the module lacks the number, an input, a uniform or a resource.
Answer run_shader(const ShaderModule& module, const ShaderEntry* entries, std::uint32_t entry_count, Number number,
                  Invocations& invocations);

const char* number_name(Number number);

// x = column, y = row of an invocation, blocks of quads eight pixels wide.
std::uint32_t pixel_x(std::uint32_t invocation);
std::uint32_t pixel_y(std::uint32_t invocation);

}  // namespace twinshade
