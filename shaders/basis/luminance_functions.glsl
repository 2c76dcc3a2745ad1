// Luminance of linear RGB with the primaries of BT.709.

float luminance(vec3 rgb) {
  precise float value = (rgb.x * 0.212600000 + rgb.y * 0.715200000) + rgb.z * 0.0722000000;  // BT.709
  return value;
}
