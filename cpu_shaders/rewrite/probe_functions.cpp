#include "cpu_shaders/rewrite/probe_functions.h"

namespace twinshade::lint_detail {
namespace {

constexpr const char* kPrelude = R"(flat in int twinshadeprobe_target;
out uvec4 twinshadeprobe_value;
out uvec4 twinshadeprobe_place;
int twinshadeprobe_count;
bool twinshadeprobe_kept_bool;
int twinshadeprobe_kept_int;
uint twinshadeprobe_kept_uint;
void twinshadeprobe_bits(int value, uvec4 bits, uint type, uvec2 elements) {
  if (twinshadeprobe_count == twinshadeprobe_target) {
    twinshadeprobe_value = bits;
    twinshadeprobe_place = uvec4(uint(value + 1), 0u, type | elements.x, elements.y);
  }
  ++twinshadeprobe_count;
  twinshadeprobe_place.y = uint(twinshadeprobe_count);
}
void twinshadeprobe_globals();
)";

}  // namespace

std::string probe_functions() {
  std::string text = kPrelude;
  struct Row {
    const char *scalar, *prefix;
  };
  unsigned scalar = 0;  // in the order of enum Scalar
  for (const Row& row : {Row{"float", "vec"}, Row{"int", "ivec"}, Row{"uint", "uvec"}, Row{"bool", "bvec"}}) {
    for (unsigned n = 1; n <= 4; ++n) {
      const std::string type = n == 1 ? row.scalar : row.prefix + std::to_string(n);
      const std::string padding = n == 1 ? ", 0, 0, 0" : n == 2 ? ", 0, 0" : n == 3 ? ", 0" : "";
      const std::string four = scalar == 0 ? "floatBitsToUint(vec4(v" + padding + "))" : "uvec4(v" + padding + ")";
      const std::string told = std::to_string(scalar | n << 2) + "u";
      text += "void twinshadeprobe_tell(int i, uvec2 e, " + type + " v) { twinshadeprobe_bits(i, " + four + ", " +
              told + ", e); }\n";
      text += type + " " + kThrough + "(int i, " + type + " v) { twinshadeprobe_tell(i, uvec2(0u), v); return v; }\n";
    }
    ++scalar;
  }
  for (int columns = 2; columns <= 4; ++columns)
    for (int rows = 2; rows <= 4; ++rows) {
      const std::string type = "mat" + std::to_string(columns) + (rows == columns ? "" : "x" + std::to_string(rows));
      text += type + " " + kThrough + "(int i, " + type + " m) {";
      for (int c = 0; c < columns; ++c)
        text += " twinshadeprobe_tell(i + " + std::to_string(c) + ", uvec2(0u), m[" + std::to_string(c) + "]);";
      text += " return m; }\n";
    }
  return text;
}

}  // namespace twinshade::lint_detail
