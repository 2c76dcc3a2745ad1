// Refraction, orientation, distance: GLSL 4.50 specification, 8.5, with sums in the order of the components.
#include "exact/length.glsl"

#define EXACT_GEOMETRY(type)                                                                       \
  float exact_distance(type a, type b) {                                                           \
    precise type difference = a - b;                                                               \
    return exact_length(difference);                                                               \
  }                                                                                                \
  type exact_faceforward(type normal, type incident, type reference) {                             \
    return exact_dot(reference, incident) < 0.0 ? normal : -normal;                                \
  }                                                                                                \
  type exact_refract(type incident, type normal, float eta) {                                      \
    precise float cosine = exact_dot(normal, incident);                                            \
    precise float k = 1.0 - eta * eta * (1.0 - cosine * cosine);                                   \
    precise float along = eta * cosine + sqrt(k);                                                  \
    precise type refracted = incident * eta - normal * along;                                      \
    return k < 0.0 ? type(0.0) : refracted;                                                        \
  }

EXACT_GEOMETRY(vec2)
EXACT_GEOMETRY(vec3)
EXACT_GEOMETRY(vec4)
