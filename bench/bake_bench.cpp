// How close a bake comes to the limit: bare Embree casting the same rays. Every line is a ratio of
// two times measured in this run, alternately, the best of several each.
//
// usage: lambent_bake_bench [RESULT.csv [INPUTS [--quick]]]
//   RESULT.csv  figures: name, value, unit, wanted
//   INPUTS      folder with bunny.obj and dragon/*.ply (tools/fetch-inputs.sh all)
#include <embree3/rtcore.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <tbb/enumerable_thread_specific.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <functional>
#include <map>

#include "bench/figures_file.h"
#include "lambent/macro/bake.h"
#include "lambent/math/random.h"
#include "lambent/scene/shapes.h"
#include "lambent/scene_io/load.h"
#include "lambent/trace/direction_set.h"
#include "lambent/transport/receivers.h"
#include "lambent/work/flush_denormals.h"
#include "lambent/work/parallel_for.h"

namespace {

using namespace lambent;
using namespace lambent::bench;

enum class Mode { One, Packets, PacketsCoherent, Stream, StreamCoherent };
constexpr std::pair<Mode, const char*> kOcclusionModes[] = {
    {Mode::One, "one at a time"},
    {Mode::Packets, "16-packets"},
    {Mode::PacketsCoherent, "16-packets, coherent"},
    {Mode::Stream, "streams"},
    {Mode::StreamCoherent, "streams, coherent"}};

/// Embree and nothing else: the rays of a bake, their directions laid out ahead of time as well as
/// can be, no arithmetic but counting.
class BareEmbree {
 public:
  BareEmbree(const scene::Scene& scene, int directionCount)
      : directions_(directionCount, math::randomRotation(0)) {
    const auto rays = trace::RayScene::build(scene, trace::Edges::Fast);
    receivers_ = std::move(*transport::placeReceivers(scene, {}, rays->offset()));
    device_ = rtcNewDevice(nullptr);
    scene_ = rtcNewScene(device_);
    for (const scene::Mesh& mesh : scene.meshes) {
      RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
      void* p = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12,
                                        mesh.positions.size());
      std::memcpy(p, mesh.positions.data(), 12 * mesh.positions.size());
      void* t = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12,
                                        mesh.triangles.size());
      std::memcpy(t, mesh.triangles.data(), 12 * mesh.triangles.size());
      rtcCommitGeometry(geometry);
      rtcAttachGeometry(scene_, geometry);
      rtcReleaseGeometry(geometry);
    }
    rtcCommitScene(scene_);
  }
  ~BareEmbree() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }

  std::size_t receivers() const { return receivers_.size(); }

  /// From every `step`-th chunk of receivers.
  void occlusion(Mode mode, std::size_t step = 1) const {
    forReceivers(step, [&](std::uint32_t r, Room& room) { occlude(r, mode, room); });
  }
  void closest() const {
    forReceivers(1, [&](std::uint32_t r, Room& room) { intersect(r, room); });
  }

 private:
  struct Room {
    std::vector<float> x, y, z;
    std::vector<RTCRay> stream;
    std::size_t blocked = 0;
  };

  template <class Work>
  void forReceivers(std::size_t step, const Work& work) const {
    tbb::enumerable_thread_specific<Room> rooms;
    const std::size_t chunks = (receivers_.size() + 63) / 64;
    work::parallelFor((chunks + step - 1) / step, [&](std::size_t which) {
      const std::size_t chunk = which * step;
      const work::FlushDenormals flush;
      Room& room = rooms.local();
      const std::size_t end = std::min(receivers_.size(), 64 * chunk + 64);
      for (std::size_t r = 64 * chunk; r < end; ++r) work(static_cast<std::uint32_t>(r), room);
    });
  }

  std::size_t select(std::uint32_t r, Room& room) const {
    const Vec3& n = receivers_.normals[r];
    const std::size_t all = directions_.size();
    room.x.resize(all + 32), room.y.resize(all + 32), room.z.resize(all + 32);
    std::size_t count = 0;
    const float *x = directions_.x().data(), *y = directions_.y().data(),
                *z = directions_.z().data();
    for (std::size_t i = 0; i < all; ++i) {
      room.x[count] = x[i], room.y[count] = y[i], room.z[count] = z[i];
      count += x[i] * n.x() + y[i] * n.y() + z[i] * n.z() > 0.0f;
    }
    return count;
  }

  static void setUp(RTCRay16& ray, const Vec3& origin) {
    for (int k = 0; k < 16; ++k) {
      ray.org_x[k] = origin.x(), ray.org_y[k] = origin.y(), ray.org_z[k] = origin.z();
      ray.tnear[k] = 0, ray.time[k] = 0, ray.mask[k] = ~0u, ray.id[k] = 0, ray.flags[k] = 0;
    }
  }

  void occlude(std::uint32_t r, Mode mode, Room& room) const {
    const std::size_t count = select(r, room);
    const Vec3& o = receivers_.origins[r];
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = mode == Mode::PacketsCoherent || mode == Mode::StreamCoherent
                        ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT
                        : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    if (mode == Mode::Packets || mode == Mode::PacketsCoherent) {
      alignas(64) RTCRay16 ray;
      alignas(64) int valid[16];
      setUp(ray, o);
      for (std::size_t first = 0; first < count; first += 16) {
        std::memcpy(ray.dir_x, &room.x[first], 64);
        std::memcpy(ray.dir_y, &room.y[first], 64);
        std::memcpy(ray.dir_z, &room.z[first], 64);
        for (int k = 0; k < 16; ++k) {
          ray.tfar[k] = std::numeric_limits<float>::infinity();
          valid[k] = first + k < count ? -1 : 0;
        }
        rtcOccluded16(valid, scene_, &context, &ray);
        for (int k = 0; k < 16; ++k) room.blocked += valid[k] && ray.tfar[k] < 0;
      }
      return;
    }
    RTCRay ray{};
    ray.org_x = o.x(), ray.org_y = o.y(), ray.org_z = o.z(), ray.mask = ~0u;
    ray.tfar = std::numeric_limits<float>::infinity();
    if (mode == Mode::One) {
      for (std::size_t i = 0; i < count; ++i) {
        ray.dir_x = room.x[i], ray.dir_y = room.y[i], ray.dir_z = room.z[i];
        ray.tfar = std::numeric_limits<float>::infinity();
        rtcOccluded1(scene_, &context, &ray);
        room.blocked += ray.tfar < 0;
      }
      return;
    }
    room.stream.assign(count, ray);
    for (std::size_t i = 0; i < count; ++i)
      room.stream[i].dir_x = room.x[i], room.stream[i].dir_y = room.y[i],
      room.stream[i].dir_z = room.z[i];
    rtcOccluded1M(scene_, &context, room.stream.data(), static_cast<unsigned>(count),
                  sizeof(RTCRay));
    for (const RTCRay& answered : room.stream) room.blocked += answered.tfar < 0;
  }

  void intersect(std::uint32_t r, Room& room) const {
    const std::size_t count = select(r, room);
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    alignas(64) RTCRayHit16 query;
    alignas(64) int valid[16];
    setUp(query.ray, receivers_.origins[r]);
    for (std::size_t first = 0; first < count; first += 16) {
      std::memcpy(query.ray.dir_x, &room.x[first], 64);
      std::memcpy(query.ray.dir_y, &room.y[first], 64);
      std::memcpy(query.ray.dir_z, &room.z[first], 64);
      for (int k = 0; k < 16; ++k) {
        query.ray.tfar[k] = std::numeric_limits<float>::infinity();
        query.hit.geomID[k] = RTC_INVALID_GEOMETRY_ID;
        valid[k] = first + k < count ? -1 : 0;
      }
      rtcIntersect16(valid, scene_, &context, &query);
      for (int k = 0; k < 16; ++k) room.blocked += query.hit.geomID[k] != RTC_INVALID_GEOMETRY_ID;
    }
  }

  trace::DirectionSet directions_;
  transport::PlacedReceivers receivers_;
  RTCDevice device_ = nullptr;
  RTCScene scene_ = nullptr;
};

/// Seconds of every stage of a bake, by its name, from its progress reports.
std::map<std::string, double> timedBake(const scene::Scene& scene, const trace::RayScene& rays,
                                        const macro::BakeOptions& options) {
  std::map<std::string, double> ends;
  std::vector<std::pair<std::string, double>> stages;
  const double start = now();
  const auto receivers = transport::placeReceivers(scene, {}, rays.offset());
  const auto field =
      macro::bake(scene, rays, *receivers, options, [&](const ProgressUpdate& update) {
        if (stages.empty() || stages.back().first != update.stage)
          stages.emplace_back(std::string(update.stage), 0.0);
        stages.back().second = now();
        return true;
      });
  const double end = now();
  if (!field) {
    fmt::print(stderr, "{}\n", field.error().message);
    std::exit(1);
  }
  std::map<std::string, double> seconds;
  double previous = start;
  for (const auto& [name, at] : stages) {
    seconds[name] = at - previous;
    previous = at;
  }
  seconds["all"] = end - start;
  return seconds;
}

scene::Scene grey(scene::Scene scene, bool glossy) {
  scene.materials.assign(1, {});
  scene.materials[0].diffuse = Rgb::Constant(glossy ? 0.0f : 0.7f);
  if (glossy) scene.materials[0].glossy = Rgb::Constant(0.7f);
  for (scene::Mesh& mesh : scene.meshes) mesh.material = 0;
  return scene;
}

void benchMesh(const std::string& name, const scene::Scene& mesh, int directions, int rounds) {
  const scene::Scene diffuse = grey(mesh, false), glossy = grey(mesh, true);
  const auto fast = trace::RayScene::build(diffuse, trace::Edges::Fast);
  const auto watertight = trace::RayScene::build(diffuse, trace::Edges::Watertight);
  const BareEmbree bare(diffuse, directions);
  fmt::print("\n{}: {} receivers, {} directions\n", name, bare.receivers(), directions);

  macro::BakeOptions shadowed;
  shadowed.kind = transfer::Kind::Shadowed;
  shadowed.directions = directions;
  macro::BakeOptions bounced = shadowed;
  bounced.kind = transfer::Kind::Interreflected;
  bounced.bounces = 3;

  double shadowedBest = 1e30, glossyBest = 1e30, firstBest = 1e30, furtherBest = 1e30;
  // Which mode is Embree's best for these rays is found on an eighth of them.
  std::vector<std::function<void()>> trials;
  for (const auto& mode : kOcclusionModes) trials.push_back([&] { bare.occlusion(mode.first, 8); });
  const std::vector<double> tried = bestOf(2, trials);
  for (std::size_t m = 0; m < tried.size(); ++m)
    fmt::print("  bare occlusion, {:<24} {:6.2f} Mrays/s\n", kOcclusionModes[m].second,
               0.5 / 8 * directions * static_cast<double>(bare.receivers()) / tried[m] * 1e-6);
  const auto bestMode =
      kOcclusionModes[std::min_element(tried.begin(), tried.end()) - tried.begin()];
  std::vector<std::function<void()>> jobs;
  jobs.push_back([&] { bare.occlusion(bestMode.first); });
  jobs.push_back([&] { bare.closest(); });
  jobs.push_back(
      [&] { shadowedBest = std::min(shadowedBest, timedBake(diffuse, *fast, shadowed)["all"]); });
  jobs.push_back(
      [&] { glossyBest = std::min(glossyBest, timedBake(glossy, *fast, shadowed)["all"]); });
  jobs.push_back([&] {
    auto seconds = timedBake(diffuse, *watertight, bounced);
    firstBest = std::min(firstBest, seconds["shadows and hits"] + seconds["bounce 1"]);
    furtherBest = std::min(furtherBest, std::min(seconds["bounce 2"], seconds["bounce 3"]));
  });
  const std::vector<double> best = bestOf(rounds, jobs);
  const double occlusion = best[0], closest = best[1];
  const double rays = 0.5 * directions * static_cast<double>(bare.receivers());
  note(name + ": bare occlusion, " + bestMode.second, rays / occlusion * 1e-6, "Mrays/s");
  note(name + ": bare closest hit, 16-packets coherent", rays / closest * 1e-6, "Mrays/s");
  note(name + ": shadowed diffuse / bare occlusion", shadowedBest / occlusion, "ratio", "<= 1.15");
  note(name + ": first bounce / bare closest hit", firstBest / closest, "ratio", "<= 1.25");
  note(name + ": further bounce / first bounce", furtherBest / firstBest, "ratio", "<= 0.25");
  note(name + ": shadowed glossy / shadowed diffuse", glossyBest / shadowedBest, "ratio",
       "<= 1.15");
  note(name + ": shadowed diffuse, all of it", shadowedBest, "s");
}

/// A wrinkled sphere of some 50,000 vertices.
scene::Scene fiftyThousand() {
  scene::Mesh mesh = scene::uvSphere(1.0f, 249, 200);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const Vec3 p = mesh.positions[v];
    mesh.positions[v] *=
        1.0f + 0.08f * std::sin(9 * p.x()) * std::sin(8 * p.y()) * std::sin(10 * p.z());
  }
  scene::computeNormals(mesh);
  return scene::sceneOf(mesh);
}

/// In a process of its own, so that its peak memory is its own.
void benchMemory(const std::string& name, const std::filesystem::path& path, int directions) {
  int channel[2];
  if (pipe(channel) != 0) return;
  const pid_t child = fork();
  if (child == 0) {
    const auto loaded = scene_io::load(path);
    if (!loaded) _exit(1);
    const scene::Scene scene = grey(loaded->scene, false);
    const auto rays = trace::RayScene::build(scene);
    macro::BakeOptions options;
    options.directions = directions;
    const double seconds = timedBake(scene, *rays, options)["all"];
    const double answer[2] = {seconds, static_cast<double>(scene.meshes[0].positions.size())};
    const bool told = ::write(channel[1], answer, sizeof answer) == sizeof answer;
    _exit(told ? 0 : 1);
  }
  int status = 0;
  rusage usage{};
  wait4(child, &status, 0, &usage);
  double answer[2] = {0, 0};
  const bool heard = WIFEXITED(status) && WEXITSTATUS(status) == 0 &&
                     ::read(channel[0], answer, sizeof answer) == sizeof answer;
  close(channel[0]), close(channel[1]);
  if (!heard) return note(name + ": FAILED", 1, "");
  note(name + ": vertices", answer[1], "");
  note(name + ": interreflected bake, 2 bounces", answer[0], "s");
  note(name + ": time per vertex and direction", answer[0] / answer[1] / directions * 1e9, "ns",
       "the same at any size");
  note(name + ": peak memory", static_cast<double>(usage.ru_maxrss) / 1024 / 1024, "GiB", "< 4");
}

}  // namespace

int main(int argc, char** argv) {
  const std::filesystem::path csv = argc > 1 ? argv[1] : "";
  const std::filesystem::path inputs = argc > 2 ? argv[2] : "build/inputs";
  const bool quick = argc > 3 && std::string_view(argv[3]) == "--quick";
  // Children are forked before the first thread is started here.
  const auto sizes = quick ? std::vector<std::string>{"_res4", "_res3"}
                           : std::vector<std::string>{"_res4", "_res3", "_res2", ""};
  for (const std::string& size : sizes) {
    const std::filesystem::path ply = inputs / "dragon" / fmt::format("dragon_vrip{}.ply", size);
    if (std::filesystem::exists(ply)) benchMemory(fmt::format("dragon{}", size), ply, 8192);
  }
  const auto bunny = scene_io::load(inputs / "bunny.obj");
  if (bunny)
    benchMesh("bunny", bunny->scene, quick ? 1024 : 8192, 2);
  else
    fmt::print(stderr, "{}\n", bunny.error().message);
  const auto dragon = scene_io::load(inputs / "dragon" / "dragon_vrip_res2.ply");
  if (dragon) benchMesh("dragon_res2", dragon->scene, quick ? 512 : 2048, 2);
  benchMesh("wrinkled sphere", fiftyThousand(), quick ? 1024 : 8192, 2);

  writeFigures(csv);
  return 0;
}
