// Many paths → means with error bars. The paths of a pixel or point come in batches; paths of one
// batch are stratified against each other, batches are independent, and the variance of the mean is
// taken between batches: stratification can only make it smaller than it would be between paths,
// and never makes it lie.
//
// Every pixel and every point has its own random numbers and its own sums, so the result has the
// same bytes whatever the number of threads.
#include "lambent/reference/path_tracer.h"

#include <algorithm>
#include <limits>
#include <string_view>

#include "lambent/reference/integrator.h"
#include "lambent/trace/ray_scene.h"
#include "lambent/work/runner.h"

namespace lambent::reference {
namespace {

// Few enough for strata to help, enough for the variance to be known within some 37 percent.
constexpr int kBatches = 16;
constexpr std::size_t kBlock = 64;  ///< pixels or points that a thread takes at a time

struct Plan {
  int batches, pathsPerBatch;
};

/// Below two paths for each batch there is nothing to stratify, and every path is a batch.
Plan plan(int samples) {
  if (samples < 2 * kBatches) return {samples, 1};
  return {kBatches, (samples + kBatches - 1) / kBatches};
}

/// Mean and variance of the mean over batches.
template <int N>
class BatchMoments {
 public:
  using Value = Eigen::Array<double, N, 1>;
  void add(const Value& x) {
    ++count_;
    const Value delta = x - mean_;
    mean_ += delta / count_;
    squares_ += delta * (x - mean_);
  }
  Value mean() const { return mean_; }
  Value varianceOfMean() const {
    if (count_ < 2) return Value::Constant(std::numeric_limits<double>::infinity());
    return squares_ / (double(count_ - 1) * count_);
  }

 private:
  int count_ = 0;
  Value mean_ = Value::Zero(), squares_ = Value::Zero();
};

/// body(i) for i in 0 … count−1, in parallel.
template <class Body>
Status forAll(std::size_t count, std::string_view unit, const PathTraceOptions& options,
              const Progress& progress, const Body& body) {
  const work::Runner runner(progress, options.threads);
  return runner.run({"path tracing", unit}, work::Chunks(count, kBlock),
                    [&](const work::Chunk& chunk) {
                      for (std::size_t i = chunk.begin; i < chunk.end; ++i) body(i);
                    });
}

Status check(const PathTraceOptions& options) {
  if (options.samples < 1)
    return report::badUsage("path tracing needs at least 1 sample, for example 64");
  if (options.bounces < 0)
    return report::badUsage("the number of bounces cannot be negative; 0 is direct light only");
  return Status::ok();
}

}  // namespace

Result<Picture> picture(const scene::Scene& scene, const trace::RayScene& rays,
                        const light::Environment& environment, const scene::Camera& camera,
                        int width, int height, const PathTraceOptions& options,
                        const Progress& progress) {
  if (const Status status = check(options); !status) return status.error();
  constexpr int kLargest = 1 << 15;
  if (width < 1 || height < 1 || width > kLargest || height > kLargest)
    return report::badUsage("a picture's width and height are from 1 to 32768 pixels");
  const Plan planned = plan(options.samples);
  if (options.air && camera.orthographicHalfHeight)
    return report::badUsage("an orthographic camera sees no distance, and so no air");
  Integrator integrator(scene, rays, environment, options);
  integrator.lookFrom(camera);
  Picture out{image::Image(width, height), image::Image(width, height)};
  out.mean.alpha.resize(out.mean.pixels.size());

  const Status whole =
      forAll(out.mean.pixels.size(), "pixels", options, progress, [&](std::size_t pixel) {
        const auto x = float(pixel % std::size_t(width)), y = float(pixel / std::size_t(width));
        BatchMoments<3> radiance;
        double coverage = 0;
        for (int batch = 0; batch < planned.batches; ++batch) {
          Eigen::Array3d sum = Eigen::Array3d::Zero();
          for (int path = 0; path < planned.pathsPerBatch; ++path) {
            Sampler sampler(options.seed, std::uint64_t(pixel), std::uint64_t(batch),
                            std::uint32_t(path));
            const Vec2 place = sampler.next();
            const scene::Ray ray =
                scene::cameraRay(camera, width, height, x + place.x(), y + place.y());
            const Integrator::Seen seen = integrator.seen(ray, sampler);
            sum += seen.radiance.cast<double>();
            coverage += double(seen.coverage);
          }
          radiance.add(sum / planned.pathsPerBatch);
        }
        out.mean.pixels[pixel] = radiance.mean().cast<float>();
        out.variance.pixels[pixel] = radiance.varianceOfMean().cast<float>();
        out.mean.alpha[pixel] = float(coverage / (double(planned.batches) * planned.pathsPerBatch));
      });
  if (!whole) return whole.error();
  if (options.background) out.mean.alpha.clear();
  return out;
}

Result<std::vector<Estimate>> exitRadiance(const scene::Scene& scene, const trace::RayScene& rays,
                                           const light::Environment& environment,
                                           std::span<const Probe> probes,
                                           const PathTraceOptions& options,
                                           const Progress& progress) {
  if (const Status status = check(options); !status) return status.error();
  const Plan planned = plan(options.samples);
  const Integrator integrator(scene, rays, environment, options);
  std::vector<Estimate> out(probes.size());
  const Status whole = forAll(probes.size(), "points", options, progress, [&](std::size_t i) {
    const Probe& probe = probes[i];
    BatchMoments<3> radiance;
    for (int batch = 0; batch < planned.batches; ++batch) {
      Eigen::Array3d sum = Eigen::Array3d::Zero();
      for (int path = 0; path < planned.pathsPerBatch; ++path) {
        Sampler sampler(options.seed, std::uint64_t(i), std::uint64_t(batch), std::uint32_t(path));
        sum += integrator.leaving(probe.point, probe.toViewer, sampler).cast<double>();
      }
      radiance.add(sum / planned.pathsPerBatch);
    }
    out[i] = {radiance.mean().cast<float>(), radiance.varianceOfMean().cast<float>()};
  });
  if (!whole) return whole.error();
  return out;
}

}  // namespace lambent::reference
