// This work is based on:
// - sloan2003biscale: §4.2, "RTTs can also be acquired": an interpolated BTF through eq. (5).
// - micchelli1986interpolation: radial functions that are conditionally definite; with −‖x − y‖ and
//   a constant, scattered data at distinct points always have one interpolant.
//
// Where we deviate, and why. The paper fills CURET's sparse samples in by recovering a height field
// and re-rendering it. Radial functions need no model of the surface, are exact at the
// samples, and, being linear, make every coefficient of the RTT one fixed combination of the
// pictures, the same for all positions. What is interpolated is radiance divided by the cosine of
// the light's polar angle: a diffuse surface is then constant, and light at the horizon gives
// nothing however sparse the samples are there. Reciprocity is not imposed: texture has none at one
// place, for light that enters at one place leaves at another.
#include "lambent/meso/acquired.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <set>
#include <system_error>

#include <Eigen/LU>

#include "lambent/file/budget.h"
#include "lambent/image/io.h"
#include "lambent/meso/build_rtt.h"
#include "lambent/meso/light_grid.h"
#include "lambent/sh/coefficients.h"
#include "lambent/work/runner.h"

namespace lambent::meso {

namespace {

constexpr std::size_t kFewest = 8, kMost = 8192;
constexpr float kLowestCosine = 0.05f;  ///< at which radiance is divided; keeps noise in bounds

double distance(const Vec3& view, const Vec3& light, const BtfSample& sample) {
  return std::sqrt(double((view - sample.view).squaredNorm()) +
                   double((light - sample.light).squaredNorm()));
}

}  // namespace

struct BtfInterpolation::Impl {
  std::vector<BtfSample> samples;
  Eigen::PartialPivLU<Eigen::MatrixXd> system;
};

BtfInterpolation::BtfInterpolation(std::span<const BtfSample> samples)
    : impl_(std::make_unique<Impl>()) {
  assert(!samples.empty());
  impl_->samples.assign(samples.begin(), samples.end());
  const auto n = static_cast<Eigen::Index>(samples.size());
  Eigen::MatrixXd matrix(n + 1, n + 1);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j)
      matrix(i, j) = -distance(samples[i].view, samples[i].light, samples[j]);
    matrix(i, n) = matrix(n, i) = 1.0;
  }
  matrix(n, n) = 0.0;
  impl_->system.compute(matrix);
}

BtfInterpolation::~BtfInterpolation() = default;
BtfInterpolation::BtfInterpolation(BtfInterpolation&&) noexcept = default;

std::vector<double> BtfInterpolation::weights(const Vec3& view, const Vec3& light) const {
  const double one = 1.0;
  return weights(view, std::span(&light, 1), std::span(&one, 1));
}

std::vector<double> BtfInterpolation::weights(const Vec3& view, std::span<const Vec3> lights,
                                              std::span<const double> factors) const {
  const auto n = static_cast<Eigen::Index>(impl_->samples.size());
  Eigen::VectorXd right = Eigen::VectorXd::Zero(n + 1);
  for (std::size_t k = 0; k < lights.size(); ++k) {
    for (Eigen::Index i = 0; i < n; ++i)
      right[i] -= factors[k] * distance(view, lights[k], impl_->samples[i]);
    right[n] += factors[k];
  }
  const Eigen::VectorXd solution = impl_->system.solve(right);
  return {solution.data(), solution.data() + n};
}

namespace {

/// The picture's mean over each position's cell, rows from y = 0: exact for pixels that are squares
/// of one colour.
std::vector<float> resampled(const image::Image& picture, int width, int height) {
  struct Tap {
    int pixel;
    float weight;
  };
  const auto taps = [](int cells, int pixels) {
    std::vector<std::vector<Tap>> all(cells);
    for (int c = 0; c < cells; ++c) {
      const double low = double(c) * pixels / cells, high = double(c + 1) * pixels / cells;
      for (int p = int(low); p < std::min(pixels, int(std::ceil(high))); ++p) {
        const double covered = std::min(high, p + 1.0) - std::max(low, double(p));
        if (covered > 0.0) all[c].push_back({p, float(covered / (high - low))});
      }
    }
    return all;
  };
  const auto columns = taps(width, picture.width), rows = taps(height, picture.height);
  std::vector<float> out;
  out.reserve(std::size_t(width) * height * 3);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      Rgb sum = Rgb::Zero();
      for (const Tap& row : rows[height - 1 - y])
        for (const Tap& column : columns[x])
          sum += row.weight * column.weight * picture.at(column.pixel, row.pixel);
      out.insert(out.end(), {sum[0], sum[1], sum[2]});
    }
  return out;
}

Status check(const AcquiredOptions& options) {
  const auto within = [](int value, int high) { return value >= 1 && value <= high; };
  if (!within(options.width, 1024) || !within(options.height, 1024) || !within(options.views, 32) ||
      !within(options.bands, sh::kMaxBands) || !within(options.polarLights, 64) ||
      !within(options.azimuthLights, 64))
    return report::badUsage(
        "an acquired RTT has 1 to 1024 positions and 1 to 32 views a side, 1 to 10 bands, and 1 to "
        "64 lights each way");
  if (!(options.white > 0.0f) || !(options.size.array() > 0.0f).all())
    return report::badUsage("white and size of an acquired RTT must be above 0");
  return Status::ok();
}

/// What all pictures cost together.
struct Account {
  file::Budget budget;
  std::set<std::filesystem::path> counted;
};

/// A table can name one small file in every line: it counts once, and its pixels each time.
Status charge(const image::Image& picture, const std::filesystem::path& path, Account& account) {
  std::error_code error;
  const std::filesystem::path place = std::filesystem::weakly_canonical(path, error);
  const std::uintmax_t bytes = std::filesystem::file_size(path, error);
  if (!error && account.counted.insert(place).second) account.budget.addFile(bytes);
  return account.budget.work(picture.pixels.size() * sizeof(Rgb), path.string());
}

Status checkSamples(const std::vector<BtfSample>& samples, const std::filesystem::path& table) {
  if (samples.size() < kFewest)
    return report::badInput(table.string() + ": " + std::to_string(samples.size()) +
                            " pictures are too few to fill a BTF in; it takes at least " +
                            std::to_string(kFewest) + ", and a few dozen lights to look right");
  if (samples.size() > kMost)
    return report::badInput(table.string() + ": " + std::to_string(samples.size()) +
                            " pictures are more than the " + std::to_string(kMost) +
                            " that can be interpolated; leave some out");
  for (std::size_t i = 0; i < samples.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (distance(samples[i].view, samples[i].light, samples[j]) < 1e-4)
        return report::badInput(table.string() + ": lines " + std::to_string(samples[j].line) +
                                " and " + std::to_string(samples[i].line) +
                                " have the same view and light; keep one of them");
  return Status::ok();
}

/// Warns where some direction of the grid is far from every sample's.
void warnOfGaps(const std::vector<BtfSample>& samples, std::span<const Vec3> wanted, bool lights,
                Findings& findings) {
  float worst = 1.0f;
  for (const Vec3& direction : wanted) {
    float nearest = -1.0f;
    for (const BtfSample& sample : samples)
      nearest = std::max(nearest, direction.dot(lights ? sample.light : sample.view));
    worst = std::min(worst, nearest);
  }
  const double degrees = std::acos(std::clamp(double(worst), -1.0, 1.0)) * 180.0 / kPi;
  if (degrees <= 40.0) return;
  const std::string what = lights ? "lights" : "views";
  findings.push_back(
      {Severity::Warning, "sparse-" + what,
       "some " + what + " are " + std::to_string(std::lround(degrees)) +
           " degrees from the nearest that was measured: what the RTT shows there is "
           "guessed",
       1});
}

void warnOfSeam(const image::Image& picture, const std::filesystem::path& file,
                Findings& findings) {
  double inside = 0.0, across = 0.0;
  const int w = picture.width, h = picture.height;
  if (w < 3 || h < 3) return;
  for (int y = 0; y < h; ++y) {
    for (int x = 0; x + 1 < w; ++x)
      inside += double((picture.at(x + 1, y) - picture.at(x, y)).square().sum()) / (w - 1);
    across += double((picture.at(0, y) - picture.at(w - 1, y)).square().sum());
  }
  for (int x = 0; x < w; ++x) {
    for (int y = 0; y + 1 < h; ++y)
      inside += double((picture.at(x, y + 1) - picture.at(x, y)).square().sum()) / (h - 1);
    across += double((picture.at(x, 0) - picture.at(x, h - 1)).square().sum());
  }
  const double ratio = std::sqrt(across / std::max(inside, 1e-30));
  if (across <= 1e-12 || ratio <= 3.0) return;
  findings.push_back(
      {Severity::Warning, "picture-seam",
       file.string() + ": colours jump across the border by " + std::to_string(std::lround(ratio)) +
           " times what neighbours differ by inside; seams will show where the patch "
           "is repeated. Cut the pictures where they tile",
       1});
}

}  // namespace

Result<WithFindings<transfer::SimulatedRtt>> acquireRtt(const std::filesystem::path& folderOrTable,
                                                        const AcquiredOptions& options,
                                                        const Progress& progress) {
  if (Status sane = check(options); !sane) return sane.error();
  const Result<std::filesystem::path> table = findBtfTable(folderOrTable);
  if (!table) return table.error();
  const Result<std::vector<BtfSample>> read = readBtfTable(*table);
  if (!read) return read.error();
  const std::vector<BtfSample>& samples = *read;
  if (Status sound = checkSamples(samples, *table); !sound) return sound.error();

  WithFindings<transfer::SimulatedRtt> result;
  transfer::SimulatedRtt& rtt = result.value;
  Findings& findings = result.findings;
  rtt.name = std::filesystem::absolute(*table).parent_path().filename().string();
  rtt.width = options.width, rtt.height = options.height;
  rtt.views = options.views, rtt.bands = options.bands;
  rtt.size = options.size;

  // Rows [sample][position][channel] of what is interpolated.
  const auto rowLength = static_cast<Eigen::Index>(rtt.positionCount() * 3);
  using RowMajor = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  RowMajor pictures(static_cast<Eigen::Index>(samples.size()), rowLength);
  int width = 0, height = 0;
  Account account{file::Budget(options.memoryLimit), {}};
  for (std::size_t s = 0; s < samples.size(); ++s) {
    if (progress && !progress({"pictures", s, samples.size(), "pictures"}))
      return report::cancelled();
    const std::string where = table->string() + ", line " + std::to_string(samples[s].line) + ": ";
    const Result<image::PictureFile> opened =
        image::readPicture(samples[s].file, {.memoryLimit = options.memoryLimit});
    if (!opened) return report::badInput(where + opened.error().message);
    findings.insert(findings.end(), opened->findings.begin(), opened->findings.end());
    const image::Image* const picture = &opened->image;
    if (Status fits = charge(*picture, samples[s].file, account); !fits)
      return report::badInput(where + fits.error().message);
    if (s == 0) {
      width = picture->width, height = picture->height;
      warnOfSeam(*picture, samples[s].file, findings);
    }
    if (picture->width != width || picture->height != height)
      return report::badInput(where + samples[s].file.string() + " has " +
                              std::to_string(picture->width) + "×" +
                              std::to_string(picture->height) + " pixels, the first picture " +
                              std::to_string(width) + "×" + std::to_string(height));
    for (const Rgb& pixel : picture->pixels)
      if (!pixel.isFinite().all())
        return report::badInput(where + samples[s].file.string() +
                                " has pixels that are not numbers");
    const std::vector<float> row = resampled(*picture, options.width, options.height);
    const float cosine = std::max(samples[s].light.z(), kLowestCosine);
    const float factor = 1.0f / (static_cast<float>(kPi) * options.white * cosine);
    for (Eigen::Index k = 0; k < rowLength; ++k)
      pictures(static_cast<Eigen::Index>(s), k) = factor * row[static_cast<std::size_t>(k)];
  }

  const std::vector<DirectionalLight> grid = lightGrid(options.polarLights, options.azimuthLights);
  const std::vector<double> harmonics = harmonicWeights(grid, options.bands);
  const auto count = static_cast<std::size_t>(sh::coefficientCount(options.bands));
  std::vector<Vec3> lights, views;
  for (const DirectionalLight& light : grid) lights.push_back(light.direction);
  for (int y = 0; y < options.views; ++y)
    for (int x = 0; x < options.views; ++x) views.push_back(viewDirection(options.views, x, y));
  warnOfGaps(samples, lights, true, findings);
  warnOfGaps(samples, views, false, findings);

  if (progress && !progress({"interpolation", 0, 1, "systems"})) return report::cancelled();
  const BtfInterpolation interpolation(samples);
  if (progress && !progress({"interpolation", 1, 1, "systems"})) return report::cancelled();
  rtt.values.resize(count * rtt.planeSize());
  const work::Runner runner(progress, options.threads);
  const Status finished = runner.run(
      {"eq. 5", "views"}, work::Chunks(views.size()), std::vector<double>(lights.size()),
      [&](const work::Chunk& chunk, std::vector<double>& factors) {
        const std::size_t view = chunk.index;
        // W: one row of weights for each coefficient; B = W · pictures.
        RowMajor weights(static_cast<Eigen::Index>(count), pictures.rows());
        for (std::size_t i = 0; i < count; ++i) {
          for (std::size_t k = 0; k < lights.size(); ++k)
            factors[k] = harmonics[k * count + i] * double(std::max(lights[k].z(), kLowestCosine));
          const std::vector<double> w = interpolation.weights(views[view], lights, factors);
          for (Eigen::Index s = 0; s < pictures.rows(); ++s)
            weights(static_cast<Eigen::Index>(i), s) = static_cast<float>(w[std::size_t(s)]);
        }
        const RowMajor b = weights * pictures;
        for (std::size_t i = 0; i < count; ++i)
          for (std::size_t p = 0; p < rtt.positionCount(); ++p)
            for (std::size_t c = 0; c < 3; ++c)
              rtt.values[i * rtt.planeSize() + (p * rtt.viewCount() + view) * 3 + c] =
                  b(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(3 * p + c));
      });
  if (!finished) return finished.error();
  return result;
}

}  // namespace lambent::meso
