#include "cpu_shaders/rewrite/frag_coord.h"

#include "cpu_shaders/rewrite/token_edits.h"

namespace twinshade {

ShaderSource frag_coord_as_input(const ShaderSource& source) {
  using namespace lint_detail;
  const TokenList tokens = tokenize(source);
  TokenEdits edits(tokens);
  const auto& list = tokens.tokens;
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (list[i].text != "gl_FragCoord") continue;
    edits.replace(i, kRowFragCoord);
    // in vec4 gl_FragCoord; says what is so anyway.
    const bool redeclared = i >= 2 && i + 1 < list.size() && list[i - 1].text == "vec4" && list[i + 1].text == ";";
    if (!redeclared) continue;
    std::size_t first = i - 1;
    while (first > 0 && list[first - 1].text != ";" && list[first - 1].text != "}") --first;
    for (std::size_t k = first; k <= i + 1; ++k) edits.replace(k, "");
  }
  ShaderSource result = source;
  // ES may not have said yet what a float's precision is.
  result.text =
      edits.head(source) + (source.es ? "in highp vec4 " : "in vec4 ") + kRowFragCoord + ";\n" + edits.lines();
  return result;
}

}  // namespace twinshade
