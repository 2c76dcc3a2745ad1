#version 450
in float x;
out float half_of_x;

void main() {
  precise float value = x * 0.5;
  half_of_x = value;
}
