// Hermite interpolation t^2 (3 - 2 t), t = (x - a) / (b - a) clamped to [0, 1].

float exact_smoothstep(float a, float b, float x) {
  precise float t = (x - a) / (b - a);
  t = clamp(t, 0.0, 1.0);
  precise float value = t * (t * (3.0 - 2.0 * t));
  return value;
}
