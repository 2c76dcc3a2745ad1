// What generated C++ includes, and all it includes: number types, aggregates, indexing.
#pragma once

#include "cpu_shaders/runtime/aggregates.h"
#include "cpu_shaders/runtime/indexing.h"
#include "cpu_shaders/runtime/numbers.h"
