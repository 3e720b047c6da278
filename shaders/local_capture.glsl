// What a mirror shows of the asset it belongs to: a cube map of all other surfaces as they are lit,
// drawn from a place in or at the mirror, and looked up where a ray meets what was drawn: it is
// followed across the map, by equal angles and then by halves, until it is no longer before what the
// map has there. So what is near stands where it does, wherever on the mirror it is seen. Where a ray
// passes behind what is in the map, nothing is known; what the map has beside that stands in.

uniform samplerCube capture;  // radiance, and in alpha the distance from captureFrom: 0 where nothing is
uniform vec3 captureFrom;
uniform bool hasCapture;

const float kCaptureStep = 0.06;  // radians
const int kCaptureHalvings = 6;
const float kCaptureJump = 0.1;   // of a distance: what lies that much nearer is another surface
// Of a distance: so thick is what ends, and so much more a surface may slope over half a texel there.
const float kCaptureThin = 0.02, kCaptureSlope = 0.03;
const float kCaptureAside = 1.5;  // texels
const float kNothingCaptured = 1e30;

// 1 for the axis of the face that a direction lies on.
vec3 captureAxis(vec3 direction) {
  vec3 size = abs(direction);
  return vec3(greaterThanEqual(size, vec3(max(size.x, max(size.y, size.z)))));
}

// In texels from the corner of the face; along its axis something else.
vec3 captureCell(vec3 direction, float texels) {
  vec3 size = abs(direction);
  return (0.5 * direction / max(size.x, max(size.y, size.z)) + 0.5) * texels;
}

vec4 captureTexel(vec3 direction, vec3 middle, float texels) {
  vec3 size = abs(direction);
  vec3 at = middle * (2.0 / texels) - 1.0;
  vec3 onFace = direction / max(size.x, max(size.y, size.z));
  return textureLod(capture, mix(at, onFace, captureAxis(direction)), 0.0);
}

// Of the texel that lies in a direction: there the map mixes nothing.
float captureTexelDistance(vec3 direction) {
  float texels = float(textureSize(capture, 0).x);
  float here = captureTexel(direction, floor(captureCell(direction, texels)) + 0.5, texels).a;
  return here > 0.0 ? here : kNothingCaptured;
}

// Interpolated over a surface, but not between one and another, or nothing.
float captureDistance(vec3 direction) {
  float here = captureTexelDistance(direction);
  float between = textureLod(capture, direction, 0.0).a;
  return abs(between - here) < kCaptureJump * here ? between : here;
}

// Radiance times the share of something in what lies in a direction, and that share.
vec4 captureAt(vec3 direction) {
  float texels = float(textureSize(capture, 0).x);
  vec3 cell = captureCell(direction, texels) - 0.5, axis = captureAxis(direction);
  vec3 low = floor(cell), high = cell - low;
  // The two axes that the face has.
  vec3 u = axis.x > 0.0 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0);
  vec3 v = axis.z > 0.0 ? vec3(0.0, 1.0, 0.0) : vec3(0.0, 0.0, 1.0);
  vec4 sum = vec4(0.0);
  for (int corner = 0; corner < 4; ++corner) {
    float j = float(corner & 1), k = float(corner >> 1);
    vec4 texel = captureTexel(direction, low + j * u + k * v + 0.5, texels);
    float weight = mix(1.0 - dot(high, u), dot(high, u), j) * mix(1.0 - dot(high, v), dot(high, v), k);
    if (texel.a > 0.0) sum += weight * vec4(texel.rgb, 1.0);
  }
  // Borders lie where there is as much of something as of nothing.
  float share = clamp(4.0 * sum.a - 1.5, 0.0, 1.0);
  return sum.a > 0.0 ? vec4(sum.rgb * (share / sum.a), share) : sum;
}

// Radiance of what the ray from `from` along a unit direction meets, and 1; 0 where it leaves; between
// them where borders are crossed, times the share that alpha is.
vec4 capturedAlong(vec3 from, vec3 direction) {
  if (!hasCapture) return vec4(0.0);
  vec3 off = from - captureFrom, normal = cross(off, direction);
  float away = length(normal), near = length(off);  // of the ray, and of its beginning
  if (away <= 1e-3 * near || near <= 0.0) return captureAt(direction);
  // Seen from captureFrom the ray begins at `start` and ends at `direction`; in a direction between them
  // it is `away` by the sine of what is left of the angle away.
  normal /= away;
  vec3 start = off / near, across = cross(normal, start);
  float whole = atan(away, dot(off, direction));
  int steps = int(whole / kCaptureStep) + 2;
  float angle = whole / float(steps);
  float texel = 2.0 / float(textureSize(capture, 0).x);  // radians, in the middle of a face

  vec3 last = start, here = cos(angle) * start + sin(angle) * across, beside = direction;
  bool wasBefore = near < captureTexelDistance(start);
  for (int i = 1; i <= steps; ++i) {
    float there = away / max(length(cross(here, direction)), 1e-6);
    bool isBefore = there < captureTexelDistance(here);
    if (wasBefore && !isBefore) {
      vec3 low = last, high = here;
      for (int k = 0; k < kCaptureHalvings; ++k) {
        vec3 middle = normalize(low + high);
        there = away / max(length(cross(middle, direction)), 1e-6);
        if (there < captureDistance(middle)) low = middle;
        else high = middle;
      }
      // It meets a surface that was behind it, or the border of one.
      there = away / max(length(cross(high, direction)), 1e-6);
      float met = captureDistance(high), behind = captureDistance(low);
      float slope = abs(captureDistance(high + texel * cross(normal, high)) - met);
      if (there <= (1.0 + kCaptureThin) * met + min(0.5 * slope, kCaptureSlope * met) ||
          behind <= (1.0 + kCaptureJump) * met)
        return captureAt(high);
      beside = low - kCaptureAside * texel * cross(normal, low);
    }
    wasBefore = isBefore;
    vec3 next = 2.0 * cos(angle) * here - last;
    last = here;
    here = next;
  }
  return wasBefore ? vec4(0.0) : captureAt(beside);
}
