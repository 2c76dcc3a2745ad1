// An entry of a manifest, ready to be drawn, and its image.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/golden/drawing.h"
#include "app/golden/report.h"
#include "app/machines.h"
#include "app/output.h"
#include "app/subject.h"

namespace twinshade {

struct GoldenScene {
  Subject subject;
  Shading shading;
  std::string shader_file;           // of a user's shader, else empty
  std::vector<FrameOutput> outputs;  // by location; a frame holds one
  std::string bundle_hash, shader_hash;
  std::vector<std::string> files;  // that all of it was read from
};

// Loads, lights and bakes what one entry is drawn from: alone, so that it does not depend on which others there are.
// inputs: as load_subject takes them. UserError where that cannot be done.
GoldenScene load_golden_scene(const GoldenDrawing& drawing, const std::string& folder, const CommonOptions& common,
                              const Output& output, Machines& machines, LastLitScene& last);

// The output that an entry's frame is of. UserError where the shader has it no more.
FrameOutput find_output(const GoldenScene& scene, const GoldenEntry& entry);

// Of an Output that writes nothing: for what entries have in common, which is said once.
CommonOptions without_results(CommonOptions options);

// UserError where the name of a manifest's folder is empty, or that of the manifest itself.
void require_folder_name(const std::string& folder);

// UserError, saying how to make one, where a folder has no manifest.
void require_manifest(const std::string& folder);

// An entry's image, or why there is none.
struct GoldenImage {
  std::optional<Frame> frame;
  GoldenResult trouble = GoldenResult::same;  // no_image, damaged
  std::string reason;
  std::string other_frame;  // hash of what is there instead, where that can be read; else empty
};
GoldenImage read_golden_image(const std::string& folder, const GoldenEntry& entry);

// Holds a frame to the entry's image and fills in what the row says of their differences. ulp: what is let pass.
// inputs: the frame again with its attributes captured, to name the shader's inputs; asked for where it helps, and may
// be without.
void hold_to_image(GoldenRow& row, const Frame& image, const Frame& frame, std::uint64_t ulp,
                   const std::function<Frame()>& inputs);

// Whether a name is like a pattern: * is any text, ? any character.
bool is_like(const std::string& name, const std::string& pattern);

// The entries whose names are like `only`, all of them for an empty one. UserError where there are none and one is
// `required`.
std::vector<GoldenEntry> chosen_entries(const GoldenManifest& manifest, const std::string& only, bool required = true);

}  // namespace twinshade
