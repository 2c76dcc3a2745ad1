#version 450
layout(location = 0) in float x;
layout(location = 0) out vec4 answer;
layout(location = 1) out vec4 slopes;
void main() {
  answer = vec4(gl_FragCoord.xy, gl_FrontFacing ? 1.0 : 2.0, float(gl_PrimitiveID));
  float plane = gl_FragCoord.x * 3.0 + gl_FragCoord.y * 5.0;
  vec2 both = vec2(plane, plane * plane);
  if (x >= 0.0) slopes = vec4(dFdx(plane), dFdyFine(both).x, fwidth(plane), dFdx(both.y));
  gl_FragDepth = 0.125 + gl_FragCoord.x * 0.01;
  if (gl_FragCoord.y > 3.0) gl_FragDepth = 0.75;
}
