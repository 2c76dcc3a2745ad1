// Runs a compute shader on the CPU.
#pragma once

#include <array>
#include <cstdint>

#include "cpu_shaders/runtime/shader_abi.h"

namespace twinshade {

// Runs groups[0] x groups[1] x groups[2] work groups of a compute module, one after another on the calling thread, x
// fastest; within a group, blocks of as many invocations as the number type has lanes, in order, each up to the next
// barrier(). So the result is the same every time, and of an order that OpenGL does not promise. Denormals are kept, as
// llvmpipe keeps them in compute shaders. Storage buffers are written through data.buffers.
// UserError where the module is no compute shader or has no code for `number`.
void run_compute(const ShaderModule& module, Number number, const ShaderData& data,
                 const std::array<std::uint32_t, 3>& groups);

}  // namespace twinshade
