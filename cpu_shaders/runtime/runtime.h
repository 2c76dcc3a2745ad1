// What generated C++ includes, and all it includes.
#pragma once

#include "cpu_shaders/runtime/aggregates.h"
#include "cpu_shaders/runtime/conversions.h"
#include "cpu_shaders/runtime/indexing.h"
#include "cpu_shaders/runtime/invocation.h"
#include "cpu_shaders/runtime/memory.h"
#include "cpu_shaders/runtime/numbers.h"
#include "cpu_shaders/runtime/table.h"
#include "cpu_shaders/runtime/texture.h"
