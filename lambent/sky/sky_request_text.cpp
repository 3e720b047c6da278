// A request as the words it could have been read from.
#include <string>

#include <fmt/format.h>

#include "lambent/sky/sky_request.h"

namespace lambent::sky {
namespace {

std::string nameOfModel(const SkyRequest& request) {
  switch (request.model) {
    case Model::Exact:
      return "exact";
    case Model::Fast:
      return "fast";
    case Model::Preetham:
      return "preetham";
    case Model::Perez:
      return "perez";
    case Model::AsrcCie:
      return "asrc-cie";
    case Model::CieOvercast:
      return "cie-overcast";
    case Model::CieClear:
      return "cie-clear";
    case Model::CieGeneral:
      return fmt::format("cie:{}", request.cieType);
  }
  return "fast";
}

}  // namespace

std::string toText(const SkyRequest& request) {
  const SkyRequest usual;
  std::string text;
  const auto add = [&](std::string_view key, const auto& value) {
    text += fmt::format("{}{}={}", text.empty() ? "" : ",", key, value);
  };
  if (request.date) add("date", *request.date);
  if (request.time) add("time", *request.time);
  if (request.utcOffset != usual.utcOffset) add("utc-offset", request.utcOffset);
  if (request.latitude) add("lat", *request.latitude);
  if (request.longitude) add("lon", *request.longitude);
  if (request.sunElevation) add("sun-elevation", *request.sunElevation);
  if (request.sunAzimuth) add("sun-azimuth", *request.sunAzimuth);
  if (const std::string model = nameOfModel(request); model != nameOfModel(usual))
    add("model", model);
  if (request.turbidity) add("turbidity", *request.turbidity);
  if (request.albedo) add("albedo", *request.albedo);
  if (request.ozone) add("ozone", *request.ozone);
  if (request.altitude != usual.altitude) add("altitude", request.altitude);
  if (request.atmosphere != usual.atmosphere) add("atmosphere", request.atmosphere);
  if (request.directNormal) add("direct-normal", *request.directNormal);
  if (request.diffuseHorizontal) add("diffuse-horizontal", *request.diffuseHorizontal);
  if (request.refine != usual.refine) add("refine", request.refine);
  return text;
}

}  // namespace lambent::sky
