// What a mirror shows of the asset it belongs to: a cube map of all other surfaces as they are lit,
// drawn from a place in or at the mirror, and looked up where a ray meets what was drawn: it is
// followed across the map, by equal angles and then by halves, until it is no longer before what the
// map has there. So what is near stands where it does, wherever on the mirror it is seen. Where a ray
// passes behind what is in the map, nothing is known; the map along the ray's own direction stands in.

uniform samplerCube capture;  // radiance, and in alpha the distance from captureFrom: 0 where nothing is
uniform vec3 captureFrom;
uniform bool hasCapture;

const int kCaptureSteps = 32, kCaptureHalvings = 6;
const float kCaptureJump = 0.05;  // of a distance: what lies that much nearer is another surface

float capturedDistance(vec3 direction) {
  float distance = textureLod(capture, direction, 0.0).a;
  return distance > 0.0 ? distance : 1e30;
}

// Radiance, and 1 where the ray from `from` along a unit direction meets something; 0 where it leaves.
vec4 capturedAlong(vec3 from, vec3 direction) {
  if (!hasCapture) return vec4(0.0);
  vec3 found = direction;
  vec3 off = from - captureFrom;
  float near = length(off);
  vec3 start = near > 0.0 ? off / near : direction;
  float along = dot(start, direction);
  vec3 across = direction - along * start;
  float sine = length(across);
  if (sine > 1e-3) {
    across /= sine;
    float whole = atan(sine, along), before = 0.0;
    // At an angle a from `start` the ray is near sin(whole) / sin(whole - a) away.
    bool wasBefore = near < capturedDistance(start);
    for (int i = 1; i <= kCaptureSteps; ++i) {
      float angle = whole * float(i) / float(kCaptureSteps);
      vec3 d = cos(angle) * start + sin(angle) * across;
      float there = near * sine / max(sin(whole - angle), 1e-6);
      bool isBefore = there < capturedDistance(d);
      if (wasBefore && !isBefore) {
        float low = before, high = angle;
        for (int k = 0; k < kCaptureHalvings; ++k) {
          float middle = 0.5 * (low + high);
          vec3 m = cos(middle) * start + sin(middle) * across;
          if (near * sine / max(sin(whole - middle), 1e-6) < capturedDistance(m)) low = middle;
          else high = middle;
        }
        vec3 at = cos(high) * start + sin(high) * across;
        float r = near * sine / max(sin(whole - high), 1e-6);
        if (i == kCaptureSteps || r <= (1.0 + kCaptureJump) * capturedDistance(at)) {
          found = at;
          break;
        }
      }
      wasBefore = isBefore;
      before = angle;
    }
  }
  vec4 seen = textureLod(capture, found, 0.0);
  return seen.a > 0.0 ? vec4(seen.rgb, 1.0) : vec4(0.0);
}
