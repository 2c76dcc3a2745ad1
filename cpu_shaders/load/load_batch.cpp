#include "cpu_shaders/load/load_batch.h"

#include <algorithm>
#include <mutex>

#include "base/error.h"
#include "base/parallel.h"
#include "cpu_shaders/load/open.h"
#include "cpu_shaders/load/runtime_files.h"
#include "cpu_shaders/translate/translate.h"

namespace twinshade {
namespace {

std::string numbered(const std::string& symbol, std::size_t k) { return symbol + "_" + std::to_string(k); }

// Each translation declares what is its own in namespace twinshade; here that is a namespace of its own, which sees the
// runtime in the real one. C symbols know no namespaces, so the module's name is made another.
std::string unit_text(std::span<const std::string> cpp) {
  std::string text = "#include \"cpu_shaders/runtime/runtime.h\"\n";
  if (std::ranges::any_of(cpp, [](const std::string& one) { return one.find(kHalfInclude) != std::string::npos; }))
    text += kHalfInclude;
  for (std::size_t k = 0; k < cpp.size(); ++k) {
    text += "#undef twinshade_shader_module\n#define twinshade_shader_module " + numbered(kModuleSymbol, k) + "\n";
    text += "namespace " + numbered("batch", k) + " {\nnamespace twinshade {\nusing namespace ::twinshade;\n}\n";
    text += cpp[k] + "\n}\n";
  }
  return text;
}

void load_unit(std::span<const std::string> cpp, const CompileOptions& options, std::span<BatchModule> modules) {
  try {
    const std::string object = compile_shader(unit_text(cpp), options);
    for (std::size_t k = 0; k < cpp.size(); ++k) modules[k].module = &open_module(object, numbered(kModuleSymbol, k));
  } catch (const CompilerTimeout& error) {  // one by one they would wait as long each
    for (BatchModule& module : modules) module.error = error.what();
  } catch (const UserError& error) {
    if (cpp.size() == 1) {
      modules[0].error = error.what();
      return;
    }
    for (std::size_t k = 0; k < cpp.size(); ++k) load_unit(cpp.subspan(k, 1), options, modules.subspan(k, 1));
  }
}

}  // namespace

std::vector<BatchModule> load_batch(std::span<const std::string> cpp, const BatchOptions& options) {
  std::vector<BatchModule> modules(cpp.size());
  if (cpp.empty()) return modules;
  // Few shaders are dealt out to all threads.
  const std::size_t threads = std::size_t(thread_count());
  const std::size_t per_unit =
      std::clamp<std::size_t>((cpp.size() + threads - 1) / threads, 1, options.shaders_per_unit);
  std::mutex mutex;
  std::size_t done = 0;
  parallel_for((cpp.size() + per_unit - 1) / per_unit, [&](std::size_t unit, int) {
    const std::size_t first = unit * per_unit, count = std::min(per_unit, cpp.size() - first);
    load_unit(cpp.subspan(first, count), options.compile, std::span(modules).subspan(first, count));
    const std::lock_guard lock(mutex);
    done += count;
    if (options.progress) options.progress(done, cpp.size());
  });
  return modules;
}

}  // namespace twinshade
