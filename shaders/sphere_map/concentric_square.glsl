// The unit disk as a square, concentric circles as concentric squares, area kept.
// Shirley and Chiu, A Low Distortion Map Between Disk and Square, 1997.
#include "exact/atan2.glsl"
#include "exact/length.glsl"
#include "exact/sin_cos.glsl"

vec2 disk_to_square(vec2 disk) {
  float radius = exact_length(disk);
  vec2 extent = abs(disk);
  bool steep = extent.y > extent.x;
  precise float angle = exact_atan2(steep ? extent.x : extent.y, steep ? extent.y : extent.x);  // 0 to pi/4
  precise float across = (radius * angle) * 1.27323954;                                         // 4/pi
  vec2 square = steep ? vec2(across, radius) : vec2(radius, across);
  return vec2(disk.x < 0.0 ? -square.x : square.x, disk.y < 0.0 ? -square.y : square.y);
}

vec2 square_to_disk(vec2 square) {
  vec2 extent = abs(square);
  bool steep = extent.y > extent.x;
  float radius = steep ? extent.y : extent.x;
  float across = steep ? extent.x : extent.y;
  precise float share = across / radius;
  precise float angle = (radius > 0.0 ? share : 0.0) * 0.785398163;  // pi/4
  precise float along_axis = radius * exact_cos(angle);
  precise float off_axis = radius * exact_sin(angle);
  vec2 disk = steep ? vec2(off_axis, along_axis) : vec2(along_axis, off_axis);
  return vec2(square.x < 0.0 ? -disk.x : disk.x, square.y < 0.0 ? -disk.y : disk.y);
}
