// Names that generated headers and members of their structs cannot have.
#pragma once

#include <string>

namespace twinshade {

// Keywords of C++ and of its compilers, what generated headers say themselves ("Uniforms", "std" ...) and macros that a
// program which includes them has or may well have: those of the standard headers of C and C++ that stand without
// arguments, <math.h>'s constants, the compilers' "linux" and "unix". Macros with arguments do no harm: no member is
// followed by "(". Nor do macros that are missing here, while nobody names the member: the header puts them aside.
bool is_reserved_name(const std::string& name);

// Why no header and its namespace can have this name: no identifier, a keyword or such a macro, a file that would stand
// in for the system's. Empty where they can. Names of C's functions pass: which of them a program declares is not known
// here.
std::string header_name_refusal(const std::string& name);

}  // namespace twinshade
