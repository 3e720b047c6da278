// --light SOURCE, turned and windowed.
#pragma once

#include <optional>
#include <string>

#include "apps/lambent/console.h"
#include "apps/lambent/reading_arguments.h"
#include "lambent/light/environment.h"
#include "lambent/report/result.h"
#include "lambent/sh/coefficients.h"
#include "lambent/shade/sharp_sun.h"

namespace CLI {
class Option;
}

namespace lambent::tool {

struct LightArguments {
  std::string source;
  double rotateY = 0.0;  ///< degrees, right-handed about +y
  std::string window = "none";

  /// Returns the option of the source, which is required.
  CLI::Option* addTo(CLI::App& app, bool positional);
  /// Of verbs that show assets: they can soften lobes, and do unless told otherwise.
  void addWindowOfAssetsTo(CLI::App& app);
  /// Of verbs that know lights alone.
  void addWindowTo(CLI::App& app);
  bool softensLobes() const;
  /// How the source is turned.
  Mat3d worldFromSource() const;
  Result<light::Environment> environment(const ReadingArguments& reading, Console& console) const;
  /// The environment in n bands, windowed.
  Result<sh::RgbCoefficients> coefficients(const light::Environment& environment, int bands,
                                           Console& console) const;
  /// The environment's Sun, if it has one, with its share of what coefficients() makes.
  std::optional<shade::SharpSun> sharpSun(const light::Environment& environment, int bands) const;
};

}  // namespace lambent::tool
