// Aerial perspective, L_s = f L_0 + L_in, between the nodes of a table: sky::AirTable::at, and
// sky::ConstantAir::at without a table. Distances in m, directions unit and in the Sun's frame: +y up,
// the Sun in the half plane x ≥ 0, z = 0.
//
// Before this text: phase_function.glsl. After it: the functions that read the table.

uniform ivec3 airNodes;   // azimuths, elevations (half of them below the horizon), distances
uniform vec4 airShell;    // radius of the planet, height of the air, altitude and horizon of the viewer
uniform float airScale;   // what sources are multiples of
uniform vec3 towardsSun;  // unit, in the Sun's frame

const float kAirElevationPower = 3.0, kAirDistancePower = 2.5, kAirLeastReach = 2000.0;
const float kAirQuarterTurn = 1.57079632679490;

// Sources L_in / (1 − f) at a node: azimuth, elevation, distance.
vec3 airSourceOfAir(ivec3 node);
vec3 airSourceOfAerosol(ivec3 node);
vec3 airSourceMultiple(ivec3 node);
// log(−ln f / distance): elevation, distance.
vec3 airLogExtinction(ivec2 node);

struct AirBetween {
  vec3 extinction;            // f
  vec3 fromAir, fromAerosol;  // scattered once, without the phase functions
  vec3 multiple;              // scattered more than once
};

vec3 airFromSun(AirBetween air, float cosine) {
  return air.fromAir * rayleighPhase(cosine) + air.fromAerosol * phaseOfAerosols(cosine);
}

// Distance to the ground from a height above it: sky::AirTableAxes::toGround.
float airToGround(float sine, float height) {
  float b = (airShell.x + height) * sine, c = height * (2.0 * airShell.x + height);
  float root = sqrt(max(b * b - c, 0.0));
  return c / max(root - b, max(sqrt(c), 0.001));
}

// Distance to the end of a ray: sky::AirTableAxes::reach.
float airReach(bool above, float sine) {
  float radius = airShell.x, height = airShell.y, altitude = airShell.z;
  if (!above) return max(airToGround(sine, altitude), kAirLeastReach);
  float b = (radius + altitude) * sine;
  float c = (height - altitude) * (2.0 * radius + height + altitude);
  float root = sqrt(b * b + c);
  return max(b > 0.0 ? c / (root + b) : root - b, 1.0);
}

// 1 − e^(−x), which floats lose for a small x.
vec3 airLost(vec3 x) {
  vec3 few = x * (1.0 - 0.5 * x * (1.0 - x / 3.0));
  vec3 many = 1.0 - exp(-x);
  return vec3(x.x < 0.01 ? few.x : many.x, x.y < 0.01 ? few.y : many.y,
              x.z < 0.01 ? few.z : many.z);
}

AirBetween airBetween(vec3 direction, float metres) {
  float sine = clamp(direction.y, -1.0, 1.0);
  float elevation = atan(sine, length(direction.xz)), horizon = airShell.w;
  bool above = elevation >= horizon;
  float reach = airReach(above, sine);
  float far = min(max(metres, 0.0), above ? reach : 1e9);

  int rows = airNodes.y / 2;
  float azimuth = atan(abs(direction.z), direction.x) / (2.0 * kAirQuarterTurn);
  float away = above ? (elevation - horizon) / (kAirQuarterTurn - horizon)
                     : (horizon - elevation) / (kAirQuarterTurn + horizon);
  vec3 at = vec3(azimuth, pow(max(away, 0.0), 1.0 / kAirElevationPower),
                 pow(far / reach, 1.0 / kAirDistancePower));
  vec3 most = vec3(float(airNodes.x - 1), float(rows - 1), float(airNodes.z - 1));
  at = clamp(at, 0.0, 1.0) * most;
  vec3 low = floor(at);
  low = vec3(min(low.x, most.x - 1.0), min(low.y, most.y - 1.0), min(low.z, most.z - 1.0));
  vec3 high = at - low;

  vec3 logExtinction = vec3(0.0), fromAir = vec3(0.0), fromAerosol = vec3(0.0),
       multiple = vec3(0.0);
  for (int corner = 0; corner < 4; ++corner) {
    int j = corner & 1, k = corner >> 1;
    float weight = (j == 1 ? high.y : 1.0 - high.y) * (k == 1 ? high.z : 1.0 - high.z);
    int row = int(low.y) + j + (above ? rows : 0), slice = int(low.z) + k;
    logExtinction += weight * airLogExtinction(ivec2(row, slice));
    ivec3 first = ivec3(int(low.x), row, slice), second = ivec3(int(low.x) + 1, row, slice);
    fromAir += weight * mix(airSourceOfAir(first), airSourceOfAir(second), high.x);
    fromAerosol += weight * mix(airSourceOfAerosol(first), airSourceOfAerosol(second), high.x);
    multiple += weight * mix(airSourceMultiple(first), airSourceMultiple(second), high.x);
  }
  vec3 depth = far * exp(logExtinction);
  vec3 lost = airLost(depth);
  vec3 scaled = airScale * lost;
  AirBetween air;
  air.extinction = 1.0 - lost;
  air.fromAir = scaled * fromAir;
  air.fromAerosol = scaled * fromAerosol;
  air.multiple = scaled * multiple;
  return air;
}

// Air of constant density: sky::ConstantAir.
uniform vec3 constantExtinction;            // 1/m
uniform vec3 constantAir, constantAerosol;  // W m⁻² per m, without the phase functions

AirBetween constantAirBetween(float metres) {
  vec3 depth = constantExtinction * max(metres, 0.0);
  vec3 lost = airLost(depth), path = lost / max(constantExtinction, vec3(1e-30));
  AirBetween air;
  air.extinction = 1.0 - lost;
  air.fromAir = constantAir * path;
  air.fromAerosol = constantAerosol * path;
  air.multiple = vec3(0.0);
  return air;
}

// L_s.
vec3 throughAir(AirBetween air, vec3 direction, vec3 radiance) {
  float cosine = clamp(dot(direction, towardsSun), -1.0, 1.0);
  return air.extinction * radiance + airFromSun(air, cosine) + air.multiple;
}

const float kAirLeastEyeHeight = 1.6;

// L_s of what an environment shows from a place `height` m up in the scene: shade::Air::seenBehind.
vec3 throughAirBehind(vec3 direction, float height, vec3 radiance) {
  if (atan(direction.y, length(direction.xz)) >= airShell.w) return radiance;
  float metres = airToGround(direction.y, max(max(airShell.z, height), kAirLeastEyeHeight));
  return throughAir(airBetween(direction, metres), direction, radiance);
}
