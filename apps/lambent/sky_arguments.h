// What `lambent sky` is asked: which sky, when, as which picture, in which directions.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/lambent/arguments.h"
#include "lambent/report/result.h"
#include "lambent/sky/sky_picture.h"
#include "lambent/sky/sky_request.h"

namespace lambent::tool {

/// The options of sky::requestKeys().
struct SkyArguments {
  sky::SkyRequest request;
  std::vector<std::pair<std::string, std::string>> given;  ///< key, value

  void addTo(CLI::App& app);
  /// "date=2026-06-21,time=05:40": what follows `sky:` in a SOURCE.
  std::string inWords() const;
  /// The atmosphere if it is a file.
  std::filesystem::path file() const;
};

/// --sequence and --frames: moments of a day.
struct SequenceArguments {
  struct Span {
    int from = 0, to = 0;        ///< seconds of the day; to ≤ from: on the day after
    std::optional<double> step;  ///< minutes
  };
  std::optional<Span> span;
  std::optional<int> frames;

  void addTo(CLI::App& app);
  /// The request at each moment. BadUsage: too many, none, or said twice.
  Result<std::vector<sky::SkyRequest>> moments(const sky::SkyRequest& request) const;
};

/// "04:00,22:00" or "04:00,22:00,10".
Result<SequenceArguments::Span> parseSpan(std::string_view text);
/// OUT.exr → OUT-0007.exr; at least four digits, and as many as `count` has.
std::filesystem::path framePath(const std::filesystem::path& path, std::size_t number,
                                std::size_t count);

/// --map and what belongs to it.
struct MapArguments {
  struct Sides {
    int width = 0;
    std::optional<int> height;
  };
  sky::PictureMap map = sky::PictureMap::LatLong;
  std::optional<Sides> size;
  std::optional<Vec2> look;   ///< bearing and elevation, degrees
  std::optional<double> fov;  ///< degrees
  sky::Quantity quantity = sky::Quantity::Radiance;
  std::optional<bool> sun;

  void addTo(CLI::App& app);
  /// BadUsage: options that the map does not have.
  Result<sky::PictureShape> shape() const;
};

std::string nameOf(sky::PictureMap map);
std::string nameOf(sky::Quantity quantity);

/// --at, --at-file, --wavelengths, --magnitudes.
struct AtArguments {
  struct Direction {
    double azimuth = 0, elevation = 0;  ///< degrees, the azimuth from the Sun's
  };
  std::vector<Direction> at;
  std::filesystem::path file;
  std::vector<double> wavelengths;
  bool magnitudes = false;

  void addTo(CLI::App& app);
  bool given() const { return !at.empty() || !file.empty(); }
  /// Those of the command line, then those of the file.
  Result<std::vector<Direction>> directions() const;
};

}  // namespace lambent::tool
