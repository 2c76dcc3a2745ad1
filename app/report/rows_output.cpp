#include "app/report/rows_output.h"

#include <fmt/format.h>

#include <filesystem>

#include "app/report/table.h"
#include "base/file.h"
#include "golden/pictures.h"

namespace twinshade {
namespace {

Json json_cell(const Cell& cell) {
  if (const auto* text = std::get_if<std::string>(&cell)) return *text;
  if (const auto* whole = std::get_if<std::int64_t>(&cell)) return *whole;
  if (const auto* real = std::get_if<double>(&cell)) return *real;
  return nullptr;
}

std::string table_cell(const Cell& cell) {
  if (const auto* text = std::get_if<std::string>(&cell)) return *text;
  if (const auto* whole = std::get_if<std::int64_t>(&cell)) return std::to_string(*whole);
  if (const auto* real = std::get_if<double>(&cell)) return fmt::format("{:.7g}", *real);
  return "-";
}

void write_radiometric(const std::string& path, const RadiometricImage& image) {
  Frame frame;
  frame.width = image.width;
  frame.height = image.height;
  frame.color.resize(std::size_t(image.width) * image.height * 4);
  for (std::uint32_t y = 0; y < image.height; ++y)  // frames are y-up
    for (std::uint32_t x = 0; x < image.width; ++x) {
      const float* from = image.rgb.data() + (std::size_t(y) * image.width + x) * 3;
      float* to = frame.color.data() + (std::size_t(image.height - 1 - y) * image.width + x) * 4;
      for (int c = 0; c < 3; ++c) to[c] = from[c];
      to[3] = 1;
    }
  write_picture(path, frame);
}

}  // namespace

Json json_rows(const Rows& rows) {
  Json list = Json::array();
  for (std::size_t r = 0; r < rows.size(); ++r) {
    Json row = Json::object();
    for (std::size_t c = 0; c < rows.columns().size(); ++c) row[rows.columns()[c]] = json_cell(rows[r][c]);
    list.push_back(std::move(row));
  }
  return list;
}

std::string table_text(const Rows& rows) {
  Table table;
  for (std::size_t c = 0; c < rows.columns().size(); ++c) {
    const bool text = rows.size() > 0 && std::holds_alternative<std::string>(rows[0][c]);
    table.column(rows.columns()[c], text ? Table::Align::left : Table::Align::right);
  }
  for (std::size_t r = 0; r < rows.size(); ++r) {
    std::vector<std::string> cells;
    for (const Cell& cell : rows[r]) cells.push_back(table_cell(cell));
    table.row(std::move(cells));
  }
  return table.text();
}

std::vector<std::string> picture_files(const std::string& name) {
  return {name + ".svg", name + ".png", name + ".exr"};
}

void write_pictures(const std::string& folder, const std::vector<Picture>& pictures, const Output& output) {
  for (const Picture& picture : pictures) {
    const std::string path = (std::filesystem::path(folder) / picture.name).string();
    output.progress("writing " + path);
    if (const auto* drawing = std::get_if<Drawing>(&picture.content)) {
      write_file(path + ".svg", drawing->svg());
      write_file(path + ".png", drawing->png());
    } else {
      write_radiometric(path + ".exr", std::get<RadiometricImage>(picture.content));
    }
  }
}

}  // namespace twinshade
