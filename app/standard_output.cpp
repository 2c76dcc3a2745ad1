#include "app/standard_output.h"

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>

#include "base/error.h"

namespace twinshade {
namespace {

int stdout_error = 0;  // errno of the first write that failed; stdout is the process's, and so is this

// Not ignored: what is ignored stays so in the programs that this one starts.
void do_nothing(int) {}

}  // namespace

void survive_readers_that_leave() { std::signal(SIGPIPE, do_nothing); }

void write_to_stdout(const std::string& text, ResultsInFiles files) {
  if (stdout_error != 0) return;
  if (std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0) return;
  stdout_error = errno;
  if (files == ResultsInFiles::some) return;
  if (stdout_error == EPIPE) {
    std::signal(SIGPIPE, SIG_DFL);
    std::raise(SIGPIPE);
  }
  require_stdout_written();
}

void require_stdout_written() {
  if (stdout_error != 0 && stdout_error != EPIPE)
    throw UserError(std::string("stdout: cannot be written: ") + std::strerror(stdout_error));
}

}  // namespace twinshade
