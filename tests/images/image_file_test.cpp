#include "images/image_file.h"

#include <doctest/doctest.h>

#include <random>

#include "base/file.h"
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
