// Which functions of a shader the runtime serves by equivalents of its own: those of shaders/exact/ in
// runtime/served_names.h.
#pragma once

#include "cpu_shaders/runtime/shader_abi.h"
#include "cpu_shaders/translate/function_info.h"

namespace twinshade::spirv {

bool is_served(const Module& module, const Function& function);

// exact_fetch_colors and sphere_map_fetch_colors, which alone read maps whose colours lie together.
bool fetches_colors(const Module& module, const Function& function);
// Those and exact_fetch_layers: functions that fill their last parameter, an array.
bool fetches_all(const Module& module, const Function& function);

// Functions of numbers alone are served in double: their bit casts never run there.
bool is_served_in_double(const Module& module, const Function& function);

// Pairs of sampler variables that are fetched together, the first by its second. A variable is in one pair at most.
std::map<Id, Id> samplers_side_by_side(const Program& program);

// How the layers of sampler variables should lie, where not apart: of which several are fetched at once, by a served
// function of that kind. Only those that nothing else fetches from have their colours together.
std::map<Id, LayerOrder> layer_orders(const Program& program);

// Of which sampler variables only the first layers are read, and how many: by exact_fetch_layers alone.
std::map<Id, std::uint32_t> layers_read(const Program& program);

}  // namespace twinshade::spirv
