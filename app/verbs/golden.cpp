// golden: reference images, kept with a manifest under version control, and frames held to them.
#include "app/golden/verbs.h"

#include <CLI/CLI.hpp>

#include <vector>

#include "base/error.h"
#include "base/names.h"

namespace twinshade {

Verb add_golden(CLI::App& app) {
  CLI::App* golden = app.add_subcommand(
      "golden", "reference images: update makes them, check holds frames to them, remove drops them");
  const std::vector<Verb> commands{add_golden_update(*golden), add_golden_check(*golden), add_golden_remove(*golden)};
  for (const Verb& verb : commands)
    for (CLI::Option* option : verb.command->get_options())
      if (option->nonpositional()) option->allow_extra_args(false);  // as main() says of its verbs
  golden->allow_extras();                                            // told below, better than CLI11 does
  return {golden, [golden, commands] {
            for (const Verb& verb : commands)
              if (verb.command->parsed()) {
                require_names(*verb.command);
                return verb.run();
              }
            if (const std::vector<std::string> extra = golden->remaining(); !extra.empty())
              throw UserError(unknown_name_message("command of golden", extra.front(), {"update", "check", "remove"}));
            throw UserError("golden: say update, check or remove (twinshade golden --help)");
          }};
}

}  // namespace twinshade
