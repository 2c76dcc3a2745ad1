// golden remove: drops entries of a manifest, and their images.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <filesystem>
#include <memory>

#include "app/golden/scene.h"
#include "app/golden/verbs.h"
#include "base/error.h"
#include "base/folder_lock.h"
#include "base/names.h"
#include "golden/frame_file.h"

namespace twinshade {
namespace {

namespace fs = std::filesystem;

struct GoldenRemoveVerb {
  CommonOptions common;
  std::string folder;
  std::vector<std::string> patterns;

  int run() const;
};

// The names of images that belong to no entry. Other pictures are none of golden's.
std::vector<std::string> stray_names(const GoldenManifest& manifest) {
  std::vector<std::string> names;
  for (const std::string& path : stray_images(manifest)) {
    try {
      read_frame_file(path);
      names.push_back(fs::path(path).stem().string());
    } catch (const UserError&) {
    }
  }
  return names;
}

// The names that one of the patterns is like. UserError where one of them is like none.
std::vector<std::string> names_like(const std::vector<std::string>& names, const std::vector<std::string>& patterns) {
  std::vector<std::string> chosen;
  for (const std::string& pattern : patterns) {
    if (pattern.empty()) throw UserError("'': the entry's name is empty");
    bool known = false;
    for (const std::string& name : names) {
      if (!is_like(name, pattern)) continue;
      known = true;
      if (std::find(chosen.begin(), chosen.end(), name) == chosen.end()) chosen.push_back(name);
    }
    if (!known) throw UserError(unknown_name_message("entry", pattern, names));
  }
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

int GoldenRemoveVerb::run() const {
  require_folder_name(folder);
  const Output output(common);
  require_manifest(folder);
  require_writable_folder(folder);
  const FolderLock lock(folder);
  GoldenManifest manifest = read_manifest(folder);
  std::vector<std::string> names = stray_names(manifest), files{manifest_path(folder)};
  for (const GoldenEntry& entry : manifest.entries) names.push_back(entry.name);
  const std::vector<std::string> dropped = names_like(names, patterns);
  for (const std::string& name : names) files.push_back(golden_image_path(folder, name));
  output.require_not_read(files);

  const std::size_t entries = manifest.entries.size();
  std::erase_if(manifest.entries, [&](const GoldenEntry& entry) {
    return std::binary_search(dropped.begin(), dropped.end(), entry.name);
  });
  // First: a run that is stopped leaves images without an entry, which check tells, not entries without an image.
  if (manifest.entries.size() < entries) write_manifest(manifest);
  std::string text;
  Json removed = Json::array();
  for (const std::string& name : dropped) {
    const std::string path = golden_image_path(folder, name);
    std::error_code code;
    fs::remove(path, code);
    if (code) throw UserError(path + ": cannot be removed: " + code.message());
    text += "removed " + name + '\n';
    removed.push_back({{"folder", folder}, {"name", name}, {"image", path}});
  }
  output.text(text + fmt::format("{} removed, {} left\n", dropped.size(), manifest.entries.size()));
  output.json({{"removed", removed}, {"left", manifest.entries.size()}});
  return 0;
}

}  // namespace

Verb add_golden_remove(CLI::App& golden) {
  CLI::App* command = golden.add_subcommand("remove", "drop entries and their images, and images without an entry");
  const auto verb = std::make_shared<GoldenRemoveVerb>();
  command->add_option("folder", verb->folder, "folder of golden.json and the images")->required()->type_name("DIR");
  command->add_option("entry", verb->patterns, "names of entries, or what they are like: * any text, ? any one")
      ->required()
      ->type_name("PATTERN...");
  add_common_options(*command, verb->common);
  return {command, [verb] { return verb->run(); }};
}

}  // namespace twinshade
