#include "base/names.h"

#include <doctest/doctest.h>

using namespace twinshade;

TEST_CASE("edit distance counts insertions, deletions, substitutions and neighbouring swaps") {
  CHECK(edit_distance("", "") == 0);
  CHECK(edit_distance("sky", "sky") == 0);
  CHECK(edit_distance("", "abc") == 3);
  CHECK(edit_distance("kitten", "sitting") == 3);
  CHECK(edit_distance("h4", "h6") == 1);
  CHECK(edit_distance("sudtio", "studio") == 2);
  CHECK(edit_distance("skiy", "sky") == 1);
  CHECK(edit_distance("yks", "sky") == edit_distance("sky", "yks"));
}

TEST_CASE("an unknown name is answered with the nearest ones, best first, or with all") {
  const std::vector<std::string> names = {"courtyard", "spheres", "quad", "raster_torture", "raster_invalid"};
  CHECK(unknown_name_message("scene", "courtyrad", names) == "unknown scene 'courtyrad'; did you mean 'courtyard'?");
  CHECK(unknown_name_message("scene", "Spheres", names) == "unknown scene 'Spheres'; did you mean 'spheres'?");
  CHECK(unknown_name_message("scene", "raster", names) ==
        "unknown scene 'raster'; did you mean 'raster_torture' or 'raster_invalid'?");
  CHECK(unknown_name_message("scene", "zzzzzzzz", names) ==
        "unknown scene 'zzzzzzzz'; known: courtyard, spheres, quad, raster_torture, raster_invalid");
  CHECK(unknown_name_message("technique", "h5", {"h4", "h6", "sh2", "sh3"}) ==
        "unknown technique 'h5'; did you mean 'h4' or 'h6'?");
}

TEST_CASE("a name with control characters stays on one line") {
  CHECK(unknown_name_message("scene", "a\nb", {"quad"}) == "unknown scene 'a?b'; known: quad");
}
