// What a golden image is drawn by: from the command line to the manifest, and back.
#pragma once

#include <string>
#include <vector>

#include "app/options.h"
#include "app/subject.h"
#include "golden/manifest.h"

namespace twinshade {

struct DrawingOptions {
  CommonOptions common;  // the seed
  SubjectOptions subject;
  ShadingOptions shading;
};

// The options that an entry keeps, but for --seed, which every verb has.
void add_drawing_options(CLI::App& command, DrawingOptions& options);

// Those of them, and --seed, that were given to a parsed command. UserError where a path is no UTF-8.
GoldenDrawing given_drawing(const CLI::App& command, const std::string& folder);

// The user's shader that is drawn with, as seen from the current folder; empty where there is none.
std::string shader_path(const GoldenDrawing& drawing, const std::string& folder);

// UserError where the options are not known or not valid.
DrawingOptions parse_drawing(const GoldenDrawing& drawing, const std::string& folder);

// The drawings of single frames that one with several techniques, maps or places of light stands for. UserError where a
// technique or a map is not known.
std::vector<GoldenDrawing> single_drawings(const GoldenDrawing& drawing, const ShadingOptions& shading);

// Whether two are drawn by the same options, in whatever order.
bool same_drawing(GoldenDrawing a, GoldenDrawing b);

}  // namespace twinshade
