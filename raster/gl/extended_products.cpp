#include "raster/gl/extended_products.h"

#include <algorithm>
#include <array>

namespace twinshade::gl {
namespace {

constexpr std::array<const char*, 2> kFunctions = {"umulExtended", "imulExtended"};

std::string own_name(const std::string& function) { return "twinshade_" + function; }

bool is_extended_product(const Token& token) {
  return std::any_of(kFunctions.begin(), kFunctions.end(), [&](const char* f) { return token.text == f; });
}

}  // namespace

bool redirect_extended_products(std::vector<Token>& tokens) {
  bool any = false;
  for (std::size_t i = 0; i + 1 < tokens.size(); ++i) {
    if (!is_extended_product(tokens[i]) || tokens[i + 1].text != "(") continue;
    tokens[i].text = own_name(tokens[i].text);
    any = true;
  }
  return any;
}

std::string extended_product_functions() {
  std::string text = std::string("uniform uint ") + kUnknownZero + ";\n";
  for (const std::string function : kFunctions)
    for (const char* size : {"", "2", "3", "4"}) {
      const bool is_signed = function[0] == 'i';
      const std::string scalar = is_signed ? "int" : "uint", vector = is_signed ? "ivec" : "uvec";
      const std::string type = *size == '\0' ? scalar : vector + size;
      const std::string zero = scalar + "(" + kUnknownZero + ")";
      text += "void " + own_name(function) + "(" + type + " x, " + type + " y, out " + type + " high, out " + type +
              " low) { " + function + "(x ^ " + zero + ", y ^ " + zero + ", high, low); }\n";
    }
  return text;
}

}  // namespace twinshade::gl
