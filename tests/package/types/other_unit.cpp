// Another unit of the same program that includes the same headers.
#include "initial.h"
#include "string.h"

#include <string.h>

float clamped_elsewhere(float x) { return string::shade({}, string::Inputs{.x = x}).clamped; }
float sum_elsewhere() { return initial::shade({}, initial::Inputs{}).sums[2]; }
std::size_t length_elsewhere(const char* text) { return strlen(text); }
