#include "app/table.h"

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

}  // namespace twinshade
