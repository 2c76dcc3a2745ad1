// What a fragment has beside its inputs and outputs.
#version 450
in float x;
layout(location = 0) out vec2 slope;
layout(location = 1) out int id;

void main() {
  slope = vec2(dFdx(x), dFdy(x));
  id = gl_FrontFacing ? gl_PrimitiveID : -gl_PrimitiveID;
  gl_FragDepth = 0.25 * gl_FragCoord.z;
  if (x < 0.0) discard;
}
