// libFuzzer: any bytes as a file of cases. Read, or refused with a UserError: nothing else.
#include <string_view>

#include "base/error.h"
#include "evaluate/cases.h"

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  using namespace twinshade;
  try {
    parse_cases(std::string_view(reinterpret_cast<const char*>(data), size), "fuzz.json");
  } catch (const UserError&) {
  }
  return 0;
}
