// Programs that this process waits for, and that do not outlive it.
#pragma once

#include <chrono>
#include <string>
#include <vector>

namespace twinshade {

constexpr std::chrono::seconds kCompileTime{
    600};  // by the clock: more than the processor time that a compiler may take

struct ProgramResult {
  int status = -1;          // exit status; -1: could not be started, or was killed
  std::string output = {};  // stdout and stderr, as far as anyone reads them
  bool timed_out = false;   // killed since it had not ended in time
  bool started = true;
};
// Runs words[0], a path, and waits for it. It and what it starts may take 300 s of processor time and 4 GiB of
// addresses each, and have a folder for temporary files of their own: in TMPDIR, or in the cache. When it has ended,
// when `time` has passed, and when this process ends in whatever way, what is left of them is killed and the folder
// removed; in the last case what is named `made`, or begins like it up to its ending, is removed, too: files half made,
// and folders.
ProgramResult run_program(const std::vector<std::string>& words, std::chrono::milliseconds time,
                          const std::string& made = {});

}  // namespace twinshade
