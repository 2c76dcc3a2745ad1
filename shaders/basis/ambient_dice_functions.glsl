// Ambient Dice: what its forms share. Iwanicki and Sloan, Ambient Dice, EGSR 2017.
//
// The vertices of an icosahedron, on the unit sphere, phi = (1 + sqrt5)/2, R = sqrt(1 + phi^2):
//   i = 0..3: (+-phi, +-1, 0)/R    i = 4..7: (0, +-phi, +-1)/R    i = 8..11: (+-1, 0, +-phi)/R
// Bit 0 of i: the first coordinate that is not zero is negative; bit 1: the second one. Opposite vertices: i and i ^ 3.
// Tangent frame of vertex v, for gradients: e1 = axis of its zero coordinate, e2 = v x e1.

// Coefficients i.x, i.y and i.z at once, i the name of an ivec3: an includer who can do better than three reads defines it.
#ifndef COEF_ONES
#define COEF_ONES(i, ones) ones[0] = COEF(i.x); ones[1] = COEF(i.y); ones[2] = COEF(i.z)
#endif

// Coordinates of vertex i that are not zero: the long one (phi/R) and the short one (1/R), with their signs.
vec2 dice_sides(int i) {
  bool first = (i & 1) != 0;
  bool second = (i & 2) != 0;
  return vec2((i < 8 ? first : second) ? -0.850650808 : 0.850650808,   // sqrt((5 + sqrt5)/10)
              (i < 8 ? second : first) ? -0.525731112 : 0.525731112);  // sqrt((5 - sqrt5)/10)
}

vec3 dice_vertex(int i) {
  vec2 sides = dice_sides(i);
  return i < 4 ? vec3(sides, 0.0) : i < 8 ? vec3(0.0, sides) : vec3(sides.y, 0.0, sides.x);
}

// Components of the vector g along e1 and e2 of vertex i.
vec2 dice_tangent(int i, vec3 g) {
  vec2 sides = dice_sides(i);
  vec3 turned = i < 4 ? g : i < 8 ? g.yzx : g.zxy;  // vertex i is (long, short, 0) here
  precise float second = turned.x * sides.y - turned.y * sides.x;
  return vec2(turned.z, second);
}

struct DiceTriangle {
  ivec3 vertex;
  vec3 barycentric;  // spherical: direction = sum of barycentric * vertex; none negative, sum 1 to 1.26 for unit directions
};

// The triangle that direction n points through. Each octant has one triangle of its own, of a vertex of each kind, and shares
// three with its neighbours: one of the three vertices is replaced by the mirror image of the next. Of the three tests at
// most one replaces; what is left of the barycentric coordinates cannot be negative then, whatever the rounding. Zero
// vector: all barycentric coordinates are 0; NaN: vertices in range, barycentric coordinates 0.
DiceTriangle dice_triangle(vec3 n) {
  int x = n.x < 0.0 ? 1 : 0;
  int y = n.y < 0.0 ? 1 : 0;
  int z = n.z < 0.0 ? 1 : 0;
  ivec3 own = ivec3(x + 2 * y, 4 + y + 2 * z, 8 + x + 2 * z);

  vec3 a = abs(n);
  precise vec3 large = a * 0.951056516;   // R/2
  precise vec3 middle = a * 0.587785252;  // R/(2 phi)
  precise vec3 small = a * 0.363271264;   // R/(2 phi^2)
  precise vec3 inside = (large + small.yzx) - middle.zxy;
  precise vec3 beyond = (large + middle.zxy) - small.yzx;
  precise vec3 side = middle * 2.0;
  bool over_first = inside.x < 0.0;
  bool over_second = !over_first && inside.y < 0.0;
  bool over_third = !over_first && !over_second && inside.z < 0.0;

  DiceTriangle triangle;
  triangle.vertex = over_first    ? ivec3(own.z ^ 1, own.y, own.z)
                    : over_second ? ivec3(own.x, own.x ^ 2, own.z)
                    : over_third  ? ivec3(own.x, own.y, own.y ^ 2)
                                  : own;
  vec3 b = over_first    ? vec3(-inside.x, side.y, beyond.x)
           : over_second ? vec3(beyond.y, -inside.y, side.z)
           : over_third  ? vec3(side.x, beyond.z, -inside.z)
                         : inside;
  triangle.barycentric = vec3(b.x > 0.0 ? b.x : 0.0, b.y > 0.0 ? b.y : 0.0, b.z > 0.0 ? b.z : 0.0);
  return triangle;
}

// Cosines between n and vertices 0, 4, 8, and 1, 5, 9; those of the others are minus these.
struct DiceCosines {
  vec3 first, second;
};

DiceCosines dice_cosines(vec3 n) {
  precise vec3 long_part = n * 0.850650808;   // phi/R
  precise vec3 short_part = n * 0.525731112;  // 1/R
  precise vec3 first = long_part + short_part.yzx;
  precise vec3 second = vec3(short_part.y, short_part.z, long_part.z) - vec3(long_part.x, long_part.y, short_part.x);
  DiceCosines cosines;
  cosines.first = first;
  cosines.second = second;
  return cosines;
}

float dice_cosine(DiceCosines cosines, int i) {
  int place = i & 3;
  vec3 triple = place == 0 || place == 3 ? cosines.first : cosines.second;
  float cosine = i < 4 ? triple.x : i < 8 ? triple.y : triple.z;
  return place < 2 ? cosine : -cosine;
}
