// Rows on the CPU: the translated shader called through its binary interface, without a rasterizer.
#pragma once

#include "cpu_shaders/runtime/shader_abi.h"
#include "evaluate/bind_table.h"

namespace twinshade {

struct CpuRows {
  // [component * rows + row], components in the order of ShaderModule::outputs, then gl_FragDepth where it is written.
  std::vector<std::uint32_t> bits;
  std::vector<double> doubles;     // Number::float64 only; bits then hold the values rounded to float
  std::vector<std::uint8_t> kept;  // by row
};

// Denormals are flushed as the renderers do, unless they are to be kept; float64 keeps them. UserError for a texture or
// buffer that is missing.
CpuRows run_cpu_rows(const ShaderModule& module, const ShaderEntry& entry, const BoundRows& rows,
                     bool keep_denormals = false);

}  // namespace twinshade
