// In place of sphere_map/cube_dx9.glsl where OpenGL is timed: the other cube map there is filtered within its faces too.
#include "sphere_map/cube.glsl"
