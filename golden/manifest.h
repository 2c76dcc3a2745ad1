// The manifest of a folder of golden images: golden.json, made for version control. Beside it NAME.exr for each entry.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace twinshade {

// What an entry is drawn by: options of the command line without their dashes, and "scene"; each with what it was
// given. Paths are relative to the manifest's folder.
using GoldenDrawing = std::vector<std::pair<std::string, std::vector<std::string>>>;

struct GoldenEntry {
  std::string name;  // of letters, digits and ._+-, not beginning with a point or a dash
  GoldenDrawing drawing;
  std::string output;  // that the frame is of, where the shader has several; else empty
  std::uint32_t width = 0, height = 0;
  // SHA-256: of the frame, of what it was drawn from (content_hashes.h).
  std::string frame, bundle, shader;
};

struct GoldenManifest {
  std::string folder;
  std::vector<GoldenEntry> entries;  // by name, each once

  GoldenEntry* find(const std::string& name);
  // Adds it, or replaces the one of that name.
  void put(GoldenEntry entry);
};

inline constexpr const char* kManifestName = "golden.json";
std::string manifest_path(const std::string& folder);
std::string golden_image_path(const std::string& folder, const std::string& name);

bool is_golden_name(const std::string& name);
// Characters that a name cannot have become _.
std::string golden_name(const std::string& wanted);

// Images in the manifest's folder that belong to no entry, as after a merge that lost one: paths, sorted.
std::vector<std::string> stray_images(const GoldenManifest& manifest);

// UserError naming file and entry: missing, no JSON, of another version, not as write_manifest makes it, a
// key that one object has twice.
GoldenManifest read_manifest(const std::string& folder);
// The same manifest is the same bytes: sorted by name, a line for each value. UserError where it cannot be written.
void write_manifest(const GoldenManifest& manifest);

}  // namespace twinshade
