// Image files for tests.
#pragma once

#include <OpenImageIO/imageio.h>
#include <doctest/doctest.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

// values: row 0 is the upper one, `channels` a pixel.
template <class T>
void write_image(const std::string& path, int width, int height, int channels, const std::vector<T>& values,
                 const char* compression = nullptr, const std::vector<std::string>& channel_names = {}) {
  const auto format = sizeof(T) == 1   ? OIIO::TypeDesc::UINT8
                      : sizeof(T) == 2 ? OIIO::TypeDesc::UINT16
                      : T(0.5f) == 0   ? OIIO::TypeDesc::UINT32
                                       : OIIO::TypeDesc::FLOAT;
  const std::unique_ptr<OIIO::ImageOutput> out = OIIO::ImageOutput::create(path);
  REQUIRE(out);
  OIIO::ImageSpec spec(width, height, channels, format);
  if (!channel_names.empty()) spec.channelnames = channel_names;
  spec.attribute("oiio:UnassociatedAlpha", 1);
  if (compression) spec.attribute("compression", compression);
  REQUIRE(out->open(path, spec));
  REQUIRE(out->write_image(format, values.data()));
  REQUIRE(out->close());
}

// A Radiance picture of given RGBE bytes without run lengths.
inline std::string flat_rgbe(int width, int height, const std::vector<std::uint8_t>& rgbe) {
  std::string text =
      "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y " + std::to_string(height) + " +X " + std::to_string(width) + "\n";
  text.append(reinterpret_cast<const char*>(rgbe.data()), rgbe.size());
  return text;
}
