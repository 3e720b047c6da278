// What a mirror shows of the asset it belongs to: a cube map of all other surfaces as they are lit,
// drawn from a place in or at the mirror, and looked up where a ray meets what was drawn: it is
// followed across the map, by equal angles and then by halves, until it is no longer before what the
// map has there. So what is near stands where it does, wherever on the mirror it is seen. Where a ray
// passes behind what is in the map, nothing is known; what the map has beside that stands in.

uniform samplerCube capture;  // radiance, and in alpha the distance from captureFrom: 0 where nothing is
uniform vec3 captureFrom;
uniform bool hasCapture;

const int kCaptureSteps = 32, kCaptureHalvings = 6;
const float kCaptureJump = 0.1;  // of a distance: what lies that much nearer is another surface

const float kCaptureThin = 0.02;  // of a distance: as thick is what has an end towards a ray
const float kCaptureAside = 1.5;  // texels

// Towards the middle of the texel that lies in a direction, where the map mixes nothing.
vec3 captureTexel(vec3 direction) {
  vec3 size = abs(direction);
  float largest = max(size.x, max(size.y, size.z));
  float texels = float(textureSize(capture, 0).x);
  vec3 at = direction / largest;
  vec3 middle = (floor((0.5 * at + 0.5) * texels) + 0.5) * (2.0 / texels) - 1.0;
  return mix(middle, at, vec3(greaterThanEqual(size, vec3(largest))));
}

// Interpolated over a surface, but not between one and another, or nothing.
float capturedDistance(vec3 direction) {
  float here = textureLod(capture, captureTexel(direction), 0.0).a;
  if (here <= 0.0) return 1e30;
  float between = textureLod(capture, direction, 0.0).a;
  return abs(between - here) < kCaptureJump * here ? between : here;
}

// Radiance times how much of what lies in a direction is something, and how much.
vec4 capturedAt(vec3 direction) {
  vec3 size = abs(direction);
  float largest = max(size.x, max(size.y, size.z));
  float texels = float(textureSize(capture, 0).x);
  vec3 at = direction / largest;
  vec3 cell = (0.5 * at + 0.5) * texels - 0.5;
  vec3 low = floor(cell), high = cell - low;
  vec3 axis = vec3(greaterThanEqual(size, vec3(largest)));
  vec4 sum = vec4(0.0);
  for (int corner = 0; corner < 4; ++corner) {
    // The face's two axes, in the sequence of x, y, z.
    float j = float(corner & 1), k = float(corner >> 1);
    vec3 step_ = axis.x > 0.0 ? vec3(0.0, j, k) : axis.y > 0.0 ? vec3(j, 0.0, k) : vec3(j, k, 0.0);
    vec3 weights = mix(1.0 - high, high, step_);
    float weight = axis.x > 0.0 ? weights.y * weights.z
                                : axis.y > 0.0 ? weights.x * weights.z : weights.x * weights.y;
    vec3 d = mix((low + step_ + 0.5) * (2.0 / texels) - 1.0, at, axis);
    vec4 texel = textureLod(capture, d, 0.0);
    if (texel.a > 0.0) sum += weight * vec4(texel.rgb, 1.0);
  }
  // Borders between something and nothing lie where there is as much of both.
  float share = clamp(4.0 * sum.a - 1.5, 0.0, 1.0);
  return sum.a > 0.0 ? vec4(sum.rgb / sum.a * share, share) : sum;
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
    float texel = 2.0 / float(textureSize(capture, 0).x);  // radians, in the middle of a face
    bool hit = false;
    vec3 beside = direction;
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
        float last = capturedDistance(cos(low) * start + sin(low) * across);
        float first = capturedDistance(at);
        float next = capturedDistance(cos(high + texel) * start + sin(high + texel) * across);
        // A surface that was there before, or one whose border is crossed, which texels have roughly.
        float most = (1.0 + kCaptureThin) * first + min(abs(next - first), kCaptureJump * first);
        if (r <= most || last <= (1.0 + kCaptureJump) * first) {
          found = at;
          hit = true;
          break;
        }
        low = max(low - kCaptureAside * texel, 0.0);
        beside = cos(low) * start + sin(low) * across;
      }
      wasBefore = isBefore;
      before = angle;
    }
    if (!hit && wasBefore) return vec4(0.0);
    if (!hit) found = beside;
  }
  return capturedAt(found);
}
