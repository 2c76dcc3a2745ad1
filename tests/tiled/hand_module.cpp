#include "tests/tiled/hand_module.h"

#include <atomic>
#include <chrono>
#include <cstring>
#include <mutex>
#include <set>
#include <thread>

namespace twinshade::test {
namespace {

template <class R>
const R* component(const void* array, const ShadeCall& call, std::uint32_t c) {
  return static_cast<const R*>(array) + std::size_t(c) * call.stride;
}
template <class R>
R* component(void* array, const ShadeCall& call, std::uint32_t c) {
  return static_cast<R*>(array) + std::size_t(c) * call.stride;
}

template <class R>
void echo(const ShaderData&, const ShadeCall& call) {
  for (std::uint32_t c = 0; c < 4; ++c)
    for (std::uint32_t i = 0; i < call.count; ++i)
      component<R>(call.outputs, call, c)[i] = component<R>(call.inputs, call, c)[i];
  std::memcpy(call.kept, call.live, call.count * sizeof(std::uint32_t));
}

float key_of(float bits) {
  std::uint32_t key;
  std::memcpy(&key, &bits, sizeof key);
  return float(key);
}
double key_of(double value) { return value; }

template <class R>
void built_ins(const ShaderData&, const ShadeCall& call) {
  for (std::uint32_t i = 0; i < call.count; ++i) {
    component<R>(call.outputs, call, 0)[i] = R(call.primitive_id[i]);
    component<R>(call.outputs, call, 1)[i] = R(key_of(component<R>(call.inputs, call, 4)[i]));
    component<R>(call.outputs, call, 2)[i] = R(call.front_facing[i] ? 1 : 0);
    component<R>(call.outputs, call, 3)[i] = component<R>(call.frag_coord, call, 3)[i];
    call.kept[i] = call.live[i];
  }
}

template <class R>
void exact_values(const ShaderData&, const ShadeCall& call) {
  for (std::uint32_t i = 0; i < call.count; ++i) {
    component<R>(call.outputs, call, 0)[i] = component<R>(call.inputs, call, 0)[i];
    component<R>(call.outputs, call, 1)[i] = component<R>(call.frag_coord, call, 2)[i];
    component<R>(call.outputs, call, 2)[i] = component<R>(call.frag_coord, call, 3)[i];
    component<R>(call.outputs, call, 3)[i] = R(call.front_facing[i] ? 1 : 0);
    call.kept[i] = call.live[i];
  }
}

template <class R>
void discarding(const ShaderData& data, const ShadeCall& call) {
  echo<R>(data, call);
  for (std::uint32_t i = 0; i < call.count; ++i)
    if (component<R>(call.inputs, call, 0)[i] < R(0.5)) call.kept[i] = 0;
}

template <class R>
void writing_depth(const ShaderData& data, const ShadeCall& call) {
  echo<R>(data, call);
  for (std::uint32_t i = 0; i < call.count; ++i)
    static_cast<R*>(call.frag_depth)[i] = component<R>(call.inputs, call, 1)[i];
}

template <class R>
void differencing(const ShaderData&, const ShadeCall& call) {
  const R* x = component<R>(call.inputs, call, 0);
  for (std::uint32_t i = 0; i < call.count; ++i) {
    component<R>(call.outputs, call, 0)[i] = x[i | 1u] - x[i & ~1u];
    component<R>(call.outputs, call, 1)[i] = x[i | 2u] - x[i & ~2u];
    component<R>(call.outputs, call, 2)[i] = x[i];
    component<R>(call.outputs, call, 3)[i] = component<R>(call.inputs, call, 1)[i];
    call.kept[i] = call.live[i];
  }
}

template <class R>
void counting_helpers(const ShaderData& data, const ShadeCall& call) {
  echo<R>(data, call);
  std::uint32_t helpers = 0;
  for (std::uint32_t i = 0; i < call.count; ++i) helpers += call.live[i] == 0;
  for (std::uint32_t i = 0; i < call.count; ++i) component<R>(call.outputs, call, 3)[i] = R(helpers);
}

template <class R>
void counting(const ShaderData& data, const ShadeCall& call) {
  std::uint32_t count;
  std::memcpy(&count, data.buffers[0].bytes, sizeof count);
  for (std::uint32_t i = 0; i < call.count; ++i) {
    for (std::uint32_t c = 0; c < 4; ++c) component<R>(call.outputs, call, c)[i] = R(count);
    if (call.live[i]) ++count;
    call.kept[i] = call.live[i];
  }
  std::memcpy(data.buffers[0].bytes, &count, sizeof count);
}

struct Meeting {
  std::mutex mutex;
  std::set<std::thread::id> came;
  std::atomic<int> count{0};
  int wanted = 0;
  std::chrono::steady_clock::time_point until;
};
Meeting meeting;

template <class R>
void meet(const ShaderData& data, const ShadeCall& call) {
  {
    const std::lock_guard lock(meeting.mutex);
    meeting.came.insert(std::this_thread::get_id());
    meeting.count = int(meeting.came.size());
  }
  while (meeting.count < meeting.wanted && std::chrono::steady_clock::now() < meeting.until) std::this_thread::yield();
  echo<R>(data, call);
}

constexpr ShaderVariable kInputs[] = {{"v_value", Scalar::f32, 1, 4, 0, false, false, -1, 0},
                                      {"v_key", Scalar::u32, 1, 1, 0, true, false, -1, 4}};
constexpr ShaderVariable kOutput[] = {{"color", Scalar::f32, 1, 4, 0, false, false, 0, 0}};
constexpr ShaderResource kCounter[] = {{"counter", ResourceKind::storage_buffer, 0, 4, false}};

// A module and the entries it points at.
struct Owned {
  std::vector<ShaderEntry> entries;
  ShaderModule module{};

  Owned(const char* name, ShadeFunction for_float, ShadeFunction for_double)
      : entries(entries_of(for_float, for_double)) {
    module.abi_version = kAbiVersion;
    module.name = name;
    module.source_hash = "by hand";
    module.inputs = kInputs;
    module.input_count = 1;
    module.input_components = 4;
    module.outputs = kOutput;
    module.output_count = 1;
    module.output_components = 4;
    module.entries = entries.data();
    module.entry_count = std::uint32_t(entries.size());
  }
};

}  // namespace

std::vector<ShaderEntry> entries_of(ShadeFunction for_float, ShadeFunction for_double) {
  return {{Isa::baseline, Number::lanes4, for_float},   {Isa::baseline, Number::lanes8, for_float},
          {Isa::baseline, Number::lanes16, for_float},  {Isa::baseline, Number::scalar, for_float},
          {Isa::baseline, Number::float64, for_double}, {Isa::avx2, Number::lanes8, for_float},
          {Isa::avx512, Number::lanes16, for_float}};
}

const ShaderModule& echo_module() {
  static const Owned owned("echo", echo<float>, echo<double>);
  return owned.module;
}

const ShaderModule& built_ins_module() {
  static const Owned owned = [] {
    Owned o("built_ins", built_ins<float>, built_ins<double>);
    o.module.input_count = 2;
    o.module.input_components = 5;
    o.module.uses_frag_coord = o.module.uses_front_facing = o.module.uses_primitive_id = true;
    return o;
  }();
  return owned.module;
}

const ShaderModule& exact_values_module() {
  static const Owned owned = [] {
    Owned o("exact_values", exact_values<float>, exact_values<double>);
    o.module.uses_frag_coord = o.module.uses_front_facing = true;
    return o;
  }();
  return owned.module;
}

const ShaderModule& discard_module() {
  static const Owned owned = [] {
    Owned o("discard", discarding<float>, discarding<double>);
    o.module.discards = true;
    return o;
  }();
  return owned.module;
}

const ShaderModule& frag_depth_module() {
  static const Owned owned = [] {
    Owned o("frag_depth", writing_depth<float>, writing_depth<double>);
    o.module.writes_depth = true;
    return o;
  }();
  return owned.module;
}

const ShaderModule& derivatives_module() {
  static const Owned owned = [] {
    Owned o("derivatives", differencing<float>, differencing<double>);
    o.module.uses_derivatives = true;
    return o;
  }();
  return owned.module;
}

const ShaderModule& helpers_module() {
  static const Owned owned("helpers", counting_helpers<float>, counting_helpers<double>);
  return owned.module;
}

const ShaderModule& side_effect_module() {
  static const Owned owned = [] {
    Owned o("side_effect", counting<float>, counting<double>);
    o.module.has_side_effects = true;
    o.module.resources = kCounter;
    o.module.resource_count = 1;
    o.module.buffer_count = 1;
    return o;
  }();
  return owned.module;
}

const ShaderModule& meeting_module(int threads) {
  static const Owned owned("meeting", meet<float>, meet<double>);
  meeting.came.clear();
  meeting.count = 0;
  meeting.wanted = threads;
  meeting.until = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  return owned.module;
}

}  // namespace twinshade::test
