// twinshade: one GLSL shading function, two machines, compared bit by bit.
#include <fcntl.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <new>
#include <sstream>

#include "app/options.h"
#include "app/standard_output.h"
#include "base/error.h"
#include "base/names.h"
#include "base/utf8.h"
#include "raster/renderer.h"
#if TWINSHADE_HAS_GL
#include "raster/gl/gl_renderer.h"
#endif

namespace twinshade {
namespace {

int fail(const std::string& what) {
  std::fprintf(stderr, "twinshade: %s\n", one_line(what).c_str());  // fmt::print throws where stderr is closed
  return 2;
}

// CLI11's own words for a mistyped verb do not say which ones there are.
void require_verb(int argc, char** argv, const std::vector<Verb>& verbs) {
  if (argc < 2 || argv[1][0] == '-') return;
  std::vector<std::string> names;
  for (const Verb& verb : verbs) names.push_back(verb.command->get_name());
  if (std::find(names.begin(), names.end(), argv[1]) == names.end())
    throw UserError(unknown_name_message("verb", argv[1], names));
}

// CLI11's own words for an option that is given twice, or without its value, take some thought.
std::string usage_words(const CLI::ParseError& error) {
  const std::string text = one_line(error.what());
  constexpr std::string_view kOnce = ": At Most 1 required but received ", kOne = ": 1 required ",
                             kMissing = " missing";
  if (const std::size_t at = text.find(kOnce); at != std::string::npos)
    return text.substr(0, at) + " is given " + text.substr(at + kOnce.size()) + " times: give it once";
  if (const std::size_t at = text.find(kOne); at != std::string::npos && text.ends_with(kMissing)) {
    const std::size_t type = at + kOne.size();
    return text.substr(0, at) + ": its value is missing: " + text.substr(type, text.size() - kMissing.size() - type);
  }
  return text;
}

int run_verb(const Verb& verb) {
  try {
    return verb.run();
  } catch (const std::bad_alloc&) {
    if (!verb.command->get_option_no_throw("--size")) throw;
    return fail("out of memory; try a smaller --size, --lightmap or --volume, or fewer --triangles");
  }
}

int run(int argc, char** argv) {
  CLI::App app("One GLSL shading function, two machines, compared bit by bit.", "twinshade");
  app.set_version_flag("--version", TWINSHADE_VERSION);
  app.require_subcommand(1);
  const std::vector<Verb> verbs{add_list(app),      add_bake(app),    add_render(app),    add_compare(app),
                                add_translate(app), add_check(app),   add_bench(app),     add_experiment(app),
                                add_frontier(app),  add_choose(app),  add_stability(app), add_eval(app),
                                add_mediump(app),   add_profile(app), add_golden(app)};
  // A list is one word, with commas, or several options: what follows it is the verb's (check --on cpu,egl my.frag).
  for (const Verb& verb : verbs)
    for (CLI::Option* option : verb.command->get_options())
      if (option->nonpositional()) option->allow_extra_args(false);
  try {
    require_verb(argc, argv, verbs);
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) {  // --help, --version
      std::ostringstream text;
      const int code = app.exit(error, text);
      write_to_stdout(text.str(), ResultsInFiles::none);
      return code;
    }
    std::string verb;
    for (auto commands = app.get_subcommands(); !commands.empty(); commands = commands.front()->get_subcommands())
      verb += commands.front()->get_name() + " ";
    return fail(usage_words(error) + " (twinshade " + verb + "--help lists what there is)");
  }
  for (const Verb& verb : verbs)
    if (verb.command->parsed()) {
      require_names(*verb.command);
      const int code = run_verb(verb);
      require_stdout_written();
      return code;
    }
  return 2;
}

int run_and_report(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::bad_alloc&) {
    return fail("out of memory; give it less at once, or more memory (ulimit -v, the container's limit)");
  } catch (const std::exception& error) {  // UserError, BackendError
    return fail(error.what());
  }
}

// A program may be started without stdin, stdout or stderr: then no file or socket gets their numbers, and writing to
// them fails as it should.
void keep_standard_numbers() {
  for (int fd = 0; fd <= 2; ++fd)
    if (fcntl(fd, F_GETFD) < 0) open("/dev/null", O_RDONLY);
}

// A file may grow to a limit (ulimit -f) only: then writing to it fails as on a full disk, and what is half-written is
// removed, instead of ending the process without a word. The programs that this one starts inherit it: g++ says that
// its file is too large, where the signal would make it ask for a bug report.
void survive_limits_of_files() { std::signal(SIGXFSZ, SIG_IGN); }

}  // namespace
}  // namespace twinshade

int main(int argc, char** argv) {
  twinshade::survive_limits_of_files();
#if TWINSHADE_HAS_GL
  if (const std::optional<int> worker = twinshade::run_gl_worker_if_asked(argc, argv)) return *worker;
#endif
  twinshade::survive_readers_that_leave();
  twinshade::keep_standard_numbers();
  return twinshade::run_and_report(argc, argv);
}
