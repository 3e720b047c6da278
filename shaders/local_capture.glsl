// What a mirror shows of the asset it belongs to: a cube map of all other surfaces as they are lit,
// drawn from a place in or at the mirror, and looked up where a ray meets what was drawn. The ray is
// followed across the map, by equal angles and then by halves, until it is no longer before what the
// map has there: so what is near stands where it does, wherever on the mirror it is seen. Where a
// ray passes behind what is in the map, nothing is known; what the map has beside that stands in.
//
// The map is to be looked up without a filter: nothing lies between one surface and another.

uniform samplerCube capture;  // radiance; in alpha the distance from captureFrom, 0: nothing is there
uniform vec3 captureFrom;
uniform bool hasCapture;

const float kCaptureStep = 0.08;  // radians
const int kCaptureHalvings = 6;
const float kCaptureJump = 0.1;  // of a distance: what lies that much nearer is another surface
// Of a distance: so thick is what ends, and so much a surface may slope there over half a texel.
const float kCaptureThin = 0.02, kCaptureSlope = 0.03;
const float kCaptureAside = 1.5;  // texels
const float kNothingCaptured = 1e30;

float captureDistance(vec3 direction) {
  float here = textureLod(capture, direction, 0.0).a;
  return here > 0.0 ? here : kNothingCaptured;
}

// The four texels around a direction: towards the middle of the first, from there to the others,
// and how far the direction is on the way to them, 0 … 1.
struct CaptureTexels {
  vec3 first, u, v;
  vec2 at;
};

CaptureTexels captureTexels(vec3 direction) {
  float texels = float(textureSize(capture, 0).x);
  vec3 size = abs(direction);
  float largest = max(size.x, max(size.y, size.z));
  vec3 axis = vec3(greaterThanEqual(size, vec3(largest)));  // of the face
  vec3 onFace = direction / largest, cell = (0.5 * onFace + 0.5) * texels - 0.5, low = floor(cell);
  CaptureTexels around;
  around.first = mix((low + 0.5) * (2.0 / texels) - 1.0, onFace, axis);
  around.u = axis.x > 0.0 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0);
  around.v = axis.z > 0.0 ? vec3(0.0, 1.0, 0.0) : vec3(0.0, 0.0, 1.0);
  around.at = vec2(dot(cell - low, around.u), dot(cell - low, around.v));
  around.u *= 2.0 / texels;
  around.v *= 2.0 / texels;
  return around;
}

// Interpolated over a surface, but not between one and another, or nothing.
float captureDistanceBetween(vec3 direction) {
  CaptureTexels around = captureTexels(direction);
  float here = captureDistance(direction);
  vec3 first = around.first, second = first + around.v;
  float between =
      mix(mix(captureDistance(first), captureDistance(first + around.u), around.at.x),
          mix(captureDistance(second), captureDistance(second + around.u), around.at.x), around.at.y);
  return abs(between - here) < kCaptureJump * here ? between : here;
}

// Radiance times the share of something in what lies in a direction, and that share.
vec4 captureAt(vec3 direction) {
  CaptureTexels around = captureTexels(direction);
  vec4 sum = vec4(0.0);
  for (int corner = 0; corner < 4; ++corner) {
    float j = float(corner & 1), k = float(corner >> 1);
    vec4 texel = textureLod(capture, around.first + j * around.u + k * around.v, 0.0);
    float weight = mix(1.0 - around.at.x, around.at.x, j) * mix(1.0 - around.at.y, around.at.y, k);
    if (texel.a > 0.0) sum += weight * vec4(texel.rgb, 1.0);
  }
  // Borders lie where there is as much of something as of nothing.
  float share = clamp(4.0 * sum.a - 1.5, 0.0, 1.0);
  return sum.a > 0.0 ? vec4(sum.rgb * (share / sum.a), share) : sum;
}

// Radiance of what the ray from `from` along a unit direction meets, and 1; 0 where it leaves. At
// borders alpha is between them, and radiance times it.
vec4 capturedAlong(vec3 from, vec3 direction) {
  if (!hasCapture) return vec4(0.0);
  vec3 off = from - captureFrom, normal = cross(off, direction);
  float away = length(normal), near = length(off);  // of the ray, and of its beginning
  if (away <= 1e-3 * near || near <= 0.0) return captureAt(direction);
  // Seen from captureFrom the ray begins at `start` and ends at `direction`; in a direction between
  // them its distance is `away` by the sine of what is left of the angle.
  normal /= away;
  vec3 start = off / near;
  float whole = atan(away, dot(off, direction));
  int steps = int(whole / kCaptureStep) + 2;
  float angle = whole / float(steps), turn = 2.0 * cos(angle);
  float texel = 2.0 / float(textureSize(capture, 0).x);  // radians, in the middle of a face

  vec3 last = start, here = cos(angle) * start + sin(angle) * cross(normal, start);
  vec3 beside = direction;
  // What it begins at is there as texels have it.
  bool wasBefore = near < (1.0 + kCaptureSlope) * captureDistance(start);
  for (int i = 1; i <= steps; ++i) {
    float there = away / max(length(cross(here, direction)), 1e-6);
    bool isBefore = there < captureDistance(here);
    if (wasBefore && !isBefore) {
      vec3 low = last, high = here;
      for (int k = 0; k < kCaptureHalvings; ++k) {
        vec3 middle = normalize(low + high);
        there = away / max(length(cross(middle, direction)), 1e-6);
        if (there < captureDistanceBetween(middle)) low = middle;
        else high = middle;
      }
      // It meets a surface that was behind it, or the border of one.
      there = away / max(length(cross(high, direction)), 1e-6);
      float met = captureDistanceBetween(high), behind = captureDistance(low);
      float slope = abs(captureDistance(high + texel * cross(normal, high)) - met);
      if (there <= (1.0 + kCaptureThin) * met + min(0.5 * slope, kCaptureSlope * met) ||
          behind <= (1.0 + kCaptureJump) * met)
        return captureAt(high);
      beside = low - kCaptureAside * texel * cross(normal, low);
    }
    wasBefore = isBefore;
    vec3 next = turn * here - last;
    last = here;
    here = next;
  }
  return wasBefore ? vec4(0.0) : captureAt(beside);
}
