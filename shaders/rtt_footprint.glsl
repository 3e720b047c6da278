// How much of a patch a sub-sample of a picture stands for, and the reads that average about as much:
// lambent/shade/rtt_footprint.h, where the formulas are explained.

const int kMostProbes = 4;
const float kLeastCosine = 1.0 / 64.0;

struct FootprintAxes {
  vec3 longer, shorter;
};

struct Probes {
  float level, between;
  int count;
  vec2 stride;
};

FootprintAxes footprintAxes(mat3 worldFromPatch, vec3 toViewer, float width) {
  float across = length(toViewer.xy);
  vec2 along = across > 1e-6 ? toViewer.xy / across : vec2(1.0, 0.0);
  vec3 longer = along.x * worldFromPatch[0] + along.y * worldFromPatch[1];
  vec3 shorter = along.x * worldFromPatch[1] - along.y * worldFromPatch[0];
  return FootprintAxes(longer * (width / max(toViewer.z, kLeastCosine)), shorter * width);
}

Probes probesOf(vec2 longer, vec2 shorter, vec2 positions) {
  vec2 along = longer;
  float a = length(longer * positions), b = length(shorter * positions);
  if (b > a) {
    float swapped = a;
    a = b;
    b = swapped;
    along = shorter;
  }
  Probes probes = Probes(0.0, 0.0, 1, vec2(0.0));
  if (!(a > 1.0)) {
    float close = 2.0 - 2.0 * a;
    probes.between = min(close, 1.0);
    return probes;
  }
  float width = max(max(b, 1.0), a / float(kMostProbes));
  float beyond = a * a - width * width;
  if (beyond > 0.04 * width * width) {
    probes.count = clamp(int(ceil(a / width)), 2, kMostProbes);
    float n = float(probes.count);
    probes.stride = along * (sqrt(beyond / (n * n - 1.0)) / a);
  }
  probes.level = log2(width);
  return probes;
}
