// Shader modules made by hand: what the renderer hands to a shader comes out as colour, for every number type.
#pragma once

#include <string>
#include <vector>

#include "cpu_shaders/runtime/shader_abi.h"

namespace twinshade::test {

// Entries of every instruction set and number, all served by the same two functions.
std::vector<ShaderEntry> entries_of(ShadeFunction for_float, ShadeFunction for_double);

// in vec4 v_value (smooth); out vec4: v_value. The simplest opaque shader.
const ShaderModule& echo_module();

// in vec4 v_value; in flat uint v_key; out vec4 (gl_PrimitiveID, v_key, front facing, gl_FragCoord.w); reads all
// built-ins.
const ShaderModule& built_ins_module();

// in vec4 v_value; out vec4 (v_value.x, gl_FragCoord.z, gl_FragCoord.w, front facing).
const ShaderModule& exact_values_module();

// in vec4 v_value; discards where v_value.x < 0.5; out v_value.
const ShaderModule& discard_module();

// in vec4 v_value; writes gl_FragDepth = v_value.y; out v_value.
const ShaderModule& frag_depth_module();

// in vec4 v_value; out vec4 (v_value.x of the quad's right pixel less the left one's in the own row, the same of the
// upper and the lower one, v_value.xy): shaded in whole quads.
const ShaderModule& derivatives_module();

// in vec4 v_value; out vec4 (v_value.xyz, how many of the call's invocations were helpers).
const ShaderModule& helpers_module();

// in vec4 v_value; counts in a storage buffer "counter" the live invocations it ran; out vec4(count before the quad).
const ShaderModule& side_effect_module();

// As echo, but no call returns before `threads` threads have come, or twenty seconds have passed.
const ShaderModule& meeting_module(int threads);

}  // namespace twinshade::test
