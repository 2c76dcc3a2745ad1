#include "app/choice_search.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"

namespace twinshade {
namespace {

std::vector<std::string> distinct(const std::set<std::pair<std::string, std::string>>& keys,
                                  std::string std::pair<std::string, std::string>::*member) {
  std::set<std::string> names;
  for (const auto& key : keys)
    if (!(key.*member).empty()) names.insert(key.*member);
  return {names.begin(), names.end()};
}

// What is tried at the next smaller size: errors do not rise at every step, so that what was within it at the size
// before gets another try.
template <class Keys>
Keys to_try_next(const Keys& within, const Keys& before) {
  Keys keys = within;
  keys.insert(before.begin(), before.end());
  return keys;
}

// What is tried after `at`; false where there is nothing smaller.
bool halve(SubjectOptions& at, CoefficientStorage place) {
  const SubjectOptions before = at;
  if (place == CoefficientStorage::lightmap) at.lightmap_size = std::max(1u, at.lightmap_size / 2);
  if (place == CoefficientStorage::volume) at.volume = (at.volume + 1) / 2;
  return at.lightmap_size != before.lightmap_size || at.volume != before.volume;
}

}  // namespace

std::string Choice::size() const {
  if (lightmap > 0) return std::to_string(lightmap);
  if (volume.x > 0) return fmt::format("{}x{}x{}", volume.x, volume.y, volume.z);
  return "-";
}

ChoiceSearch::ChoiceSearch(const LitScene& lit, const SubjectOptions& subject, const ShadingOptions& shading,
                           const CommonOptions& common, const CpuOptions& cpu, const Truths& truths,
                           const Output& output)
    : lit_(lit),
      subject_(subject),
      shading_(shading),
      common_(common),
      truths_(truths),
      output_(output),
      machines_(cpu, true),
      bundle_(make_bundle(lit.scene, std::span<const LightBake>(), std::vector<LitTechnique>(),
                          frame_options(subject, lit.scene))) {}

SearchResult ChoiceSearch::run(const std::vector<LitTechnique>& wanted, const SearchOptions& options) {
  options_ = options;
  result_ = {};
  for (const CoefficientStorage place :
       {CoefficientStorage::lightmap, CoefficientStorage::vertex, CoefficientStorage::volume}) {
    std::vector<std::string> names;
    for (const LitTechnique& lit : wanted)
      if (lit.storage == place) names.emplace_back(lit.technique->name);
    if (!names.empty()) search_place(place, names);
  }
  return std::move(result_);
}

void ChoiceSearch::search_place(CoefficientStorage place, const std::vector<std::string>& techniques) {
  best_.clear();
  std::set<Key> keys;
  for (const std::string& name : techniques) {
    if (!reads_sphere_map(find_technique(name)))
      keys.insert({name, ""});
    else
      for (const SphereMapInfo* map : chosen_maps(shading_)) keys.insert({name, std::string(map->name)});
  }
  SubjectOptions at = subject_;
  std::set<Key> before;
  do {
    std::set<Key> within = try_size(place, at, keys);
    keys = to_try_next(within, before);
    before = std::move(within);
  } while (!keys.empty() && halve(at, place));
  try_storages();
  for (Best& best : best_) {
    result_.best.push_back(std::move(best.choice));
    result_.lights.push_back(std::move(best.light));
  }
}

std::set<ChoiceSearch::Key> ChoiceSearch::try_size(CoefficientStorage place, const SubjectOptions& at,
                                                   const std::set<Key>& keys) {
  const std::set<Key> within = try_width(place, at, keys);
  std::set<Key> left = within, before = within;
  SubjectOptions narrower = at;
  for (;;) {
    std::erase_if(left, [&](const Key& key) {
      if (key.second.empty()) return true;
      const int width = table_width(find_sphere_map(key.second), narrower.visibility);
      return SphereMapInfo::half(width) == width;
    });
    if (left.empty()) return within;
    ++narrower.visibility.map_halvings;
    std::set<Key> still = try_width(place, narrower, left);
    left = to_try_next(still, before);
    before = std::move(still);
  }
}

std::set<ChoiceSearch::Key> ChoiceSearch::try_width(CoefficientStorage place, const SubjectOptions& at,
                                                    const std::set<Key>& keys) {
  ShadingOptions shading = shading_;
  shading.light = LightSource(1 + int(place));
  shading.techniques = distinct(keys, &Key::first);
  if (const std::vector<std::string> maps = distinct(keys, &Key::second); !maps.empty()) shading.maps = maps;
  Choice shape;
  shape.place = place;
  shape.storage = options_.storages.front();
  if (place == CoefficientStorage::lightmap) shape.lightmap = at.lightmap_size;
  if (place == CoefficientStorage::volume) shape.volume = at.volume;
  output_.progress(fmt::format("baking {} techniques for {} {}", shading.techniques.size(), storage_name(place),
                               place == CoefficientStorage::vertex ? "light" : shape.size()));
  SubjectOptions bare = at;  // materials are drawn from bundle_
  bare.albedo = bare.normal_map = false;
  const Subject subject = light_subject(lit_, bare, shading, common_, output_);
  std::set<Key> within;
  for (Shading& shader : load_shadings(shading, subject)) {
    const Key key{shader.technique, shader.map};
    if (!keys.contains(key)) continue;
    Choice choice = shape;
    choice.technique = &find_technique(shader.technique);
    const SphereMapInfo* map = shader.map.empty() ? nullptr : &find_sphere_map(shader.map);
    if (map) choice.map_width = table_width(*map, at.visibility);
    choice.shading = std::move(shader);
    StoredLight light = stored_light(subject.bundle, {choice.technique, place}, map);
    if (!measure(choice, light)) continue;
    within.insert(key);
    keep(choice, std::move(light));
  }
  return within;
}

// Whether it is within the error.
bool ChoiceSearch::measure(Choice& choice, const StoredLight& light) {
  output_.progress(fmt::format("{} {} {}", choice.shading.label(), choice.size(), texel_storage_name(choice.storage)));
  choice.bytes = light.bytes(choice.storage);
  const Bundle& bundle = choice.storage == TexelStorage::float32
                             ? bundle_.lit_by(light)
                             : bundle_.lit_by(through_storage(light, choice.storage));
  const Frame frame = machines_.draw("cpu", bundle, choice.shading.source, DrawOptions());
  choice.error = frame_error(frame, truths_.of(*choice.technique));
  result_.tried.push_back(choice);
  result_.tried.back().shading.source = {};       // long
  return choice.error.rms <= options_.max_error;  // not where it is NaN
}

void ChoiceSearch::keep(const Choice& choice, StoredLight light) {
  for (Best& best : best_)
    if (best.choice.shading.technique == choice.shading.technique && best.choice.shading.map == choice.shading.map) {
      if (choice.bytes < best.choice.bytes) best = {choice, std::move(light)};
      return;
    }
  best_.push_back({choice, std::move(light)});
}

// The smallest first: where that is within the error, the others are larger.
void ChoiceSearch::try_storages() {
  for (Best& best : best_)
    for (auto storage = options_.storages.rbegin(); storage != options_.storages.rend(); ++storage) {
      Choice choice = best.choice;
      choice.storage = *storage;
      if (best.light.bytes(*storage) < best.choice.bytes && measure(choice, best.light)) best.choice = choice;
    }
}

}  // namespace twinshade
