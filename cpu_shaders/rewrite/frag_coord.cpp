#include "cpu_shaders/rewrite/frag_coord.h"

#include "cpu_shaders/lint/tokens.h"
#include "cpu_shaders/rewrite/token_edits.h"

namespace twinshade {

ShaderSource frag_coord_as_input(const ShaderSource& source) {
  using namespace lint_detail;
  const TokenList tokens = tokenize(source);
  TokenEdits edits(tokens);
  for (std::size_t i = 0; i < tokens.tokens.size(); ++i)
    if (tokens.tokens[i].text == "gl_FragCoord") edits.replace(i, kRowFragCoord);
  ShaderSource result = source;
  result.text = edits.head(source) + "in vec4 " + kRowFragCoord + ";\n" + edits.lines();
  return result;
}

}  // namespace twinshade
