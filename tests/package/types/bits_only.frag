// Bits of a float: not in double.
#version 450
flat in uint word;
out float value;

void main() {
  value = uintBitsToFloat(word);
}
