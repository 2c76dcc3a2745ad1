#version 450
out float r;
void main() { r = 1.0; }
