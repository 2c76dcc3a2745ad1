// Runs the built program as a user would.
#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace twinshade {

struct Run {
  int code = -1;  // exit code; 128 + signal
  std::string out, err;
  nlohmann::json json() const { return nlohmann::json::parse(out); }
};

// With a cache of the tests' own. Never through a shell: arguments arrive as they are.
Run run_twinshade(const std::vector<std::string>& arguments);
// The same with a stdout whose reader has left.
Run run_twinshade_unread(const std::vector<std::string>& arguments);
// The same of a run that gets SIGTERM as soon as `until` holds, where it has not ended by then.
Run run_twinshade_until(const std::vector<std::string>& arguments, const std::function<bool()>& until);

// A fresh folder, removed with all it holds.
class Folder {
 public:
  Folder();
  ~Folder();
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  std::string operator/(const std::string& name) const { return (path_ / name).string(); }
  // Writes a file into it and returns its path.
  std::string file(const std::string& name, const std::string& content) const;
  std::vector<std::string> names() const;  // of what it holds, sorted

 private:
  std::filesystem::path path_;
};

// Small enough to be quick, lit by few rays: what most tests draw.
std::vector<std::string> small_quad(std::vector<std::string> before, const std::vector<std::string>& after);

// Empty, or why this machine cannot draw on an OpenGL backend.
std::string why_missing(const std::string& backend);

// The working ones of egl and osmesa; says aloud which are missing.
std::vector<std::string> opengl_backends();

}  // namespace twinshade
