// Rows of an experiment or a benchmark, written out: as a table, as JSON, and with pictures into a folder.
#pragma once

#include <string>
#include <vector>

#include "app/output.h"
#include "experiments/experiment.h"

namespace twinshade {

Json json_rows(const Rows& rows);
// Columns whose first cell is text are aligned to the left.
std::string table_text(const Rows& rows);
// The files that pictures of this name may become.
std::vector<std::string> picture_files(const std::string& name);
// Drawings as SVG and PNG, images as EXR.
void write_pictures(const std::string& folder, const std::vector<Picture>& pictures, const Output& output);

}  // namespace twinshade
