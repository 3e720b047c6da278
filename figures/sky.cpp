#include "figures/sky.h"

#include <map>

namespace lambent::figures {

sky::SkyOptions skyOptions(const std::string& preset, sky::Model model, double sunZenithDegrees) {
  sky::SkyOptions options;
  options.model = model;
  options.atmosphere = sky::preset(preset).value();
  options.sunElevation = (90 - sunZenithDegrees) * kDegree;
  options.cache = sky::cacheFolder();
  return options;
}

sky::Sky skyOf(const sky::SkyOptions& options) {
  static sky::SkyMaker maker;
  static std::map<std::pair<std::string, double>, sky::Sky> exact;
  if (options.model != sky::Model::Exact) return orDie(maker.make(options)).value;
  const auto [at, isNew] =
      exact.try_emplace({options.atmosphere.name, options.sunElevation}, sky::Sky());
  if (isNew) at->second = orDie(maker.make(options)).value;
  return at->second;
}

}  // namespace lambent::figures
