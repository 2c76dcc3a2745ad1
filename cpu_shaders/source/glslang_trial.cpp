#include "cpu_shaders/source/glslang_trial.h"

#include <fcntl.h>
#include <malloc.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>
#include <new>

#include "base/error.h"
#include "base/sanitizers.h"
#include "cpu_shaders/source/macro_expansion.h"

namespace twinshade {
namespace {

constexpr rlim_t kMostSeconds = 10;
constexpr int kOutOfMemory = 3;

void limit(__rlimit_resource resource, rlim_t value) {
  rlimit r{};
  getrlimit(resource, &r);
  r.rlim_cur = r.rlim_max == RLIM_INFINITY || value < r.rlim_max ? value : r.rlim_max;
  setrlimit(resource, &r);
}

[[noreturn]] void be_child(const std::function<void()>& work) {
  for (const int signal : {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL, SIGXCPU}) std::signal(signal, SIG_DFL);
  const int nowhere = open("/dev/null", O_WRONLY);
  dup2(nowhere, 1), dup2(nowhere, 2);
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_CPU, kMostSeconds);  // a child's clock starts at 0
  if constexpr (!kShadowMemory) {
    constexpr rlim_t kMostBytes = rlim_t{1} << 30;
    rlim_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    limit(RLIMIT_AS, pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE)) + kMostBytes);
  }
  // What was never written is no pointer to anything: reading it crashes here, not by luck somewhere else.
  mallopt(M_PERTURB, 0x5a);
  try {
    work();
  } catch (const std::bad_alloc&) {
    _exit(kOutOfMemory);
  } catch (...) {
  }
  _exit(0);
}

}  // namespace

bool looks_hostile(const ShaderSource& source) {
  constexpr std::size_t kLongText = 256 << 10, kLongStatement = 8 << 10;
  constexpr int kDeep = 16;
  const std::string& text = source.text;
  if (text.size() > kLongText) return true;
  int depth = 0;
  std::size_t statement = 0;  // where it began
  for (std::size_t at = 0; at < text.size(); ++at) {
    const char c = text[at];
    depth += (c == '(' || c == '[' || c == '{') - (c == ')' || c == ']' || c == '}');
    if (c == ';' || c == '{' || c == '}' || c == '#') statement = at;
    if (depth > kDeep || at - statement > kLongStatement) return true;
  }
  if (text.find('#') != std::string::npos) {
    constexpr std::size_t kManyMacros = 16;
    constexpr double kManyTokens = 4096;
    const MacroUse use = estimate_macros(text);
    if (use.macros > kManyMacros || use.tokens > kManyTokens || use.unclear) return true;
  }
  return false;
}

void try_in_child(const ShaderSource& source, const std::function<void()>& work) {
  const std::string& file = source.files.at(0);
  const pid_t child = fork();
  if (child < 0) throw UserError(file + ": cannot start a process to try the shader in: " + std::strerror(errno));
  if (child == 0) be_child(work);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU)
    throw UserError(file + ": glslang needs more than " + std::to_string(kMostSeconds) +
                    " s for this shader: simplify it");
  if (WIFEXITED(status) && WEXITSTATUS(status) == kOutOfMemory)
    throw UserError(file + ": glslang needs more than 1 GiB of memory for this shader: simplify it");
  if (WIFSIGNALED(status))
    throw UserError(file + ": glslang crashes on this shader (" + strsignal(WTERMSIG(status)) +
                    "): docs/hardening.md lists what it is known to crash on");
}

}  // namespace twinshade
