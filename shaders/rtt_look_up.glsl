// A radiance transfer texture between its views and positions: shade::respond, with all that a pixel
// covers averaged if LAMBENT_FILTER is 1, and then with views that are corrected if LAMBENT_RELIEF is 1
// (rtt_lookup.cpp explains how).
//
// Before this text stand: #define LAMBENT_FILTER and LAMBENT_RELIEF, 0 or 1; view_square.glsl,
// rtt_footprint.glsl. After it: response() (rtt_response.glsl) and, with LAMBENT_RELIEF, heightAt().

uniform int views;
uniform int levelCount;
uniform ivec4 levels[16];  // width, height, first position

// Of one position, seen from one view, to the light that arrives here. `row`: position · views² +
// view, positions of all levels one after the other.
vec3 response(int row);

// The views around the direction, as shade::viewsAround.
ivec2 lowView, highView;
vec2 highShare;

#if LAMBENT_RELIEF
uniform vec2 relief;  // the patch's depth, in its periods along x and y

// Of a row, as response(): 0 … 1 from the patch's lowest point to its highest.
float heightAt(int row);

const float kLowestRay = 0.1, kSameHeight = 0.02, kHalfSure = 0.01;
const int kSearchSteps = 8;

vec2 slope;  // of the true ray
#endif

void chooseViews(vec3 toViewer) {
  vec2 at = squareFromHemisphere(vec3(toViewer.xy, max(0.0, toViewer.z))) * float(views) - 0.5;
  at = clamp(at, 0.0, float(views - 1));
  lowView = ivec2(at);
  highView = min(lowView + 1, views - 1);
  highShare = at - vec2(lowView);
#if LAMBENT_RELIEF
  slope = toViewer.xy / max(toViewer.z, kLowestRay);
#endif
}

// The response of one position to the light, between the views.
vec3 seen(int first, int place) {
  int begin = (first + place) * views * views;
  vec3 sum = vec3(0.0);
  for (int v = 0; v < 4; ++v) {
    bvec2 high = bvec2(v & 1, v & 2);
    vec2 share = mix(1.0 - highShare, highShare, high);
    if (share.x * share.y == 0.0) continue;
    ivec2 view = ivec2(high.x ? highView.x : lowView.x, high.y ? highView.y : lowView.y);
    sum += share.x * share.y * response(begin + view.y * views + view.x);
  }
  return sum;
}

vec3 nearest(vec2 q) {
  ivec4 level = levels[0];
  ivec2 at = min(ivec2(q * vec2(level.xy)), level.xy - 1);
  return seen(level.z, at.y * level.x + at.x);
}

#if LAMBENT_RELIEF
// Over the patch's middle, in its depths, as a view sees it on a level.
float heightSeen(ivec4 level, int view, vec2 q) {
  ivec2 at = min(ivec2(fract(q) * vec2(level.xy)), level.xy - 1);
  return heightAt((level.z + at.y * level.x + at.x) * views * views + view) - 0.5;
}

// Where the true ray meets what a view sees: the height, and how far that is from what is seen there.
vec2 meeting(ivec4 level, int view, vec2 q, vec2 apart) {
  float high = 0.5, over = high - heightSeen(level, view, q + high * apart);
  float low = high, under = over;
  float height = high - over;
  float missed = height - heightSeen(level, view, q + height * apart);
  if (abs(missed) <= kSameHeight) return vec2(height, missed);
  int i = 0;
  do {
    ++i;
    bool goOn = under > 0.0;
    high = goOn ? low : high;
    over = goOn ? under : over;
    low = goOn ? 0.5 - float(i) / float(kSearchSteps) : low;
    under = goOn ? low - heightSeen(level, view, q + low * apart) : under;
  } while (i < kSearchSteps && under > 0.0);
  height = over > under ? high + (low - high) * (over / (over - under)) : low;
  missed = height - heightSeen(level, view, q + height * apart);
  return vec2(height, missed);
}

// As seen() between the positions of a level, each view where it shows what the true ray meets.
// `between`: as Probes, 0 for the nearest position.
vec3 seenThrough(int k, vec2 q, float between) {
  ivec4 level = levels[k];
  vec3 sum = vec3(0.0);
  float total = 0.0;
  for (int v = 0; v < 4; ++v) {
    bvec2 high = bvec2(v & 1, v & 2);
    vec2 shares = mix(1.0 - highShare, highShare, high);
    float share = shares.x * shares.y;
    if (share == 0.0) continue;
    ivec2 at = ivec2(high.x ? highView.x : lowView.x, high.y ? highView.y : lowView.y);
    int view = at.y * views + at.x;
    vec2 apart = (slope - slopeFromSquare((vec2(at) + 0.5) / float(views))) * relief;
    if (k > 0) {
      float shift = length(apart * vec2(levels[0].xy));
      float part = 2.0 - 4.0 * (exp2(float(k)) - 1.0) / max(shift, 1e-6);
      apart *= clamp(part, 0.0, 1.0);
    }
    vec2 met = meeting(level, view, q, apart);
    vec2 place = fract(q + met.x * apart);
    share /= kHalfSure * kHalfSure + met.y * met.y;
    total += share;
    bool tile = between == 0.0;
    vec2 cell = place * vec2(level.xy) - (tile ? 0.0 : 0.5);
    vec2 low = floor(cell), upper = tile ? vec2(0.0) : cell - low;
    if (k == 0 && !tile) upper = clamp((upper - 0.5) / between + 0.5, 0.0, 1.0);
    int corner = 0, corners = tile ? 1 : 4;
    do {
      ivec2 right = ivec2(corner & 1, corner >> 1);
      vec2 part = mix(1.0 - upper, upper, bvec2(right));
      ivec2 position = (ivec2(low) + right + level.xy) % level.xy;
      int row = (level.z + position.y * level.x + position.x) * views * views + view;
      sum += share * part.x * part.y * response(row);
    } while (++corner < corners);
  }
  return sum / total;
}
#endif

#if LAMBENT_FILTER
// As shade::respond.
vec3 filtered(vec2 q, Probes probes) {
  float depth = min(probes.level, float(levelCount - 1));
  int finer = int(depth), coarser = min(finer + 1, levelCount - 1);
  float mixed = depth - float(finer);
  vec3 sum = vec3(0.0);
  for (int i = 0; i < probes.count; ++i) {
    vec2 at = fract(q + (float(i) - 0.5 * float(probes.count - 1)) * probes.stride);
#if LAMBENT_RELIEF
    // A CPU's OpenGL runs what is passed over as well, and leaves a loop only at its end.
    int which = 0, count = mixed == 0.0 ? 1 : 2;
    do {
      int k = which == 0 ? finer : coarser;
      sum += (which == 0 ? 1.0 - mixed : mixed) *
             seenThrough(k, at, k == 0 ? probes.between : 1.0);
    } while (++which < count);
#else
    for (int which = 0; which < 2; ++which) {
      float share = which == 0 ? 1.0 - mixed : mixed;
      if (share == 0.0) continue;
      int k = which == 0 ? finer : coarser;
      ivec4 level = levels[k];
      // Level 0 at the nearest position, whose cell the place lies in, but where it is seen closely.
      bool tile = k == 0 && probes.between == 0.0;
      vec2 cell = at * vec2(level.xy) - (tile ? 0.0 : 0.5);
      vec2 low = floor(cell), high = tile ? vec2(0.0) : cell - low;
      if (k == 0 && !tile) high = clamp((high - 0.5) / probes.between + 0.5, 0.0, 1.0);
      for (int corner = 0; corner < 4; ++corner) {
        ivec2 right = ivec2(corner & 1, corner >> 1);
        vec2 part = mix(1.0 - high, high, bvec2(right));
        if (part.x * part.y == 0.0) continue;
        ivec2 place = (ivec2(low) + right + level.xy) % level.xy;
        sum += share * part.x * part.y * seen(level.z, place.y * level.x + place.x);
      }
    }
#endif
  }
  return sum / float(probes.count);
}

// All that a sub-sample covers: `width` is what it sees across its ray, metres; along `x` and `y` the
// surface's q changes (shade::PatchGradient).
vec3 averaged(vec2 q, mat3 worldFromPatch, vec3 toViewer, float width, vec3 x, vec3 y) {
  FootprintAxes axes = footprintAxes(worldFromPatch, toViewer, width);
  Probes probes = probesOf(vec2(dot(x, axes.longer), dot(y, axes.longer)),
                           vec2(dot(x, axes.shorter), dot(y, axes.shorter)), vec2(levels[0].xy));
#if !LAMBENT_RELIEF
  // What filtered() would give, without its loops.
  if (probes.level == 0.0 && probes.count == 1 && probes.between == 0.0) return nearest(fract(q));
#endif
  return filtered(q, probes);
}
#endif
