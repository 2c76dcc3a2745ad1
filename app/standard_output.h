// stdout, whose reader may have enough of it (head), and whose disk may be full.
#pragma once

#include <string>

namespace twinshade {

// A reader that leaves a pipe ends the program where that has nothing else to do, as any other, but no sooner: results
// may still go to files. What this program starts does as it always did.
void survive_readers_that_leave();

// Whether results go to files, too: perhaps after the text.
enum class ResultsInFiles { none, some };

// Writes all of `text`, at once. Where its reader has left, that is the reader's choice: it and what follows are
// dropped without a word, and the process ends by SIGPIPE unless `files` are still to be written. Where it cannot be
// written otherwise, UserError: at once, or, with files, from require_stdout_written, and what follows is dropped.
void write_to_stdout(const std::string& text, ResultsInFiles files);

// UserError for what write_to_stdout could not write and has not said; to be called last.
void require_stdout_written();

}  // namespace twinshade
