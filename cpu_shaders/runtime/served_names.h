// The functions of shaders/exact/ and shaders/sphere_map/ that the runtime serves by equivalents of its own (served.h):
// what the translator looks a function up by. Everything else runs as it is written.
#pragma once

#include <string_view>

namespace twinshade {

struct ServedFunction {
  std::string_view name;
  std::string_view result;
  std::string_view parameters;  // GLSL types, in order, separated by commas; "[]": an array of any length
};

// served::has_<name><N> says whether policy N has it, served::<name><N>(...) is it.
inline constexpr ServedFunction kServedFunctions[] = {
    {"exact_exp2", "float", "float"},
    {"exact_log2", "float", "float"},
    {"exact_pow", "float", "float,float"},
    {"exact_sin", "float", "float"},
    {"exact_cos", "float", "float"},
    {"exact_atan2", "float", "float,float"},
    {"exact_acos", "float", "float"},
    {"exact_asin", "float", "float"},
    {"exact_fetch", "vec4", "sampler2D,ExactTaps"},
    {"exact_fetch", "vec4", "sampler2DArray,ExactTaps,int"},
    {"exact_fetch_ones", "void", "sampler2DArray,ExactTaps,ExactTaps,ivec3,vec3[]"},
    {"exact_fetch_threes", "void", "sampler2DArray,ExactTaps,ExactTaps,ivec3,mat3x3[]"},
    {"exact_fetch_layers", "void", "sampler2DArray,ExactTaps,vec4[]"},
    {"exact_fetch_colors", "void", "sampler2DArray,ExactTaps,vec3[]"},
    {"exact_fetch_colors", "void", "sampler2DArray,ExactTaps,ExactTaps,vec3[]"},
    {"sphere_map_fetch", "vec4", "sampler2DArray,SphereMapTaps,int,int"},
    {"sphere_map_fetch_colors", "void", "sampler2DArray,SphereMapTaps,int,vec3[]"},
    {"exact_fetch_pair", "mat2x4", "sampler2DArray,sampler2DArray,ExactTaps,int"},
};

}  // namespace twinshade
