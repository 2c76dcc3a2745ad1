// What generated C++ includes, and all it includes.
#pragma once

#include "cpu_shaders/runtime/aggregates.h"
#include "cpu_shaders/runtime/conversions.h"
#include "cpu_shaders/runtime/glsl_common.h"
#include "cpu_shaders/runtime/glsl_derivative.h"
#include "cpu_shaders/runtime/glsl_geometric.h"
#include "cpu_shaders/runtime/glsl_integer.h"
#include "cpu_shaders/runtime/glsl_packing.h"
#include "cpu_shaders/runtime/glsl_transcendental.h"
#include "cpu_shaders/runtime/indexing.h"
#include "cpu_shaders/runtime/invocation.h"
#include "cpu_shaders/runtime/memory.h"
#include "cpu_shaders/runtime/numbers.h"
#include "cpu_shaders/runtime/served.h"
#include "cpu_shaders/runtime/table.h"
#include "cpu_shaders/runtime/texture.h"
#include "cpu_shaders/runtime/texture_forms.h"
