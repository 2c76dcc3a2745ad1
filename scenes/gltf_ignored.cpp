#include "scenes/gltf_ignored.h"

#include <algorithm>
#include <array>
#include <cctype>

namespace twinshade {
namespace {

// Those that are drawn, and those that change no picture as the file leaves it.
constexpr std::array kDrawn = {
    "KHR_texture_transform",           "KHR_mesh_quantization", "KHR_materials_pbrSpecularGlossiness",
    "EXT_mesh_gpu_instancing",
    "KHR_materials_emissive_strength",  // said with the light that materials give
    "KHR_materials_variants",          "KHR_xmp_json_ld"};

constexpr std::size_t kMostNames = 8, kLongestName = 60;

// As in a message: names in a damaged file may be anything.
std::string shown_extension(std::string name) {
  name = name.substr(0, kLongestName);
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '_') c = '?';
  return name;
}

}  // namespace

void note_ignored_parts(const GltfDocument& document, std::set<std::string>& notes) {
  std::set<std::string> extensions;
  for (std::size_t i = 0; i < document.count("extensionsUsed"); ++i) {
    const auto name = document.element("extensionsUsed", i).get<std::string>();
    if (std::find(kDrawn.begin(), kDrawn.end(), name) == kDrawn.end()) extensions.insert(shown_extension(name));
  }
  std::string list;
  std::size_t count = 0;
  for (const std::string& name : extensions)
    if (count++ < kMostNames) list += (list.empty() ? "" : ", ") + name;
  if (count > kMostNames) list += " and " + std::to_string(count - kMostNames) + " more";
  if (count > 0) notes.insert("what these extensions say is ignored: " + list);
  if (document.count("animations") > 0) notes.insert("animations are ignored: the model is drawn at rest");
  if (document.count("scenes") > 1)
    notes.insert("of its " + std::to_string(document.count("scenes")) + " scenes, scene " +
                 std::to_string(document.default_scene()) + " is drawn");
}

}  // namespace twinshade
