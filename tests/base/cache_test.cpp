#include "base/cache.h"

#include <doctest/doctest.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "base/error.h"
#include "base/file.h"

using namespace twinshade;
namespace fs = std::filesystem;

namespace {

// Environment variables as they were before, and a folder of its own.
class Cache {
 public:
  Cache() {
    fs::create_directories(folder);
    setenv("TWINSHADE_CACHE", folder.c_str(), 1);
    unsetenv("TWINSHADE_CACHE_SIZE");
  }
  ~Cache() {
    fs::remove_all(folder);
    unsetenv("TWINSHADE_CACHE");
    unsetenv("TWINSHADE_CACHE_SIZE");
  }
  std::string add(const std::string& name, std::size_t bytes, std::chrono::minutes age) const {
    const std::string path = folder + "/" + name;
    fs::create_directories(fs::path(path).parent_path());
    write_file(path, std::string(bytes, 'x'));
    fs::last_write_time(path, fs::file_time_type::clock::now() - age);
    return path;
  }

  const std::string folder =
      (fs::temp_directory_path() / ("twinshade_cache_test_" + std::to_string(getpid()))).string();
};

constexpr std::chrono::minutes kNow{0}, kHour{60}, kDay{24 * 60};
const std::string kKey(16, 'a'), kOtherKey(16, 'b');

}  // namespace

TEST_CASE("a full cache loses what was used longest ago, whatever its kind") {
  const Cache cache;
  const std::string oldest = cache.add("shader-" + kKey + ".so", 1000, 3 * kDay);
  const std::string header = cache.add("runtime-" + kKey + "/cpu_shaders/runtime.h", 1000, kNow);
  const std::string runtime = cache.folder + "/runtime-" + kKey;
  fs::last_write_time(runtime, fs::file_time_type::clock::now() - 2 * kDay);
  const std::string bake = cache.add("bake-" + kKey, 1000, kDay);
  setenv("TWINSHADE_CACHE_SIZE", "2500", 1);
  trim_cache();
  CHECK(!fs::exists(oldest));
  CHECK(fs::exists(header));
  CHECK(fs::exists(bake));

  touch_cached(runtime);  // now the bake is the oldest
  cache.add("shader-" + kOtherKey + ".so", 1000, kHour);
  trim_cache();
  CHECK(fs::exists(header));
  CHECK(!fs::exists(bake));
}

TEST_CASE("what was used a moment ago stays, however small the limit") {
  const Cache cache;
  const std::string used = cache.add("shader-" + kKey + ".so", 1000, kNow), old = cache.add("bake-" + kKey, 10, kHour);
  setenv("TWINSHADE_CACHE_SIZE", "0", 1);
  trim_cache();
  CHECK(fs::exists(used));
  CHECK(!fs::exists(old));
}

TEST_CASE("a runtime stays as long as compilers may read from it") {
  const Cache cache;
  const std::string name = "runtime-" + kKey, path = cache.folder + "/" + name;
  cache.add(name + "/base/a.h", 1000, kNow);
  setenv("TWINSHADE_CACHE_SIZE", "0", 1);
  for (const int minutes : {20, 40}) {
    fs::last_write_time(path, fs::file_time_type::clock::now() - std::chrono::minutes(minutes));
    trim_cache();
    CHECK(fs::exists(path) == (minutes == 20));
  }
}

TEST_CASE("a cache in a folder with other files leaves them alone") {
  const Cache cache;
  setenv("TWINSHADE_CACHE_SIZE", "0", 1);
  std::vector<std::string> theirs;
  for (const char* name :
       {"shader-notes.txt", "shaders/mine.frag", "bake-off", "runtime-", "runtime-cafe/x", ".profile", "paper.pdf"})
    theirs.push_back(cache.add(name, 1000, kDay));
  trim_cache();
  for (const std::string& path : theirs) CHECK_MESSAGE(fs::exists(path), path);
}

TEST_CASE("temporaries of processes that were killed go, those of living ones stay") {
  const Cache cache;
  const std::string old = cache.add(".twinshade-1-0.so", 10, kDay), young = cache.add(".twinshade-2-0.so", 10, kNow);
  const std::string within = "runtime-" + kKey + "/prepared-" + kKey + "/";
  const std::string old_within = cache.add(within + ".twinshade-1-1.gch", 10, kDay),
                    young_within = cache.add(within + ".twinshade-2-1.gch", 10, kNow),
                    whole = cache.add(within + "runtime.h.gch", 10, kDay),
                    theirs = cache.add("other/.twinshade-1-1.gch", 10, kDay);
  trim_cache();
  CHECK(!fs::exists(old));
  CHECK(fs::exists(young));
  CHECK(!fs::exists(old_within));
  for (const std::string& path : {young_within, whole, theirs}) CHECK_MESSAGE(fs::exists(path), path);
}

TEST_CASE("a relative XDG_CACHE_HOME is ignored") {
  const Cache cache;
  const char* const names[] = {"HOME", "XDG_CACHE_HOME"};
  std::vector<std::string> before;
  for (const char* name : names) before.emplace_back(std::getenv(name) ? std::getenv(name) : "");
  unsetenv("TWINSHADE_CACHE");
  setenv("HOME", cache.folder.c_str(), 1);
  setenv("XDG_CACHE_HOME", "relative", 1);
  CHECK(cache_folder() == cache.folder + "/.cache/twinshade");
  CHECK(!fs::exists("relative"));
  setenv("XDG_CACHE_HOME", (cache.folder + "/xdg").c_str(), 1);
  CHECK(cache_folder() == cache.folder + "/xdg/twinshade");
  for (std::size_t k = 0; k < 2; ++k) before[k].empty() ? unsetenv(names[k]) : setenv(names[k], before[k].c_str(), 1);
}

TEST_CASE("a cache whose name begins as an option does is no option to compilers") {
  const Cache cache;
  const fs::path before = fs::current_path();
  fs::current_path(cache.folder);
  for (const char* name : {"-cache", "@cache"}) {
    setenv("TWINSHADE_CACHE", name, 1);
    CHECK(cache_folder() == std::string("./") + name);
  }
  fs::current_path(before);
}

TEST_CASE("the size of the cache is read with its unit, and nonsense is refused by name") {
  const Cache cache;
  CHECK(cache_size_limit() == std::uint64_t{2} << 30);
  for (const auto& [text, size] : {std::pair<const char*, std::uint64_t>{"0", 0},
                                   {"123", 123},
                                   {"5k", 5120},
                                   {"500M", 500ull << 20},
                                   {"3G", 3ull << 30},
                                   {"1T", 1ull << 40}}) {
    setenv("TWINSHADE_CACHE_SIZE", text, 1);
    const std::string given = text;  // clang++ captures no structured bindings
    CHECK_MESSAGE(cache_size_limit() == size, given);
  }
  for (const char* text : {"many", "5X", "5MB", "-1", "1.5G", "M", "99999999999T", "99999999999999999999"}) {
    setenv("TWINSHADE_CACHE_SIZE", text, 1);
    CHECK_THROWS_WITH_AS(cache_size_limit(), doctest::Contains("TWINSHADE_CACHE_SIZE="), UserError);
    CHECK_THROWS_WITH_AS(cache_folder(), doctest::Contains("TWINSHADE_CACHE_SIZE="), UserError);
  }
}

TEST_CASE("a sealed file is known from a truncated, changed or unsealed one") {
  const Cache cache;
  const std::string path = cache.add("shader-" + kKey + ".so", 5000, kNow), plain = read_file(path);
  CHECK(!is_sealed(path));
  seal(path);
  CHECK(is_sealed(path));
  const std::string whole = read_file(path);
  CHECK(whole.starts_with(plain));
  for (const std::size_t length : {std::size_t{0}, std::size_t{10}, plain.size(), whole.size() - 1}) {
    write_file(path, whole.substr(0, length));
    CHECK(!is_sealed(path));
  }
  for (const std::size_t at : {std::size_t{0}, plain.size() - 1, whole.size() - 1}) {
    std::string changed = whole;
    changed[at] = char(changed[at] ^ 1);
    write_file(path, changed);
    CHECK(!is_sealed(path));
  }
  CHECK(!is_sealed(path + ".missing"));
  fs::create_directories(path + ".folder");
  CHECK(!is_sealed(path + ".folder"));
  fs::create_symlink("/dev/zero", path + ".endless");
  CHECK(!is_sealed(path + ".endless"));
}

TEST_CASE("what is written to the cache takes the place of folders and links") {
  const Cache cache;
  const std::string outside = cache.add("theirs", 3, kNow), entry = cache.folder + "/shader-" + kKey + ".so";
  write_cached(entry, "new");
  fs::remove(entry);
  fs::create_directories(entry + "/within");
  write_cached(entry, "one");
  CHECK(read_file(entry) == "one");
  fs::remove(entry);
  fs::create_symlink(outside, entry);
  write_cached_with(entry, [](const std::string& temporary) { write_file(temporary, "two"); });
  CHECK(!fs::is_symlink(entry));
  CHECK(read_file(entry) == "two");
  CHECK(read_file(outside) == "xxx");
}

TEST_CASE("a folder of the cache takes the place of files, and folders stay") {
  const Cache cache;
  const std::string name = "runtime-" + kKey, kept = cache.add(name + "/base/a.h", 1, kNow);
  CHECK(make_cache_folder(name + "/base") == cache.folder + "/" + name + "/base");
  CHECK(fs::exists(kept));
  cache.add("runtime-" + kOtherKey, 1, kNow);
  CHECK(fs::is_directory(make_cache_folder("runtime-" + kOtherKey + "/base")));
}

TEST_CASE("a cache that may not be written is said to be that") {
  const Cache cache;
  fs::permissions(cache.folder,
                  fs::perms::owner_read | fs::perms::owner_exec | fs::perms::others_read | fs::perms::others_exec);
  const bool root = geteuid() == 0;
  if (root) REQUIRE(seteuid(65534) == 0);  // root may write everywhere
  CHECK_THROWS_WITH_AS(require_writable_cache(), doctest::Contains("cannot be written: Permission denied; set TWINSH"),
                       UserError);
  CHECK_THROWS_WITH_AS(make_cache_folder("runtime-" + kKey), doctest::Contains("TWINSHADE_CACHE"), UserError);
  if (root) REQUIRE(seteuid(0) == 0);
  fs::permissions(cache.folder, fs::perms::owner_all);
  CHECK_NOTHROW(require_writable_cache());
}
