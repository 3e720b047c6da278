#include "lambent/view/view_state.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "lambent/file/atomic_file.h"

namespace lambent::view {

namespace {

// fmt writes a float with the fewest digits that are this float: 0.3, not 0.30000001192092896.

template <class Triple>
std::string list(const Triple& v) {
  return fmt::format("[{}, {}, {}]", v[0], v[1], v[2]);
}

std::string list(const std::array<double, 4>& v) {
  return fmt::format("[{}]", fmt::join(v, ", "));
}

std::string numberOrNull(const std::optional<double>& value) {
  return value ? fmt::format("{}", *value) : "null";
}

std::string quoted(const std::string& text) {
  using Json = nlohmann::json;
  return Json(text).dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string cameraOf(const std::optional<LookAt>& camera) {
  if (!camera) return "null";
  return fmt::format(
      "{{\"position\": {}, \"target\": {}, \"up\": {},\n"
      "             \"verticalFov\": {}, \"orthographicHalfHeight\": {}}}",
      list(camera->position), list(camera->target), list(camera->up), camera->verticalFov,
      numberOrNull(camera->orthographicHalfHeight));
}

}  // namespace

bool operator==(const LookAt& a, const LookAt& b) {
  return a.position == b.position && a.target == b.target && a.up == b.up &&
         a.verticalFov == b.verticalFov && a.orthographicHalfHeight == b.orthographicHalfHeight;
}

bool operator==(const Disc& a, const Disc& b) {
  return a.azimuth == b.azimuth && a.elevation == b.elevation && a.diameter == b.diameter &&
         (a.radiance == b.radiance).all();
}

bool operator==(const AirShown& a, const AirShown& b) {
  return a.metresPerUnit == b.metresPerUnit && a.shafts == b.shafts;
}

bool operator==(const ViewState& a, const ViewState& b) {
  return a.camera == b.camera && a.objectRotation == b.objectRotation &&
         a.objectTranslation == b.objectTranslation && a.environment == b.environment &&
         a.environmentRotation == b.environmentRotation && a.discs == b.discs &&
         a.window == b.window && a.transfer == b.transfer && a.sunShadow == b.sunShadow &&
         a.air == b.air && a.macro == b.macro && a.viewDependent == b.viewDependent &&
         a.lobe == b.lobe && a.exposure == b.exposure && a.tone == b.tone &&
         a.background == b.background && a.samples == b.samples;
}

std::string toJson(const ViewState& state) {
  std::string discs;
  for (const Disc& disc : state.discs)
    discs += fmt::format(
        "{}\n    {{\"azimuth\": {}, \"elevation\": {}, \"diameter\": {}, \"radiance\": {}}}",
        discs.empty() ? "" : ",", disc.azimuth, disc.elevation, disc.diameter, list(disc.radiance));
  std::string json = "{\n  \"lambent\": \"view\",\n  \"version\": 1";
  const auto add = [&](std::string_view member, const std::string& value) {
    json += fmt::format(",\n  \"{}\": {}", member, value);
  };
  const auto flag = [](bool value) { return std::string(value ? "true" : "false"); };
  add("camera", cameraOf(state.camera));
  add("object", fmt::format("{{\"rotation\": {}, \"translation\": {}}}", list(state.objectRotation),
                            list(state.objectTranslation)));
  add("environment", fmt::format("{{\"source\": {}, \"rotation\": {}}}", quoted(state.environment),
                                 list(state.environmentRotation)));
  add("discs", "[" + discs + (discs.empty() ? "]" : "\n  ]"));
  add("window", quoted(state.window));
  add("transfer", quoted(std::string(shade::choiceName(state.transfer))));
  add("sunShadow", state.sunShadow == shade::SunShadow::Sharp ? "\"sharp\"" : "\"soft\"");
  add("air", state.air ? fmt::format("{{\"metresPerUnit\": {}, \"shafts\": {}}}",
                                     state.air->metresPerUnit, state.air->shafts)
                       : "null");
  add("macro", flag(state.macro));
  add("viewDependent", flag(state.viewDependent));
  add("lobe", numberOrNull(state.lobe));
  add("exposure", fmt::format("{}", state.exposure));
  add("tone", state.tone == tone::Curve::Linear ? "\"linear\"" : "\"filmic\"");
  add("background", flag(state.background));
  add("samples", fmt::format("{}", state.samples));
  return json + "\n}\n";
}

Status writeViewState(const ViewState& state, const std::filesystem::path& path) {
  return file::writeAtomically(path, toJson(state));
}

}  // namespace lambent::view
