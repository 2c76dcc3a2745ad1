// Named like a header of C and of C++: the system's must still be found.
#version 450
in float x;
out float clamped;

void main() {
  clamped = clamp(x, 0.0, 1.0);
}
