#include "images/image_file.h"

#include <doctest/doctest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <random>
#include <thread>

#include "base/file.h"
#include "base/memory.h"
#include "base/sanitizers.h"
#include "tests/scenes/image_writers.h"
#include "tests/scenes/temporary_folder.h"

using namespace twinshade;

namespace {

template <class T>
std::vector<T> noise(std::size_t count) {
  std::mt19937 random(9);
  std::vector<T> values(count);
  for (T& v : values) v = T(random());
  return values;
}

std::string big_endian(std::uint32_t value) {
  return {char(value >> 24), char(value >> 16 & 255), char(value >> 8 & 255), char(value & 255)};
}

// A PNG chunk with its right checksum.
std::string chunk(const std::string& type, const std::string& data) {
  std::uint32_t crc = ~0u;
  for (char byte : type + data) {
    crc ^= static_cast<unsigned char>(byte);
    for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (crc & 1 ? 0xedb88320u : 0);
  }
  return big_endian(std::uint32_t(data.size())) + type + data + big_endian(~crc);
}

// A zlib stream of one stored block; its check (Adler-32), changed by `error`.
std::string stored(const std::string& data, std::uint32_t error = 0) {
  std::uint32_t a = 1, b = 0;
  for (char byte : data) a = (a + static_cast<unsigned char>(byte)) % 65521, b = (b + a) % 65521;
  const char size = char(data.size()), inverse = char(~data.size());
  return std::string("\x78\x01\x01", 3) + size + '\0' + inverse + '\xff' + data + big_endian((b << 16 | a) ^ error);
}

std::string header(int width, char depth, char colour_type) {
  return chunk("IHDR", big_endian(std::uint32_t(width)) + big_endian(2) + depth + colour_type + std::string(3, '\0'));
}

const std::string kPngStart = "\x89PNG\r\n\x1a\n", kPngEnd = chunk("IEND", "");

// What `call` lets libraries write to stderr.
template <class Call>
std::string written_to_stderr(Call call) {
  std::FILE* file = std::tmpfile();
  REQUIRE(file);
  const int old = dup(STDERR_FILENO);
  dup2(fileno(file), STDERR_FILENO);
  call();
  dup2(old, STDERR_FILENO);
  close(old);
  std::string text(4096, '\0');
  std::rewind(file);
  text.resize(std::fread(text.data(), 1, text.size(), file));
  std::fclose(file);
  return text;
}

}  // namespace

TEST_CASE("integers are divided by their largest value, unassociated alpha left alone") {
  TemporaryFolder folder;
  const auto bytes = noise<std::uint8_t>(16 * 8 * 4);
  write_image(folder.name("a.png"), 16, 8, 4, bytes);
  for (bool memory : {false, true}) {
    const std::string content = read_file(folder.name("a.png"));
    const DecodedImage image = memory ? decode_image_memory(content, "a") : decode_image_file(folder.name("a.png"));
    CHECK(image.width == 16);
    CHECK(image.height == 8);
    CHECK(image.channels == 4);
    CHECK(image.bits == 8);
    for (std::size_t i = 0; i < bytes.size(); ++i) CHECK(image.texels[i] == float(bytes[i] / 255.0));
  }
  const auto words = noise<std::uint16_t>(16 * 8);
  write_image(folder.name("b.png"), 16, 8, 1, words);
  const DecodedImage image = decode_image_file(folder.name("b.png"));
  CHECK(image.channels == 1);
  CHECK(image.bits == 16);
  for (std::size_t i = 0; i < words.size(); ++i) CHECK(image.texels[i] == float(words[i] / 65535.0));
}

TEST_CASE("truncated PNG and JPEG are refused, from files and from memory") {
  TemporaryFolder folder;
  const auto bytes = noise<std::uint8_t>(64 * 64 * 3);
  for (const std::string ending : {"png", "jpg", "tga", "bmp"}) {
    const std::string file = folder.name("whole." + ending);
    write_image(file, 64, 64, 3, bytes);
    CHECK(decode_image_file(file).channels == 3);
    const std::string whole = read_file(file);
    for (double part : {0.0, 0.001, 0.05, 0.4, 0.8, 0.99}) {
      if (ending == "tga" && part > 0.9) continue;  // only its trailing comments are cut
      const std::string start = whole.substr(0, std::size_t(double(whole.size()) * part));
      const std::string name = folder.write("part." + ending, start);
      const std::string message = user_error([&] { decode_image_file(name); });
      INFO(ending << " " << part << ": " << message);
      CHECK(message.find("part.") != std::string::npos);
      CHECK(message.find('\n') == std::string::npos);
      CHECK(user_error([&] { decode_image_memory(start, "part.memory"); }).find("part.memory") != std::string::npos);
    }
  }
}

TEST_CASE("PNGs whose chunks are whole but damaged within are refused, and libpng writes nothing to stderr") {
  TemporaryFolder folder;
  const std::string rows(6, '\0');  // two rows of two grey pixels, each after its filter
  const std::string good = kPngStart + header(2, 8, 0) + chunk("IDAT", stored(rows)) + kPngEnd;
  CHECK(decode_image_memory(good, "good").width == 2);
  std::string odd_filter = rows;
  odd_filter[3] = 9;
  const std::vector<std::pair<const char*, std::string>> damaged{
      {"IDAT is no zlib stream", header(2, 8, 0) + chunk("IDAT", "garbage!")},
      {"no IDAT", header(2, 8, 0)},
      {"IDAT is short", header(2, 8, 0) + chunk("IDAT", stored(std::string(3, '\0')))},
      {"filter 9", header(2, 8, 0) + chunk("IDAT", stored(odd_filter))},
      {"wrong Adler-32", header(2, 8, 0) + chunk("IDAT", stored(rows, 1))},
      {"no PLTE", header(2, 8, 3) + chunk("IDAT", stored(rows))},
      {"depth 7", header(2, 7, 0) + chunk("IDAT", stored(rows))},
      {"no width", header(0, 8, 0) + chunk("IDAT", stored(rows))},
      {"IHDR is short", chunk("IHDR", "x") + chunk("IDAT", stored(rows))}};
  for (const auto& damage : damaged) {
    const std::string bytes = kPngStart + damage.second + kPngEnd, file = folder.write("damaged.png", bytes);
    for (bool memory : {false, true}) {
      std::string message;
      const std::string noise = written_to_stderr(
          [&] { message = user_error([&] { memory ? decode_image_memory(bytes, file) : decode_image_file(file); }); });
      INFO(damage.first << ": " << message << " | " << noise);
      CHECK(message.find("damaged.png: cannot be read as an image") != std::string::npos);
      if (!kShadowMemory) CHECK(noise.empty());  // sanitizers keep their stderr, and so do libraries there
    }
  }
}

namespace {

using Names = std::vector<std::string>;

// Of an EXR file with these channels, whose only pixel has 1, 2 and so on in them.
std::string with_channels(const TemporaryFolder& folder, const Names& names) {
  std::vector<float> values;
  for (std::size_t c = 0; c < names.size(); ++c) values.push_back(float(c + 1));
  write_image(folder.name("c.exr"), 1, 1, int(names.size()), values, nullptr, names);
  return folder.name("c.exr");
}

}  // namespace

TEST_CASE("channels are read by name: R, G and B, those of the only layer, or one of grey") {
  const TemporaryFolder folder;
  const std::vector<std::pair<Names, std::vector<float>>> read{
      {{"R", "G", "B"}, {1, 2, 3}},
      {{"B", "G", "R"}, {3, 2, 1}},
      {{"A", "B", "G", "R", "Z"}, {4, 3, 2, 1}},
      {{"r", "g", "b"}, {1, 2, 3}},
      {{"R", "G", "B", "diffuse.R", "diffuse.G", "diffuse.B"}, {1, 2, 3}},
      {{"Z", "a.b.B", "a.b.G", "a.b.R"}, {4, 3, 2}},
      {{"light.R", "light.G", "light.B", "light.A", "depth.Z"}, {1, 2, 3, 4}},
      {{"mask.R", "mask.G", "light.R", "light.G", "light.B"}, {3, 4, 5}},
      {{"Y"}, {1}},
      {{"Y", "Z"}, {1}},
      {{"Y", "A"}, {1, 2}},
      {{"luminance"}, {1}},
      {{"R"}, {1}}};
  for (const auto& [names, texels] : read) {
    const std::string first = names.front();
    CAPTURE(first);
    const DecodedImage image = decode_image_file(with_channels(folder, names));
    CHECK(image.channels == texels.size());
    CHECK(image.texels == texels);
  }
}

TEST_CASE("formats that do not name their channels are read in their order: grey with alpha") {
  const TemporaryFolder folder;
  for (const std::string name : {"a.png", "a.tga", "a.tif"}) {
    CAPTURE(name);
    write_image(folder.name(name), 2, 1, 2, std::vector<std::uint8_t>{51, 255, 102, 255});
    const DecodedImage image = decode_image_file(folder.name(name));
    CHECK(image.channels == 2);
    CHECK(image.texels == std::vector<float>{0.2f, 1, 0.4f, 1});
  }
}

TEST_CASE("channels that make no picture, or several, are refused by their names") {
  const TemporaryFolder folder;
  const std::string needs = "; save it with R, G and B, or one channel of grey";
  for (const Names& names :
       {Names{"R", "G"}, {"B", "G"}, {"Z"}, {"A"}, {"view.Depth.V"}, {"R", "A", "Z"}, {"U", "V"}}) {
    const std::string message = user_error([&] { decode_image_file(with_channels(folder, names)); });
    INFO(message);
    CHECK(message.find("c.exr: cannot be read as an image: its channels are ") != std::string::npos);
    for (const std::string& name : names) CHECK(message.find(name) != std::string::npos);
    CHECK(message.ends_with(needs));
  }
  Names many;
  for (int i = 10; i < 30; ++i) many.push_back("c" + std::to_string(i));
  CHECK(user_error([&] { decode_image_file(with_channels(folder, many)); }).find("c21 and 8 more; save it with") !=
        std::string::npos);
  CHECK(user_error([&] {
          decode_image_file(with_channels(folder, {"a.R", "a.G", "a.B", "b.c.R", "b.c.G", "b.c.B"}));
        }).ends_with("it has R, G and B in the layers a, b.c; save the one that is meant alone"));
}

TEST_CASE("whole numbers of 32 bits are refused, not divided by their largest") {
  const TemporaryFolder folder;
  const std::vector<std::uint32_t> four{4, 4, 4};
  write_image(folder.name("c.exr"), 1, 1, 3, four, nullptr, {"R", "G", "B"});
  CHECK(user_error([&] { decode_image_file(folder.name("c.exr")); }).find("whole numbers of 32 bits") !=
        std::string::npos);
}

TEST_CASE("a picture that may not grow to its size is refused with the reason, whatever its format") {
  const TemporaryFolder folder;
  const auto bytes = noise<std::uint8_t>(64 * 64 * 3);
  const std::vector<float> floats(bytes.begin(), bytes.end());
  rlimit old{};
  REQUIRE(getrlimit(RLIMIT_FSIZE, &old) == 0);
  rlimit lower = old;
  lower.rlim_cur = 4000;
  const auto before = std::signal(SIGXFSZ, SIG_IGN);
  for (const std::string name : {"a.png", "a.exr", "a.hdr"}) {
    folder.write(name, "old");
    ImageToWrite image{64, 64, 3, name != "a.png", bytes.data(), 64 * 3, {}};
    if (image.is_float) image.upper_row = floats.data(), image.row_stride = 64 * 3 * sizeof(float);
    REQUIRE(setrlimit(RLIMIT_FSIZE, &lower) == 0);
    const std::string message = user_error([&] { write_image_file(folder.name(name), image); });
    REQUIRE(setrlimit(RLIMIT_FSIZE, &old) == 0);
    CHECK(message == folder.name(name) + ": cannot be written: File too large");
    CHECK(read_file(folder.name(name)) == "old");
  }
  std::signal(SIGXFSZ, before);
  CHECK(std::distance(std::filesystem::directory_iterator(folder.path), std::filesystem::directory_iterator()) == 3);
}

TEST_CASE("a picture with a question mark in its name is read") {
  TemporaryFolder folder;
  write_image(folder.name("a.png"), 4, 4, 1, std::vector<std::uint8_t>(16));
  CHECK(decode_image_file(folder.write("a?b=1.png", read_file(folder.name("a.png")))).width == 4);
}

TEST_CASE("a picture is what it begins as, whatever its ending; what is none of the formats that are read is refused") {
  TemporaryFolder folder;
  for (const char* ending : {".png", ".jpg", ".exr", ".hdr", ".tif", ".bmp", ".tga", ".gif", ".webp", ".ppm", ".sgi"}) {
    const std::string file = folder.name(std::string("a") + ending);
    write_image(file, 4, 4, 3, std::vector<std::uint8_t>(48, 255));
    INFO(ending);
    CHECK(decode_image_file(file).width == 4);
    if (std::string(ending) != ".tga") CHECK(decode_image_file(folder.write("other.jpg", read_file(file))).width == 4);
  }
  // An Amiga picture that says it is black: the image library ends the program.
  write_image(folder.name("a.iff"), 4, 4, 3, std::vector<std::uint8_t>(48, 255));
  std::string black = read_file(folder.name("a.iff"));
  black[black.find("TBHD") + 19] |= 2;
  for (const char* name : {"black.iff", "black.png", "black"}) {
    const std::string message = user_error([&] { decode_image_file(folder.write(name, black)); });
    CHECK(message.find(folder.name(name) + ": cannot be read as an image: it begins as no PNG, ") == 0);
  }
}

TEST_CASE("a DDS picture without bits for one of its colours is refused, not searched for them without end") {
  TemporaryFolder folder;
  const auto word = [](std::uint32_t value) {
    const std::string big = big_endian(value);
    return std::string(big.rbegin(), big.rend());
  };
  const auto dds = [&](std::uint32_t flags, const std::vector<std::uint32_t>& masks) {
    std::string bytes = "DDS " + word(124) + word(0x1007) + word(1) + word(1) + std::string(56, '\0') + word(32) +
                        word(flags) + word(0) + word(32);
    for (const std::uint32_t mask : masks) bytes += word(mask);
    return folder.write("a.dds", bytes + word(0x1000) + std::string(16, '\0') + word(0x01020304));
  };
  const std::vector<std::uint32_t> whole{0xff0000, 0xff00, 0xff, 0xff000000};
  CHECK(decode_image_file(dds(0x41, whole)).texels[0] == float(2 / 255.0));
  CHECK(decode_image_file(dds(0x40, {0xff0000, 0xff00, 0xff, 0})).texels[2] == float(4 / 255.0));
  for (std::size_t i = 0; i < 4; ++i) {
    std::vector<std::uint32_t> masks = whole;
    masks[i] = 0;
    CHECK(user_error([&] { decode_image_file(dds(0x41, masks)); }).find("a.dds: cannot be read as an image: ") !=
          std::string::npos);
  }
}

TEST_CASE("a picture comes through a pipe") {
  TemporaryFolder folder;
  write_image(folder.name("a.exr"), 4, 4, 3, std::vector<float>(48, 0.5f));
  const std::string bytes = read_file(folder.name("a.exr")), pipe = folder.name("pipe.exr");
  REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
  std::thread writer([&] { std::ofstream(pipe, std::ios::binary) << bytes; });
  const DecodedImage image = decode_image_file(pipe);
  writer.join();
  CHECK(image.width == 4);
  CHECK(image.texels[0] == 0.5f);
}

TEST_CASE("a few bytes that claim a picture larger than memory are refused") {
  TemporaryFolder folder;
  const std::string sides = big_endian(32768);
  const auto png = [&](const std::string& channels) {
    return kPngStart + chunk("IHDR", sides + sides + channels + std::string(3, '\0')) +
           chunk("IDAT", stored(std::string(6, '\0'))) + kPngEnd;
  };
  const std::size_t before = peak_memory();
  const std::string message =
      user_error([&] { decode_image_file(folder.write("large.png", png(std::string("\x08\0", 2)))); });
  CHECK(message.find("large.png: cannot be read as an image: ") != std::string::npos);
  if (before != 0) CHECK(peak_memory() < before + (std::size_t(256) << 20));
}
