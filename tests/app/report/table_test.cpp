#include "app/report/table.h"

#include <doctest/doctest.h>

namespace twinshade {

TEST_CASE("columns are aligned, numbers to the right, and lines end without blanks") {
  Table table;
  table.column("name");
  table.column("count", Table::Align::right);
  table.column("note");
  table.row({"a", "1", "first"});
  table.row({"longer", "12345678"});
  CHECK(table.text() ==
        "name       count  note\n"
        "a              1  first\n"
        "longer  12345678\n");
}

TEST_CASE("columns are as wide as their characters, whatever bytes these take") {
  Table table;
  table.column("shader");
  table.column("n", Table::Align::right);
  table.row(
      {"gr\xc3\xb6\xc3\x9f"
       "e.frag",
       "1"});
  table.row({"plain.frag", "2"});
  CHECK(table.text() ==
        "shader      n\n"
        "gr\xc3\xb6\xc3\x9f"
        "e.frag  1\n"
        "plain.frag  2\n");
}

TEST_CASE("rows of a table that are written as they come have columns as wide as was said") {
  Table table;
  table.column("name", Table::Align::left, 6);
  table.column("n", Table::Align::right, 3);
  table.column("note");
  CHECK(table.headings() == "name      n  note\n");
  CHECK(table.line({"a", "1", "first"}) == "a         1  first\n");
  CHECK(table.line({"longest", "1234", "moved"}) == "longest  1234  moved\n");
}

}  // namespace twinshade
