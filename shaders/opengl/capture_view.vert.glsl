// A body as a camera sees it. Its depth is written by the fragment shader: planes that were fitted
// to an asset do not cut off what is around it.

layout(location = 0) in vec3 bodyPosition;

uniform mat4 clipFromBody;

out vec2 depthAndW;

void main() {
  vec4 clip = clipFromBody * vec4(bodyPosition, 1.0);
  depthAndW = clip.zw;
  gl_Position = vec4(clip.xy, 0.0, clip.w);
}
