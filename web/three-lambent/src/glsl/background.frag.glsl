// The environment behind everything, looked up as mirrors look it up.
//
// Before this text stand: environment.glsl, environment_map.glsl; LAMBENT_AIR and LAMBENT_SHAFTS, with
// what air_texels.glsl and air_behind.glsl say, or 0.

uniform mat4 worldFromClip;
uniform vec4 eye;  // as of the surfaces; in the world

in vec2 place;

#if LAMBENT_AIR
uniform mat3 assetFromWorld;  // without its translation
#endif

#if LAMBENT_SHAFTS
// What the shadows of things take from the air before it, as far as the asset reaches.
vec3 shaftCurtain(vec3 assetDirection) {
  vec3 direction = sunFromWorld * assetDirection;
  float metres = shaftDepths.y / max(dot(direction, shaftAxis), 1e-6);
  float cosine = clamp(dot(direction, towardsSun), -1.0, 1.0);
  return shafts(direction, metres) - airFromSun(airBetween(direction, metres), cosine);
}
#endif

void main() {
  vec3 direction = -eye.xyz;
  if (eye.w > 0.0) {
    vec4 far = worldFromClip * vec4(place, 0.0, 1.0);
    direction = far.xyz / far.w - eye.xyz;
  }
  gl_FragColor = vec4(environmentRadiance(direction), 1.0);
#if LAMBENT_AIR
  if (eye.w > 0.0) {
    vec3 towards = normalize(assetFromWorld * direction);
    gl_FragColor.rgb =
        seenBehindAir(airGround + assetFromWorld * eye.xyz, towards, gl_FragColor.rgb);
#if LAMBENT_SHAFTS
    gl_FragColor.rgb = max(gl_FragColor.rgb + shaftCurtain(towards), 0.0);
#endif
  }
#endif
#include <tonemapping_fragment>
#include <colorspace_fragment>
}
