#include "golden/manifest.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "base/error.h"
#include "base/file.h"

namespace twinshade {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kVersion = 1;
constexpr const char* kVersionKey = "golden";
constexpr std::size_t kLongestName = 200;  // files have 255 bytes, of which endings and backends take some
constexpr std::uint64_t kMostManifestBytes = std::uint64_t{64} << 20;

bool is_name_character(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
         std::string_view("._+-").find(c) != std::string_view::npos;
}

bool begins_as_name(char c) { return is_name_character(c) && c != '.' && c != '-'; }

bool is_hash(const std::string& text) {
  return text.size() == 64 && text.find_first_not_of("0123456789abcdef") == std::string::npos;
}

// Reads one manifest; `at` says which part is at hand.
class Reader {
 public:
  explicit Reader(const std::string& folder) : path_(manifest_path(folder)) { manifest_.folder = folder; }

  GoldenManifest read() {
    const Json json = parse(read_file(path_, kMostManifestBytes));
    if (!json.is_object() || !json.contains(kVersionKey)) refuse("not a manifest of golden images");
    if (json[kVersionKey] != kVersion)
      refuse("version " + json[kVersionKey].dump() + " of manifests is not known: it was made by a later Twinshade");
    require_keys(json, {kVersionKey, "entries"});
    if (!json.contains("entries") || !json["entries"].is_array()) refuse("it has no list \"entries\"");
    for (const Json& entry : json["entries"]) add(entry);
    std::sort(manifest_.entries.begin(), manifest_.entries.end(),
              [](const GoldenEntry& a, const GoldenEntry& b) { return a.name < b.name; });
    for (std::size_t i = 1; i < manifest_.entries.size(); ++i)
      if (manifest_.entries[i].name == manifest_.entries[i - 1].name)
        refuse("two entries are named " + manifest_.entries[i].name);
    return std::move(manifest_);
  }

 private:
  [[noreturn]] void refuse(const std::string& reason) const {
    throw UserError(path_ + ": " + (at_.empty() ? "" : at_ + ": ") + reason);
  }

  Json parse(const std::string& text) const {
    if (text.rfind("<<<<<<< ", 0) == 0 || text.find("\n<<<<<<< ") != std::string::npos)
      refuse("it has marks of a merge that is not resolved");
    // The parser would take the last of two: what a merge leaves where both sides are kept.
    std::vector<std::set<std::string>> keys;
    std::string twice;
    const auto look = [&](int, Json::parse_event_t event, Json& value) {
      if (event == Json::parse_event_t::object_start) keys.emplace_back();
      if (event == Json::parse_event_t::object_end) keys.pop_back();
      if (event == Json::parse_event_t::key && !keys.back().insert(value).second && twice.empty()) twice = value;
      return true;
    };
    try {
      Json json = Json::parse(text, look);
      if (!twice.empty()) refuse("one object has \"" + twice + "\" twice: delete one of them");
      return json;
    } catch (const Json::exception& error) {
      std::string reason = error.what();
      reason = reason.substr(reason.find("] ") == std::string::npos ? 0 : reason.find("] ") + 2);
      refuse(reason);
    }
  }

  void require_keys(const Json& object, const std::vector<std::string>& known) const {
    for (const auto& [key, value] : object.items())
      if (std::find(known.begin(), known.end(), key) == known.end()) refuse("\"" + key + "\" is not known");
  }

  std::string text(const Json& object, const char* key) const {
    if (!object.contains(key) || !object[key].is_string()) refuse(std::string("it has no text \"") + key + '"');
    return object[key];
  }

  std::string hash(const Json& object, const char* key) const {
    std::string value = text(object, key);
    if (!is_hash(value)) refuse(std::string("\"") + key + "\" is no SHA-256");
    return value;
  }

  void add(const Json& json) {
    at_ = "entry " + std::to_string(manifest_.entries.size() + 1);
    if (!json.is_object()) refuse("not an object");
    GoldenEntry entry;
    entry.name = text(json, "name");
    if (!is_golden_name(entry.name)) refuse("\"" + entry.name + "\" is no name of an entry");
    at_ += ", " + entry.name;
    require_keys(json, {"name", "draw", "output", "size", "frame", "bundle", "shader"});
    entry.drawing = drawing(json);
    if (json.contains("output")) entry.output = text(json, "output");
    const std::string size = text(json, "size");
    const auto number = [&](std::size_t begin, std::size_t end, std::uint32_t& value) {
      const auto [stop, error] = std::from_chars(size.data() + begin, size.data() + end, value);
      return error == std::errc() && stop == size.data() + end && value > 0;
    };
    const std::size_t cross = size.find('x');
    if (cross == std::string::npos || !number(0, cross, entry.width) || !number(cross + 1, size.size(), entry.height))
      refuse("\"size\" is not WIDTHxHEIGHT");
    entry.frame = hash(json, "frame"), entry.bundle = hash(json, "bundle"), entry.shader = hash(json, "shader");
    manifest_.entries.push_back(std::move(entry));
    at_.clear();
  }

  GoldenDrawing drawing(const Json& json) const {
    if (!json.contains("draw") || !json["draw"].is_object()) refuse("it has no object \"draw\"");
    GoldenDrawing drawing;
    for (const auto& [key, value] : json["draw"].items()) {
      std::vector<std::string> values;
      for (const Json& each : value.is_array() ? value : Json::array({value})) {
        if (!each.is_string()) refuse("\"" + key + "\" of \"draw\" is neither text nor a list of texts");
        values.push_back(each);
      }
      drawing.emplace_back(key, values);
    }
    return drawing;
  }

  const std::string path_;
  std::string at_;
  GoldenManifest manifest_;
};

Json entry_json(const GoldenEntry& entry) {
  Json draw = Json::object();
  for (const auto& [key, values] : entry.drawing) draw[key] = values.size() == 1 ? Json(values.front()) : Json(values);
  Json json{{"name", entry.name}, {"draw", draw}};
  if (!entry.output.empty()) json["output"] = entry.output;
  json["size"] = std::to_string(entry.width) + 'x' + std::to_string(entry.height);
  json["frame"] = entry.frame, json["bundle"] = entry.bundle, json["shader"] = entry.shader;
  return json;
}

}  // namespace

GoldenEntry* GoldenManifest::find(const std::string& name) {
  const auto found =
      std::find_if(entries.begin(), entries.end(), [&](const auto& entry) { return entry.name == name; });
  return found == entries.end() ? nullptr : &*found;
}

void GoldenManifest::put(GoldenEntry entry) {
  if (GoldenEntry* there = find(entry.name)) {
    *there = std::move(entry);
    return;
  }
  const auto place = std::find_if(entries.begin(), entries.end(), [&](const auto& e) { return e.name > entry.name; });
  entries.insert(place, std::move(entry));
}

std::string manifest_path(const std::string& folder) {
  return (std::filesystem::path(folder) / kManifestName).string();
}

std::string golden_image_path(const std::string& folder, const std::string& name) {
  return (std::filesystem::path(folder) / (name + ".exr")).string();
}

bool is_golden_name(const std::string& name) {
  return !name.empty() && name.size() <= kLongestName && begins_as_name(name.front()) &&
         std::all_of(name.begin(), name.end(), is_name_character);
}

std::string golden_name(const std::string& wanted) {
  std::string name = wanted.substr(0, kLongestName - 1);
  for (char& c : name)
    if (!is_name_character(c)) c = '_';
  if (name.empty() || !begins_as_name(name.front())) name.insert(0, "_");
  return name;
}

std::vector<std::string> stray_images(const GoldenManifest& manifest) {
  namespace fs = std::filesystem;
  std::vector<std::string> strays;
  std::error_code code;
  for (auto at = fs::directory_iterator(manifest.folder, code); !code && at != fs::end(at); at.increment(code)) {
    const std::string name = at->path().stem().string();
    const auto is_it = [&](const GoldenEntry& entry) { return entry.name == name; };
    if (at->path().extension() == ".exr" && std::none_of(manifest.entries.begin(), manifest.entries.end(), is_it))
      strays.push_back(at->path().string());
  }
  std::sort(strays.begin(), strays.end());
  return strays;
}

GoldenManifest read_manifest(const std::string& folder) { return Reader(folder).read(); }

void write_manifest(const GoldenManifest& manifest) {
  Json entries = Json::array();
  for (const GoldenEntry& entry : manifest.entries) entries.push_back(entry_json(entry));
  write_file(manifest_path(manifest.folder), Json{{kVersionKey, kVersion}, {"entries", entries}}.dump(2) + '\n');
}

}  // namespace twinshade
