#include "lambent/asset/surface_part.h"

#include <algorithm>
#include <cmath>

#include "lambent/asset/receivers_part.h"
#include "lambent/transfer/names.h"

namespace lambent::asset {

using nlohmann::json;
using transfer::Diffuse;
using transfer::Glossy;
using transfer::Kind;
using transfer::Numbers;
using Response = transfer::SurfaceResponse<Numbers>;
using Surface = transfer::Surface<Numbers>;

namespace {

/// What is kept beside shares bands, albedo and lobe with the primitive's own: its JSON has
/// channels and numbers alone.
json keptJson(const Response& response, scene_io::GltfBuilder& gltf) {
  json object = json::object();
  if (const auto& diffuse = response.diffuse)
    object["vectors"] =
        toJson(diffuse->vectors.numbers, gltf, {{"channels", diffuse->vectors.channels}});
  if (const auto& glossy = response.glossy)
    object["matrices"] =
        toJson(glossy->matrices.numbers, gltf, {{"channels", glossy->matrices.channels}});
  return object;
}

Diffuse<Numbers> diffuseFrom(JsonFields fields, AccessorReader& accessors) {
  Diffuse<Numbers> diffuse;
  diffuse.vectors.bands = int(fields.integer("bands", 1, sh::kMaxBands));
  diffuse.vectors.channels = channelsFrom(fields);
  const auto albedo = transfer::albedoNamed(fields.string("albedo"));
  if (!albedo) fields.complain("albedo", "is neither included nor baseColor");
  diffuse.albedo = albedo.value_or(diffuse.albedo);
  diffuse.vectors.numbers = numbersFrom(fields, accessors, Snorm8::Refused);
  return diffuse;
}

Glossy<Numbers> glossyFrom(JsonFields fields, AccessorReader& accessors) {
  Glossy<Numbers> glossy;
  glossy.matrices.outBands = int(fields.integer("outBands", 1, sh::kMaxBands));
  glossy.matrices.inBands = int(fields.integer("inBands", 1, sh::kMaxBands));
  glossy.matrices.channels = channelsFrom(fields);
  const std::vector<double> reflectance = fields.numbers("glossy", 3);
  if (reflectance.size() != 3) fields.complain("glossy", "is not an array of 3 numbers");
  for (std::size_t c = 0; c < reflectance.size(); ++c)
    glossy.lobe.reflectance[int(c)] = float(reflectance[c]);
  glossy.lobe.exponent =
      float(fields.number("lobeExponent", 0.0, std::numeric_limits<float>::max()));
  glossy.matrices.numbers = numbersFrom(fields, accessors, Snorm8::Refused);
  return glossy;
}

/// What is not there beside is missing in `own` too, or the checker says so.
Response keptFrom(JsonFields object, AccessorReader& accessors, const Response& own) {
  Response kept;
  if (object.has("vectors")) {
    JsonFields fields = object.object("vectors");
    Diffuse<Numbers>& diffuse = kept.diffuse.emplace();
    if (own.diffuse) diffuse.albedo = own.diffuse->albedo;
    diffuse.vectors.bands = own.diffuse ? own.diffuse->vectors.bands : 0;
    diffuse.vectors.channels = channelsFrom(fields);
    diffuse.vectors.numbers = numbersFrom(fields, accessors, Snorm8::Refused);
  }
  if (object.has("matrices")) {
    JsonFields fields = object.object("matrices");
    Glossy<Numbers>& glossy = kept.glossy.emplace();
    if (own.glossy)
      glossy = {own.glossy->lobe,
                {own.glossy->matrices.outBands, own.glossy->matrices.inBands, 0, {}}};
    glossy.matrices.channels = channelsFrom(fields);
    glossy.matrices.numbers = numbersFrom(fields, accessors, Snorm8::Refused);
  }
  return kept;
}

Wrong faultOfLobe(const transfer::Lobe& lobe) {
  if (!lobe.reflectance.isFinite().all() || (lobe.reflectance < 0.0f).any())
    return "matrices: glossy must be three finite numbers, none below 0";
  if (!std::isfinite(lobe.exponent) || lobe.exponent < 0.0f)
    return "matrices: lobeExponent must be finite and not below 0";
  return std::nullopt;
}

Wrong faultOfResponse(const Response& response, std::size_t receivers, const std::string& prefix) {
  if (response.diffuse)
    if (auto wrong = faultOf(response.diffuse->vectors, receivers, prefix + "vectors"))
      return wrong;
  if (!response.glossy) return std::nullopt;
  if (auto wrong = faultOf(response.glossy->matrices, receivers, prefix + "matrices")) return wrong;
  return faultOfLobe(response.glossy->lobe);
}

/// What is kept beside is whole: a reader that switches to it must not mix it with the other.
Wrong faultOfKept(Kind kind, const Response& kept, const Response& own, Kind fieldKind,
                  std::size_t receivers) {
  const std::string name(transfer::nameOf(kind));
  if (kind != Kind::Shadowed) return name + ": shadowed transfer alone is kept beside another kind";
  if (fieldKind != Kind::Interreflected)
    return "shadowed: kept beside interreflected transfer alone, and this asset's is " +
           std::string(transfer::nameOf(fieldKind));
  if (kept.diffuse.has_value() != own.diffuse.has_value() ||
      kept.glossy.has_value() != own.glossy.has_value())
    return std::string("shadowed: must hold vectors and matrices where the primitive does");
  if (kept.diffuse && (kept.diffuse->vectors.bands != own.diffuse->vectors.bands ||
                       kept.diffuse->albedo != own.diffuse->albedo))
    return std::string("shadowed.vectors: bands and albedo must be those of vectors");
  if (kept.glossy && (kept.glossy->matrices.outBands != own.glossy->matrices.outBands ||
                      kept.glossy->matrices.inBands != own.glossy->matrices.inBands ||
                      (kept.glossy->lobe.reflectance != own.glossy->lobe.reflectance).any() ||
                      kept.glossy->lobe.exponent != own.glossy->lobe.exponent))
    return std::string("shadowed.matrices: bands and lobe must be those of matrices");
  return faultOfResponse(kept, receivers, "shadowed.");
}

}  // namespace

json toJson(const Surface& surface, const scene::Mesh& mesh, Kind kind,
            scene_io::GltfBuilder& gltf) {
  json object = json::object();
  const Response& own = *surface.responses.find(kind);
  if (const auto& diffuse = own.diffuse)
    object["vectors"] = toJson(diffuse->vectors.numbers, gltf,
                               {{"bands", diffuse->vectors.bands},
                                {"channels", diffuse->vectors.channels},
                                {"albedo", transfer::nameOf(diffuse->albedo)}});
  if (const auto& glossy = own.glossy) {
    const Rgb& k = glossy->lobe.reflectance;
    object["matrices"] = toJson(glossy->matrices.numbers, gltf,
                                {{"outBands", glossy->matrices.outBands},
                                 {"inBands", glossy->matrices.inBands},
                                 {"channels", glossy->matrices.channels},
                                 {"glossy", {k[0], k[1], k[2]}},
                                 {"lobeExponent", glossy->lobe.exponent}});
  }
  surface.responses.each([&](Kind held, const Response& response) {
    if (held != kind) object[std::string(transfer::nameOf(held))] = keptJson(response, gltf);
  });
  writeReceivers(*surface.receivers, mesh, gltf, object);
  return object;
}

Surface surfaceFrom(JsonFields& object, AccessorReader& accessors,
                    transfer::SharedReceivers receivers, Kind kind) {
  Response own;
  if (object.has("vectors")) own.diffuse = diffuseFrom(object.object("vectors"), accessors);
  if (object.has("matrices")) own.glossy = glossyFrom(object.object("matrices"), accessors);
  Surface surface{std::move(receivers), {}};
  if (object.has("shadowed")) {
    Response kept = keptFrom(object.object("shadowed"), accessors, own);
    const bool any = kept.diffuse || kept.glossy;  // one that says nothing is passed over
    if (any && kind == Kind::Shadowed)
      object.complain("shadowed",
                      "kept beside interreflected transfer alone, and this asset's is shadowed");
    if (any) surface.responses.set(Kind::Shadowed, std::move(kept));
  }
  surface.responses.set(kind, std::move(own));
  return surface;
}

namespace {

/// What takes more bands of light than the asset says, by its member's name.
Wrong faultOfBands(const Response& response, int bands) {
  const auto tooMany = [&](const char* member, int taken) {
    return std::string(member) + ": takes light of " + std::to_string(taken) +
           " bands, more than the asset's " + std::to_string(bands);
  };
  if (response.diffuse && response.diffuse->vectors.bands > bands)
    return tooMany("vectors.bands", response.diffuse->vectors.bands);
  if (response.glossy && response.glossy->matrices.inBands > bands)
    return tooMany("matrices.inBands", response.glossy->matrices.inBands);
  return std::nullopt;
}

}  // namespace

Wrong faultOf(const Surface& surface, const transfer::EncodedField& field) {
  const Response* own = surface.responses.find(field.kind);
  if (!own)
    return "holds no " + std::string(transfer::nameOf(field.kind)) +
           " transfer, which the asset's is";
  const std::size_t receivers = surface.receivers->size();
  if (auto wrong = faultOfResponse(*own, receivers, "")) return wrong;
  Wrong wrong;
  surface.responses.each([&](Kind kind, const Response& response) {
    if (kind != field.kind && !wrong)
      wrong = faultOfKept(kind, response, *own, field.kind, receivers);
  });
  return wrong ? wrong : faultOfBands(*own, field.bands);
}

void count(const Surface& surface, PartBytes& bytes) {
  count(*surface.receivers, bytes);
  surface.responses.each([&](Kind, const Response& response) {
    if (response.diffuse) bytes.vectors += transfer::bytesOf(response.diffuse->vectors.numbers);
    if (response.glossy) bytes.matrices += transfer::bytesOf(response.glossy->matrices.numbers);
  });
}

}  // namespace lambent::asset
