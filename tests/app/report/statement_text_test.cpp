// Statements of several lines, in one.
#include <doctest/doctest.h>

#include "app/report/statement_text.h"
#include "cpu_shaders/shader_source.h"

using namespace twinshade;

TEST_CASE("a line is told with the rest of its statement, without comments, cut off where it is long") {
  const ShaderSource source = resolve_shader("s",
                                             "out vec4 c;\nvoid main() {\n  c = vec4(  // a colour\n    1.0,\n    0.5\n"
                                             "  );\n  c.x += 1.0;  // more\n  c.y += " +
                                                 std::string(200, '1') + ".0;\n}\n",
                                             "s.frag");
  const SourceLines lines(source);
  for (const int line : {3, 4, 5, 6}) CHECK(statement_text(lines, "s.frag", line) == "c = vec4( 1.0, 0.5 );");
  CHECK(statement_text(lines, "s.frag", 7) == "c.x += 1.0;");
  const std::string cut = statement_text(lines, "s.frag", 8);
  CHECK(cut.size() == 100);
  CHECK(cut.ends_with("1..."));
  CHECK(statement_text(lines, "s.frag", 2) == "void main() {");
  CHECK(statement_text(lines, "none.frag", 1).empty());
}
