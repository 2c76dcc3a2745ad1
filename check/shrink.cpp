#include "check/shrink.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <set>
#include <tuple>

#include "golden/compare_frames.h"

namespace twinshade {
namespace {

constexpr int kMostRounds = 16;
// Groups with other uniforms than the current ones: each is a run of its own on either machine.
constexpr std::size_t kMostUniformRuns = 384;

// One scalar of a table.
struct Slot {
  bool uniform = false;
  std::size_t variable = 0, index = 0;
};

struct Change {
  Slot slot;
  std::uint32_t bits = 0;
  int gain = 0;
};
using Changes = std::vector<Change>;  // made together

Values& variable_at(ValueTable& table, const Slot& slot) {
  return slot.uniform ? table.uniforms[slot.variable] : table.inputs[slot.variable];
}

std::vector<std::uint32_t> simpler_values(Scalar scalar, std::uint32_t bits) {
  if (scalar == Scalar::i32) {
    const auto value = std::int32_t(bits);
    return {0u, 1u, std::uint32_t(value / 2), std::uint32_t(value - (value > 0 ? 1 : value < 0 ? -1 : 0))};
  }
  if (scalar != Scalar::f32) return {0u, 1u, bits / 2, bits - (bits > 0 ? 1 : 0)};
  std::vector<std::uint32_t> values;
  const auto value = std::bit_cast<float>(bits);
  for (const float simple : {0.0f, 1.0f, 2.0f, 0.5f, 3.0f, -1.0f, -value, std::trunc(value), std::round(value)})
    values.push_back(std::bit_cast<std::uint32_t>(simple));
  for (const int kept : {0, 1, 2, 3, 4, 6, 8, 10, 12, 15, 18, 20, 22})  // bits of the fraction
    values.push_back(bits & ~((1u << (23 - kept)) - 1u));
  return values;
}

bool allowed(const InputRange* range, const ValueType& type, std::size_t index, std::uint32_t bits) {
  if (range == nullptr) return true;
  const double value = value_of(type.scalar, bits);
  const auto held = [&](double end) { return type.scalar == Scalar::f32 ? double(float(end)) : end; };  // as generated
  switch (range->kind) {
    case InputRange::Kind::unit:
      return false;
    case InputRange::Kind::list:
      return std::any_of(range->values.begin(), range->values.end(), [&](double v) { return held(v) == value; });
    case InputRange::Kind::interval: {
      const auto& [low, high] = range->intervals[range->intervals.size() == 1 ? 0 : index % type.rows];
      return value >= held(low) && value <= held(high);
    }
    default:
      return true;
  }
}

class Shrinker {
 public:
  Shrinker(const ValueTable& failing, const std::vector<InputRange>& ranges, const Differs& differs)
      : current_(failing), ranges_(ranges), differs_(differs) {
    for (const bool uniform : {false, true}) {
      const std::vector<Values>& list = uniform ? failing.uniforms : failing.inputs;
      for (std::size_t v = 0; v < list.size(); ++v)
        for (std::size_t i = 0; i < list[v].bits.size(); ++i) slots_.push_back({uniform, v, i});
    }
  }

  ValueTable run() {
    uniforms_to_zero();
    for (int round = 0; round < kMostRounds && step(); ++round) {
    }
    return current_;
  }

 private:
  // Most uniforms do not matter, arrays of them above all: many become zero at a time, halves where that hides the
  // difference.
  void uniforms_to_zero() {
    Changes all;
    for (const Slot& slot : slots_) {
      if (!slot.uniform) continue;
      const Values& values = variable_at(current_, slot);
      const int gain = complexity(values.type.scalar, values.bits[slot.index]);
      if (gain > 0 && slot.index < values.type.components() &&
          allowed(find_range(ranges_, values.name), values.type, slot.index, 0))
        all.push_back({slot, 0, gain});
    }
    std::vector<Changes> pieces;
    if (!all.empty()) pieces.push_back(std::move(all));
    while (!pieces.empty() && uniform_runs_ + pieces.size() <= kMostUniformRuns) {
      const std::vector<bool> alone = works(pieces);
      Changes good;
      std::vector<Changes> rest;
      for (std::size_t k = 0; k < pieces.size(); ++k) {
        const auto begin = pieces[k].begin(), middle = begin + std::ptrdiff_t(pieces[k].size() / 2);
        if (alone[k]) {
          good.insert(good.end(), begin, pieces[k].end());
        } else if (pieces[k].size() > 1) {
          rest.emplace_back(begin, middle);
          rest.emplace_back(middle, pieces[k].end());
        }
      }
      const std::size_t taken = good.empty() ? 0 : take_most(good);
      if (taken > 0 && taken < good.size()) rest.emplace_back(good.begin() + std::ptrdiff_t(taken), good.end());
      pieces = std::move(rest);
    }
  }

  // Those of uniforms that have failed are not tried again.
  std::vector<Changes> changes() {
    Changes of_inputs, of_uniforms;
    for (const Slot& slot : slots_) {
      const Values& values = variable_at(current_, slot);
      const Scalar scalar = values.type.scalar;
      const std::uint32_t bits = values.bits[slot.index];
      const InputRange* range = find_range(ranges_, values.name);
      if (slot.uniform && slot.index >= values.type.components()) continue;  // the rows of a quad have the same
      for (const std::uint32_t simpler : simpler_values(scalar, bits)) {
        const int gain = complexity(scalar, bits) - complexity(scalar, simpler);
        if (gain <= 0 || !allowed(range, values.type, slot.index, simpler)) continue;
        if (!slot.uniform)
          of_inputs.push_back({slot, simpler, gain});
        else if (tried_.insert({slot.variable, slot.index, simpler}).second)
          of_uniforms.push_back({slot, simpler, gain});
      }
    }
    const std::size_t left = kMostUniformRuns - std::min(kMostUniformRuns, uniform_runs_);
    if (of_uniforms.size() > left) {
      std::stable_sort(of_uniforms.begin(), of_uniforms.end(), by_gain);
      of_uniforms.resize(left);
    }
    std::vector<Changes> single;
    for (const Changes* list : {&of_inputs, &of_uniforms})
      for (const Change& change : *list) single.push_back({change});
    return single;
  }

  static bool by_gain(const Change& a, const Change& b) { return a.gain > b.gain; }

  // Copies of the current rows one behind another, each with some changes.
  ValueTable candidates(const std::vector<Changes>& lists) {
    ValueTable table = current_;
    table.rows = current_.rows * lists.size();
    for (const bool uniform : {false, true}) {
      std::vector<Values>& list = uniform ? table.uniforms : table.inputs;
      for (Values& values : list) {
        std::vector<std::uint32_t> row = values.bits;
        if (uniform && values.row_count() == 1) {  // one for all rows until now
          values.bits.clear();
          for (std::size_t r = 0; r < current_.rows; ++r) values.bits.insert(values.bits.end(), row.begin(), row.end());
          row = values.bits;
        }
        values.bits.clear();
        for (std::size_t k = 0; k < lists.size(); ++k) values.bits.insert(values.bits.end(), row.begin(), row.end());
      }
    }
    for (std::size_t k = 0; k < lists.size(); ++k)
      for (const Change& change : lists[k]) write(table, k, change);
    return table;
  }

  // A uniform's value goes to all rows of its group.
  void write(ValueTable& table, std::size_t group, const Change& change) const {
    Values& values = change.slot.uniform ? table.uniforms[change.slot.variable] : table.inputs[change.slot.variable];
    const std::size_t components = values.type.components();
    if (!change.slot.uniform) {
      values.bits[group * current_.rows * components + change.slot.index] = change.bits;
      return;
    }
    for (std::size_t r = 0; r < current_.rows; ++r)
      values.bits[(group * current_.rows + r) * components + change.slot.index % components] = change.bits;
  }

  std::vector<bool> works(const std::vector<Changes>& lists) {
    for (const Changes& list : lists)
      if (std::any_of(list.begin(), list.end(), [](const Change& change) { return change.slot.uniform; }))
        ++uniform_runs_;
    return differs_(candidates(lists));
  }

  // Changes each of which works alone: makes as many of the first of them as work together, by halves where that takes
  // runs. How many those are.
  std::size_t take_most(const Changes& good) {
    const bool dear = std::any_of(good.begin(), good.end(), [](const Change& change) { return change.slot.uniform; });
    std::vector<Changes> together;
    for (std::size_t n = good.size(); n > 0; n = dear ? n / 2 : n - 1)
      together.emplace_back(good.begin(), good.begin() + std::ptrdiff_t(n));
    const std::vector<bool> still = works(together);
    const auto most = std::find(still.begin(), still.end(), true);
    if (most == still.end()) return 0;
    const Changes& taken = together[std::size_t(most - still.begin())];
    for (const Change& change : taken) {
      Values& values = variable_at(current_, change.slot);
      const std::size_t components = values.type.components();
      for (std::size_t i = change.slot.index % components; i < values.bits.size(); i += components)
        if (change.slot.uniform || i == change.slot.index) values.bits[i] = change.bits;
    }
    return taken.size();
  }

  bool step() {
    const std::vector<Changes> single = changes();
    if (single.empty()) return false;
    const std::vector<bool> alone = works(single);

    // The best change of each place that works alone, largest gain first; then as many of them together as work.
    Changes good;
    for (std::size_t k = 0; k < single.size(); ++k) {
      if (!alone[k]) continue;
      const Change& change = single[k][0];
      const auto same_place = std::find_if(good.begin(), good.end(), [&](const Change& g) {
        return g.slot.uniform == change.slot.uniform && g.slot.variable == change.slot.variable &&
               g.slot.index == change.slot.index;
      });
      if (same_place == good.end())
        good.push_back(change);
      else if (change.gain > same_place->gain)
        *same_place = change;
    }
    if (good.empty()) return false;
    std::stable_sort(good.begin(), good.end(), by_gain);
    return take_most(good) > 0;
  }

  ValueTable current_;
  const std::vector<InputRange>& ranges_;
  const Differs& differs_;
  std::vector<Slot> slots_;
  std::size_t uniform_runs_ = 0;
  std::set<std::tuple<std::size_t, std::size_t, std::uint32_t>> tried_;  // variable, index, bits of uniforms
};

}  // namespace

int complexity(Scalar scalar, std::uint32_t bits) {
  if (bits == 0) return 0;
  if (scalar == Scalar::f32 && bits == 0x80000000u) return 1;
  if (scalar == Scalar::i32) {
    const auto value = std::int32_t(bits);
    return (value < 0 ? 1 : 0) + int(std::bit_width(std::uint32_t(std::abs(std::int64_t(value)))));
  }
  if (scalar != Scalar::f32) return int(std::bit_width(bits));
  const int sign = bits >> 31 != 0 ? 1 : 0, exponent = int(bits >> 23 & 255u);
  const std::uint32_t fraction = bits & 0x7fffffu;
  if (exponent == 255) return 3 + sign;
  const int digits = fraction == 0 ? 0 : 23 - std::countr_zero(fraction);
  return 1 + sign + 2 * digits + std::abs(exponent - 127) / 2;
}

ValueTable shrink(const ValueTable& failing, const std::vector<InputRange>& ranges, const Differs& differs) {
  return Shrinker(failing, ranges, differs).run();
}

}  // namespace twinshade
