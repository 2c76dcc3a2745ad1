// Names that generated headers and members of their structs cannot have.
#pragma once

#include <string>

namespace twinshade {

// Keywords of C++, what generated headers say themselves ("Uniforms", "std" ...) and macros that a program which
// includes them may well have: those of the standard headers of C and C++ that stand without arguments, <math.h>'s
// constants, the compilers' "linux" and "unix". Macros with arguments do no harm: no member is followed by "(".
bool is_reserved_name(const std::string& name);

// Why no header and its namespace can have this name: no identifier, a keyword or such a macro, a file that would stand
// in for the system's. Empty where they can. Names of C's functions pass: which of them a program declares is not known
// here.
std::string header_name_refusal(const std::string& name);

}  // namespace twinshade
