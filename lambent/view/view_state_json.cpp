// JSON → ViewState. Every complaint names the member by its path, "discs[2].radiance".
#include <cmath>

#include <fmt/format.h>
#include <Eigen/Geometry>
#include <nlohmann/json.hpp>

#include "lambent/file/atomic_file.h"
#include "lambent/file/json.h"
#include "lambent/light/windowing.h"
#include "lambent/view/view_state.h"

namespace lambent::view {

namespace {

using Json = nlohmann::json;

constexpr double kAnything = 1e30;  // finite as a float, with room to calculate
/// A state with a thousand discs is some 100 KB; what is much larger is some other file.
constexpr std::uintmax_t kMostBytes = 1 << 20;
/// Each costs a closed form in every frame that moves.
constexpr std::size_t kMostDiscs = 64;

std::string shown(const Json& value) {
  std::string text = value.dump(-1, ' ', true, Json::error_handler_t::replace);
  if (text.size() > 40) text = text.substr(0, 37) + "...";
  return text;
}

/// Reads members into values that hold their defaults. The first thing that is wrong is kept, and
/// nothing is read after it.
class Reader {
 public:
  explicit Reader(std::string name) : name_(std::move(name)) {}

  Status status() const {
    return complaint_.empty() ? Status::ok() : Status(report::badInput(complaint_));
  }
  void complain(const std::string& member, const std::string& what) {
    if (complaint_.empty()) complaint_ = fmt::format("{}: \"{}\" {}", name_, member, what);
  }

  /// The member, or nullptr if it is missing or something is wrong already.
  const Json* find(const Json& parent, const char* key) const {
    if (!complaint_.empty()) return nullptr;
    const auto found = parent.find(key);
    return found == parent.end() ? nullptr : &*found;
  }
  const Json* object(const Json& parent, const char* key) {
    const Json* value = find(parent, key);
    if (value && !value->is_object()) {
      complain(key, fmt::format("is {}, not an object {{…}}", shown(*value)));
      return nullptr;
    }
    return value;
  }

  void number(const Json& value, const std::string& member, double least, double most,
              double& into) {
    if (!value.is_number())
      return complain(member, fmt::format("is {}, not a number", shown(value)));
    const double given = value.get<double>();
    if (!(given >= least && given <= most))
      return complain(
          member, most >= kAnything
                      ? fmt::format("is {}, which is out of range", shown(value))
                      : fmt::format("is {}; it must be from {} to {}", shown(value), least, most));
    into = given;
  }
  void number(const Json& parent, const char* key, const std::string& member, double least,
              double most, double& into) {
    if (const Json* value = find(parent, key)) number(*value, member, least, most, into);
  }
  void optional(const Json& parent, const char* key, const std::string& member, double least,
                double most, std::optional<double>& into) {
    const Json* value = find(parent, key);
    if (!value) return;
    if (value->is_null()) return into.reset();
    double given = 0.0;
    number(*value, member, least, most, given);
    into = given;
  }
  template <class Numbers>
  void numbers(const Json& parent, const char* key, const std::string& member, int count,
               double least, Numbers& into) {
    const Json* value = find(parent, key);
    if (!value) return;
    if (!value->is_array() || value->size() != std::size_t(count))
      return complain(member, fmt::format("is {}, not a list of {} numbers", shown(*value), count));
    for (int i = 0; i < count; ++i) {
      double given = 0.0;
      number((*value)[std::size_t(i)], fmt::format("{}[{}]", member, i), least, kAnything, given);
      into[std::size_t(i)] = std::decay_t<decltype(into[0])>(given);
    }
  }
  void flag(const Json& parent, const char* key, const std::string& member, bool& into) {
    const Json* value = find(parent, key);
    if (!value) return;
    if (!value->is_boolean())
      return complain(member, fmt::format("is {}, not true or false", shown(*value)));
    into = value->get<bool>();
  }
  void text(const Json& parent, const char* key, const std::string& member, std::string& into) {
    const Json* value = find(parent, key);
    if (!value) return;
    if (!value->is_string()) return complain(member, fmt::format("is {}, not text", shown(*value)));
    into = value->get<std::string>();
  }
  void rotation(const Json& parent, const std::string& member, std::array<double, 4>& into) {
    if (!find(parent, "rotation")) return;
    std::array<double, 4> q{};
    numbers(parent, "rotation", member, 4, -kAnything, q);
    const double length = std::hypot(std::hypot(q[0], q[1]), std::hypot(q[2], q[3]));
    if (!(std::abs(length - 1.0) <= 0.01))
      return complain(member,
                      fmt::format("has length {:.4g}; a rotation is a quaternion [x, y, z, w] of "
                                  "length 1",
                                  length));
    // What is unit already, to rounding, stays bit for bit.
    if (std::abs(length - 1.0) > 1e-12)
      for (double& each : q) each /= length;
    into = q;
  }

 private:
  std::string name_, complaint_;
};

void readCamera(Reader& reader, const Json& json, std::optional<LookAt>& into) {
  const Json* found = reader.find(json, "camera");
  if (!found || found->is_null()) return;
  const Json* camera = reader.object(json, "camera");
  if (!camera) return;
  LookAt look;
  reader.numbers(*camera, "position", "camera.position", 3, -kAnything, look.position);
  reader.numbers(*camera, "target", "camera.target", 3, -kAnything, look.target);
  reader.numbers(*camera, "up", "camera.up", 3, -kAnything, look.up);
  reader.number(*camera, "verticalFov", "camera.verticalFov", 0.01, 179.0, look.verticalFov);
  reader.optional(*camera, "orthographicHalfHeight", "camera.orthographicHalfHeight", 1e-12,
                  kAnything, look.orthographicHalfHeight);
  const Vec3d sight = (look.target - look.position).cast<double>();
  const Vec3d up = look.up.cast<double>();
  if (!(sight.norm() > 0.0))
    reader.complain("camera.target", "is where the camera is: it looks nowhere");
  else if (!(sight.cross(up).norm() > 1e-6 * sight.norm() * up.norm()))
    reader.complain("camera.up", "is zero or lies along the line of sight: choose another");
  into = look;
}

void readAir(Reader& reader, const Json& json, std::optional<AirShown>& into) {
  const Json* found = reader.find(json, "air");
  if (!found || found->is_null()) return;
  const Json* air = reader.object(json, "air");
  if (!air) return;
  AirShown shown;
  reader.number(*air, "metresPerUnit", "air.metresPerUnit", shade::kLeastMetresPerUnit,
                shade::kMostMetresPerUnit, shown.metresPerUnit);
  reader.flag(*air, "shafts", "air.shafts", shown.shafts);
  into = shown;
}

void readDiscs(Reader& reader, const Json& json, std::vector<Disc>& into) {
  const Json* discs = reader.find(json, "discs");
  if (!discs) return;
  if (!discs->is_array() || discs->size() > kMostDiscs)
    return reader.complain("discs", fmt::format("must be a list of at most {} discs", kMostDiscs));
  into.clear();
  for (std::size_t i = 0; i < discs->size(); ++i) {
    const Json& each = (*discs)[i];
    const std::string member = fmt::format("discs[{}]", i);
    if (!each.is_object())
      return reader.complain(member, fmt::format("is {}, not an object {{…}}", shown(each)));
    Disc disc;
    reader.number(each, "azimuth", member + ".azimuth", -36000, 36000, disc.azimuth);
    reader.number(each, "elevation", member + ".elevation", -90, 90, disc.elevation);
    reader.number(each, "diameter", member + ".diameter", 1e-6, 360, disc.diameter);
    reader.numbers(each, "radiance", member + ".radiance", 3, 0.0, disc.radiance);
    into.push_back(disc);
  }
}

}  // namespace

Result<ViewState> parseViewState(std::string_view text, const std::string& name) {
  const Result<Json> parsed = file::parseJson(text);
  if (!parsed)
    return report::badInput(fmt::format("{}: not JSON ({})", name, parsed.error().message));
  const Json& json = *parsed;
  const auto lambent = json.is_object() ? json.find("lambent") : json.end();
  if (!json.is_object() || lambent == json.end() || *lambent != "view")
    return report::badInput(fmt::format(
        "{}: JSON, but not the state of a viewer: \"lambent\": \"view\" is missing", name));
  Reader reader(name);
  double version = 1;
  reader.number(json, "version", "version", 0, kAnything, version);
  if (version != 1)
    reader.complain("version", fmt::format("is {}; this Lambent reads version 1", version));

  ViewState state;
  readCamera(reader, json, state.camera);
  if (const Json* object = reader.object(json, "object")) {
    reader.rotation(*object, "object.rotation", state.objectRotation);
    reader.numbers(*object, "translation", "object.translation", 3, -kAnything,
                   state.objectTranslation);
  }
  if (const Json* environment = reader.object(json, "environment")) {
    reader.text(*environment, "source", "environment.source", state.environment);
    reader.rotation(*environment, "environment.rotation", state.environmentRotation);
    if (state.environment.empty()) reader.complain("environment.source", "is empty");
  }
  readDiscs(reader, json, state.discs);
  reader.text(json, "window", "window", state.window);
  if (const auto windowing = light::parseWindowing(state.window); !windowing)
    reader.complain("window", "is " + windowing.error().message);
  std::string transfer(shade::choiceName(state.transfer));
  reader.text(json, "transfer", "transfer", transfer);
  if (const auto choice = shade::choiceNamed(transfer))
    state.transfer = *choice;
  else
    reader.complain("transfer",
                    fmt::format("is \"{}\"; it must be \"best\", \"unshadowed\", \"shadowed\" or "
                                "\"interreflected\"",
                                transfer));
  std::string sunShadow = "sharp";
  reader.text(json, "sunShadow", "sunShadow", sunShadow);
  if (sunShadow == "soft") state.sunShadow = shade::SunShadow::Soft;
  if (sunShadow != "sharp" && sunShadow != "soft")
    reader.complain("sunShadow",
                    fmt::format("is \"{}\"; it must be \"sharp\" or \"soft\"", sunShadow));
  readAir(reader, json, state.air);
  reader.flag(json, "macro", "macro", state.macro);
  reader.flag(json, "viewDependent", "viewDependent", state.viewDependent);
  reader.optional(json, "lobe", "lobe", 0.0, 1e5, state.lobe);
  reader.number(json, "exposure", "exposure", -60, 60, state.exposure);
  std::string tone = "filmic";
  reader.text(json, "tone", "tone", tone);
  if (tone == "linear") state.tone = tone::Curve::Linear;
  if (tone != "linear" && tone != "filmic")
    reader.complain("tone", fmt::format("is \"{}\"; it must be \"filmic\" or \"linear\"", tone));
  reader.flag(json, "background", "background", state.background);
  double samples = state.samples;
  reader.number(json, "samples", "samples", 1, 4096, samples);
  if (samples != std::floor(samples)) reader.complain("samples", "must be a whole number");
  state.samples = int(samples);

  if (const Status status = reader.status(); !status) return status.error();
  return state;
}

Result<ViewState> readViewState(const std::filesystem::path& path) {
  std::error_code ignored;
  const std::uintmax_t size = std::filesystem::file_size(path, ignored);
  if (!ignored && size > kMostBytes)
    return report::badInput(
        fmt::format("{}: {} bytes are too many for the state of a viewer", path.string(), size));
  const Result<std::vector<std::byte>> bytes = file::readWhole(path);
  if (!bytes) return bytes.error();
  return parseViewState(
      std::string_view(reinterpret_cast<const char*>(bytes->data()), bytes->size()), path.string());
}

}  // namespace lambent::view
