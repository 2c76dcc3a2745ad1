// Names that members of generated structs cannot have.
#pragma once

#include <string>

namespace twinshade {

// Keywords of C++, what generated headers say themselves ("Uniforms", "std" ...) and macros that a program which
// includes them may well have: those of the standard headers of C and C++ that stand without arguments, <math.h>'s
// constants, the compilers' "linux" and "unix". Macros with arguments do no harm: no member is followed by "(".
bool is_reserved_name(const std::string& name);

}  // namespace twinshade
