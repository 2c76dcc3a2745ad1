#include <doctest/doctest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "base/error.h"
#include "base/file.h"
#include "base/hash.h"

using namespace twinshade;
namespace fs = std::filesystem;

namespace {

struct TemporaryFolder {
  fs::path path = fs::temp_directory_path() / ("twinshade_base_test_" + std::to_string(::getpid()));
  TemporaryFolder() { fs::create_directories(path); }
  ~TemporaryFolder() { fs::remove_all(path); }
};

std::size_t files_in(const fs::path& folder) {
  return std::size_t(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

}  // namespace

TEST_CASE("SHA-256 gives the digests of FIPS 180-4's examples") {
  CHECK(sha256_hex("") == "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  CHECK(sha256_hex("abc") == "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  CHECK(sha256_hex("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq") ==
        "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  CHECK(sha256_hex(std::string(1000000, 'a')) == "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST_CASE("SHA-256 does not depend on how the bytes are handed over") {
  std::string text;
  for (int i = 0; i < 300; ++i) text += char('a' + i % 26);
  for (std::size_t step : {1u, 7u, 63u, 64u, 65u, 128u}) {
    Sha256 hash;
    for (std::size_t at = 0; at < text.size(); at += step) hash.add(std::string_view(text).substr(at, step));
    CHECK(hash.hex() == sha256_hex(text));
  }
}

TEST_CASE("a written file is whole or not there") {
  TemporaryFolder folder;
  const std::string path = (folder.path / "a.txt").string();
  write_file(path, "one");
  CHECK(read_file(path) == "one");
  CHECK_THROWS_AS(write_file_with(path,
                                  [](const std::string& temporary) {
                                    std::ofstream(temporary) << "half";
                                    throw UserError("disk full");
                                  }),
                  UserError);
  CHECK(read_file(path) == "one");
  CHECK(files_in(folder.path) == 1);
}

TEST_CASE("a path that cannot be read or written is named in one line") {
  TemporaryFolder folder;
  for (const std::string& path : {(folder.path / "missing.txt").string(), folder.path.string()}) {
    try {
      read_file(path);
      FAIL("no error");
    } catch (const UserError& error) {
      const std::string message = error.what();
      CHECK(message.find(path) == 0);
      CHECK(message.find('\n') == std::string::npos);
    }
  }
  CHECK_THROWS_AS(write_file((folder.path / "no" / "folder.txt").string(), "x"), UserError);
}
