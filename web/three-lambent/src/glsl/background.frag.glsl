// The environment behind everything, looked up as mirrors look it up.
//
// Before this text stand: environment.glsl, environment_map.glsl.

uniform mat4 worldFromClip;
uniform vec4 eye;  // as of the surfaces; in the world

in vec2 place;

void main() {
  vec3 direction = -eye.xyz;
  if (eye.w > 0.0) {
    vec4 far = worldFromClip * vec4(place, 0.0, 1.0);
    direction = far.xyz / far.w - eye.xyz;
  }
  gl_FragColor = vec4(environmentRadiance(direction), 1.0);
#include <tonemapping_fragment>
#include <colorspace_fragment>
}
