#include <doctest/doctest.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <string>
#include <thread>

#include "base/error.h"
#include "base/file.h"
#include "base/hash.h"
#include "base/hash_instructions.h"
#include "tests/scenes/temporary_folder.h"

using namespace twinshade;
namespace fs = std::filesystem;

namespace {

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

TEST_CASE("SHA-256 by the processor's instructions and by portable code give the same digests") {
  if (!has_sha256_instructions())
    MESSAGE("this processor has no instructions for SHA-256: only portable code is tested");
  std::string text;
  for (std::uint32_t i = 0, state = 1; i < 1000; ++i) text += char((state = state * 1664525u + 1013904223u) >> 24);
  for (std::size_t size = 0; size <= text.size(); size += size < 200 ? 1 : 37) {
    CAPTURE(size);
    Sha256 portable(true);
    portable.add(std::string_view(text).substr(0, size));
    CHECK(portable.hex() == sha256_hex(std::string_view(text).substr(0, size)));
  }
}

TEST_CASE("files and links to them are replaced by writing, devices, pipes and descriptors are not") {
  TemporaryFolder folder;
  const std::string file = (folder.path / "a").string(), link = (folder.path / "link").string(),
                    pipe = (folder.path / "pipe").string();
  CHECK(is_replaced_by_writing(file));
  write_file(file, "a");
  CHECK(is_replaced_by_writing(file));
  fs::create_symlink(file, link);
  CHECK(is_replaced_by_writing(link));
  REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
  CHECK_FALSE(is_replaced_by_writing(pipe));
  CHECK_FALSE(is_replaced_by_writing("/dev/null"));
  CHECK_FALSE(is_replaced_by_writing("/dev/stdout"));
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

TEST_CASE("a temporary file's name has more than the process' number, which another container's may have too") {
  TemporaryFolder folder;
  std::string name;
  write_file_with((folder.path / "a.txt").string(), [&](const std::string& temporary) {
    name = fs::path(temporary).filename().string();
    std::ofstream(temporary) << "x";
  });
  CAPTURE(name);
  CHECK(
      std::regex_match(name, std::regex("\\.twinshade-" + std::to_string(::getpid()) + "-[0-9a-f]{16}-[0-9]+\\.txt")));
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

TEST_CASE("what has no end, or more than is read of it, is refused while reading") {
  TemporaryFolder folder;
  const std::string path = (folder.path / "a.txt").string();
  write_file(path, std::string(100, 'x'));
  CHECK(read_file(path, 100).size() == 100);
  CHECK_THROWS_WITH_AS(read_file(path, 99), doctest::Contains("a.txt: has more than 99 bytes"), UserError);
  CHECK_THROWS_WITH_AS(read_file("/dev/zero", kMostTextBytes), doctest::Contains("/dev/zero: has more than 4 MiB"),
                       UserError);
  fs::resize_file(path, std::uintmax_t{1} << 42);  // takes no room
  CHECK_THROWS_WITH_AS(read_file(path), doctest::Contains("a.txt needs 4096.0 GiB of memory"), UserError);
}

TEST_CASE("a pipe is read to its end") {
  TemporaryFolder folder;
  const std::string pipe = (folder.path / "pipe").string(), content(200000, 'x');
  REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
  std::thread writer([&] { std::ofstream(pipe, std::ios::binary) << content; });
  CHECK(read_file(pipe, content.size()) == content);
  writer.join();
}

TEST_CASE("a link stays, and the file that it leads to is replaced") {
  TemporaryFolder folder;
  const auto path = [&](const char* name) { return (folder.path / name).string(); };
  fs::create_directories(path("store"));
  write_file(path("store/a"), "old");
  fs::create_symlink("store/a", path("link"));
  fs::create_symlink(path("link"), path("second"));
  fs::create_symlink("store/new", path("dangling"));
  for (const char* name : {"link", "second"}) {
    write_file(path(name), name);
    CHECK(fs::is_symlink(path(name)));
    CHECK(read_file(path("store/a")) == name);
  }
  write_file(path("dangling"), "new");
  CHECK(fs::is_symlink(path("dangling")));
  CHECK(read_file(path("store/new")) == "new");
  CHECK(files_in(path("store")) == 2);

  fs::create_symlink("circle", path("circle"));
  CHECK_THROWS_WITH_AS(write_file(path("circle"), "x"), doctest::Contains("cannot be written"), UserError);
  fs::create_symlink("nowhere/a", path("lost"));
  CHECK_THROWS_WITH_AS(require_writable_file(path("lost")), doctest::Contains("does not exist"), UserError);
}

TEST_CASE("what is written to a pipe arrives there, whoever writes the file") {
  TemporaryFolder folder;
  const std::string pipe = (folder.path / "pipe.png").string();
  REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
  require_writable_file(pipe);
  std::string received;
  const auto receive = [&] { received = read_file(pipe); };
  std::thread first(receive);
  write_file(pipe, "whole");
  first.join();
  CHECK(received == "whole");
  std::thread second(receive);
  write_file_with(pipe, [](const std::string& temporary) {
    CHECK(temporary.ends_with(".png"));
    std::ofstream(temporary) << "by itself";
  });
  second.join();
  CHECK(received == "by itself");
  CHECK(fs::is_fifo(pipe));
  CHECK(files_in(folder.path) == 1);
}

TEST_CASE("a descriptor of this process, as /dev/stdout is one, is written to where it stands") {
  TemporaryFolder folder;
  const std::string path = (folder.path / "out").string();
  const int descriptor = ::open(path.c_str(), O_WRONLY | O_CREAT, 0600);
  REQUIRE(descriptor >= 0);
  REQUIRE(::write(descriptor, "text\n", 5) == 5);
  for (const char* kind : {"/dev/fd/", "/proc/self/fd/"}) {
    const std::string name = kind + std::to_string(descriptor);
    require_writable_file(name);
    write_file(name, "more\n");
  }
  ::close(descriptor);
  CHECK(read_file(path) == "text\nmore\nmore\n");
}

TEST_CASE("a device stays one, and says when it is full") {
  TemporaryFolder folder;
  const std::string null = (folder.path / "null").string(), full = (folder.path / "full").string();
  const bool made = ::mknod(null.c_str(), S_IFCHR | 0600, makedev(1, 3)) == 0 &&
                    ::mknod(full.c_str(), S_IFCHR | 0600, makedev(1, 7)) == 0;
  const int opened = made ? ::open(null.c_str(), O_WRONLY) : -1;
  if (opened < 0) {
    MESSAGE("devices cannot be made here: not tried");
    return;
  }
  ::close(opened);
  write_file(null, "gone");
  CHECK_THROWS_WITH_AS(write_file(full, "x"), doctest::Contains("full: cannot be written: No space left"), UserError);
  CHECK(fs::is_character_file(null));
  CHECK(fs::is_character_file(full));
}
