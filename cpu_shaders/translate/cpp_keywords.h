// Words that cannot be names in C++.
#pragma once

#include <string>

namespace twinshade::spirv {

// Keywords of C++ and the few other words, "std" and "NULL" among them, that generated code never declares.
bool is_cpp_keyword(const std::string& name);

}  // namespace twinshade::spirv
