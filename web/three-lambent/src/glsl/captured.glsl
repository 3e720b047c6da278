// What a local capture (shaders/local_capture.glsl) keeps of a surface, in place of what is shown.

uniform bool capturing;     // else the surface is shown
uniform mat3 worldFromAsset;
uniform vec2 captureScale;  // times radiance and times distances: so that halves hold them

vec4 keptByCapture(vec3 radiance, float distance) {
  return vec4(min(captureScale.x * radiance, vec3(65000.0)), captureScale.y * distance);
}
