// What tests of on-demand compilation share.
#pragma once

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <functional>
#include <string>

#include "base/error.h"
#include "cpu_shaders/shader_source.h"

namespace twinshade {

// A cache of this process' own, gone afterwards.
struct TestCache {
  static inline int count = 0;
  std::string folder = (std::filesystem::temp_directory_path() /
                        ("twinshade_load_test_" + std::to_string(getpid()) + "_" + std::to_string(count++)))
                           .string();
  TestCache() {
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
    setenv("TWINSHADE_CACHE", folder.c_str(), 1);
  }
  ~TestCache() { std::filesystem::remove_all(folder); }
};

// One for all tests that do not care whether the runtime was prepared before: it costs a second. Shaders start afresh.
inline const TestCache& shared_cache() {
  static const TestCache cache;
  setenv("TWINSHADE_CACHE", cache.folder.c_str(), 1);
  for (const auto& entry : std::filesystem::directory_iterator(cache.folder))
    if (entry.path().filename().string().starts_with("shader-")) std::filesystem::remove(entry.path());
  return cache;
}

// An environment variable, as it was before afterwards.
class TestVariable {
 public:
  // value: null unsets it.
  TestVariable(const char* name, const char* value) : name_(name) {
    if (const char* before = std::getenv(name)) before_ = before, was_set_ = true;
    set(value);
  }
  ~TestVariable() { set(was_set_ ? before_.c_str() : nullptr); }
  TestVariable(const TestVariable&) = delete;
  TestVariable& operator=(const TestVariable&) = delete;

 private:
  void set(const char* value) const {
    if (value)
      setenv(name_, value, 1);
    else
      unsetenv(name_);
  }
  const char* name_;
  std::string before_;
  bool was_set_ = false;
};

// in vec3 a, out float r.
inline ShaderSource small_shader(const std::string& body) {
  return resolve_shader("test", "in vec3 a;\nout float r;\nvoid main() {\n" + body + "\n}\n", "test.frag");
}

inline std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const UserError& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace twinshade
