// The GLSL about a line, for tables.
#pragma once

#include <string>

#include "cpu_shaders/translate/source_lines.h"

namespace twinshade {

// The lines of the statement that a line is part of, as one, without comments at their ends, and cut off after 100
// characters. file: as #line names it. Statements end with ; { or }: what is between the parentheses of a for is one
// more.
std::string statement_text(const SourceLines& lines, const std::string& file, int line);

}  // namespace twinshade
