// Sets the members whose names the header's own includes would replace, and prints whether the shader has seen them.
#include "all_headers.h"
// First, as programs do.
#include "macros.h"

int main() {
  macros::Uniforms u;
#include "settings.inc"
  const macros::Outputs outputs = macros::shade(u, macros::Inputs{});
  std::printf("%s, %s\n", expected > 10 ? "many" : "few", outputs.sum_of_all == expected ? "all seen" : "not all seen");
#if !defined EOF || !defined emit || view_matrix != 1
#error the header has taken macros away
#endif
}
