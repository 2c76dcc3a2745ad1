#include "golden/manifest.h"

#include <doctest/doctest.h>

#include "base/error.h"
#include "base/file.h"
#include "tests/scenes/temporary_folder.h"

namespace twinshade {
namespace {

GoldenEntry entry_named(const std::string& name) {
  GoldenEntry entry;
  entry.name = name;
  entry.drawing = {{"scene", {"quad"}}, {"size", {"8x4"}}, {"define", {"A=1", "B"}}};
  entry.width = 8, entry.height = 4;
  entry.frame = std::string(64, 'a'), entry.bundle = std::string(64, 'b'), entry.shader = std::string(64, 'c');
  return entry;
}

}  // namespace

TEST_CASE("a manifest is the same text in whatever order its entries were put, sorted by name") {
  const TemporaryFolder folder;
  std::string first;
  for (const std::vector<const char*>& order : {std::vector{"b", "a", "c"}, std::vector{"c", "b", "a"}}) {
    GoldenManifest manifest;
    manifest.folder = folder.path.string();
    for (const char* name : order) manifest.put(entry_named(name));
    write_manifest(manifest);
    const std::string text = read_file(manifest_path(manifest.folder));
    if (first.empty()) first = text;
    CHECK(text == first);
  }
  CHECK(first.find("\"a\"") < first.find("\"b\""));
  CHECK(first.find("\"b\"") < first.find("\"c\""));
  CHECK(first.back() == '\n');
  const GoldenManifest read = read_manifest(folder.path.string());
  REQUIRE(read.entries.size() == 3);
  const GoldenEntry wanted = entry_named("b"), &entry = read.entries[1];
  CHECK(entry.name == "b");
  CHECK(entry.drawing == wanted.drawing);
  CHECK((entry.width == 8 && entry.height == 4));
  CHECK((entry.frame == wanted.frame && entry.bundle == wanted.bundle && entry.shader == wanted.shader));
  write_manifest(read);
  CHECK(read_file(manifest_path(read.folder)) == first);
}

TEST_CASE("an entry takes the place of the one of its name") {
  GoldenManifest manifest;
  manifest.put(entry_named("a"));
  GoldenEntry other = entry_named("a");
  other.width = 9;
  manifest.put(other);
  REQUIRE(manifest.entries.size() == 1);
  CHECK(manifest.find("a")->width == 9);
  CHECK(manifest.find("b") == nullptr);
}

TEST_CASE("names are those of files that need no quoting and stay in their folder") {
  for (const char* good : {"h4", "courtyard.sh3_volume", "a+b-c_d.e", "9", "_x"})
    CHECK_MESSAGE(is_golden_name(good), good);
  for (const char* bad : {"", ".", "..", ".a", "-a", "a/b", "../a", "a b", "\xc3\xa4", "a\n"})
    CHECK_MESSAGE(!is_golden_name(bad), bad);
  CHECK_FALSE(is_golden_name(std::string(201, 'a')));
  for (const char* any : {"", "..", "my shader", "targets[1]", "\xc3\xa4", "-x", "../../etc/passwd"})
    CHECK_MESSAGE(is_golden_name(golden_name(any)), any);
  CHECK(is_golden_name(golden_name(std::string(500, '-'))));
  CHECK(golden_name("targets[1]") == "targets_1_");
}

TEST_CASE("what is wrong with a manifest is said with file and entry") {
  const TemporaryFolder folder;
  GoldenManifest manifest;
  manifest.folder = folder.path.string();
  manifest.put(entry_named("one"));
  write_manifest(manifest);
  const std::string path = manifest_path(manifest.folder), good = read_file(path);
  const auto refused = [&](const std::string& from, const std::string& to, const char* reason) {
    std::string text = good;
    REQUIRE(text.find(from) != std::string::npos);
    text.replace(text.find(from), from.size(), to);
    write_file(path, text);
    CAPTURE(text);
    CHECK_THROWS_WITH_AS(read_manifest(manifest.folder), doctest::Contains(reason), UserError);
    CHECK_THROWS_WITH_AS(read_manifest(manifest.folder), doctest::Contains(path.c_str()), UserError);
  };
  refused("{", "", "parse error at line 2");
  refused("{", "<<<<<<< HEAD\n{", "merge");
  refused("\"golden\": 1", "\"golden\": 2", "later Twinshade");
  refused("\"golden\": 1", "\"silver\": 1", "not a manifest");
  refused("\"entries\"", "\"entry\"", "\"entry\" is not known");
  refused("\"one\"", "\"../one\"", "no name of an entry");
  refused("\"one\"", "3", "entry 1: it has no text \"name\"");
  refused("\"draw\"", "\"drawn\"", "one: \"drawn\" is not known");
  refused("\"8x4\",\n      \"frame\"", "\"8x0\",\n      \"frame\"", "one: \"size\"");
  refused("\"quad\"", "3", "\"scene\" of \"draw\"");
  refused("\"name\": \"one\",", "\"name\": \"two\", \"name\": \"one\",", "has \"name\" twice");
  refused("\"quad\",", "\"quad\", \"scene\": \"house\",", "has \"scene\" twice");
  refused(std::string(64, 'a'), std::string(63, 'a'), "\"frame\" is no SHA-256");
  const std::size_t begin = good.find("    {"), end = good.rfind("\n  ]");
  refused(good.substr(begin, end - begin), good.substr(begin, end - begin) + ",\n" + good.substr(begin, end - begin),
          "two entries are named one");
  CHECK_THROWS_AS(read_manifest(folder.name("missing")), UserError);
}

}  // namespace twinshade
