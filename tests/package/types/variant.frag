// One shader whose variants are made by defines.
#version 330
out float taps;
void main() {
#ifdef WIDE
  taps = float(TAPS) * 100.0;
#else
  taps = float(TAPS);
#endif
}
