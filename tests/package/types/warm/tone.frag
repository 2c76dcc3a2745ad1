#version 450
// Another shader of this name is in cold/: both are linked into one program.
in float x;
out float y;
void main() { y = x + 1.0; }
