// doctest's main, after the one of the GL workers that these tests start from this very program.
#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>

#include "raster/gl/gl_renderer.h"

int main(int argc, char** argv) {
  if (const auto exit_code = twinshade::run_gl_worker_if_asked(argc, argv)) return *exit_code;
  doctest::Context context(argc, argv);
  return context.run();
}
