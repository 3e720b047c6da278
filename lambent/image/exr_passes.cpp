// The names of passes that renderers in use write: Blender, Arnold, V-Ray, RenderMan, Karma, Octane,
// Redshift, pbrt, Mitsuba, Nuke.
#include "lambent/image/exr_passes.h"

#include <algorithm>
#include <cctype>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace lambent::image::formats {
namespace {

constexpr std::string_view kPictures[] = {"combined", "beauty", "composite", "composited"};
constexpr std::string_view kColours[] = {"rgba", "rgb",  "color", "colour", "c",
                                         "ci",   "main", "image", "final",  "default"};
constexpr std::string_view kSilent[] = {"viewlayer", "renderlayer", "view",  "layer",    "render",
                                        "left",      "right",       "part",  "subimage", "scene",
                                        "master",    "root",        "noisy", "denoised"};
constexpr std::string_view kShares[] = {
    "diffuse",    "diff",       "specular", "spec",        "reflection",   "reflect",
    "refraction", "refract",    "glossy",   "gloss",       "transmission", "trans",
    "emission",   "emit",       "env",      "environment", "background",   "gi",
    "sss",        "subsurface", "direct",   "indirect",    "dir",          "ind",
    "volume",     "coat",       "sheen",    "lighting",    "light",        "selfillum",
    "caustics"};
constexpr std::string_view kOthers[] = {
    "ao",       "occlusion", "occ",       "depth",     "z",        "zdepth",    "distance",
    "dist",     "normal",    "normals",   "n",         "ns",       "ng",        "nn",
    "position", "positions", "pos",       "p",         "pworld",   "albedo",    "basecolor",
    "col",      "filter",    "mist",      "uv",        "uvs",      "st",        "vector",
    "motion",   "velocity",  "speed",     "shadow",    "shadows",  "mask",      "matte",
    "alpha",    "id",        "index",     "object",    "material", "variance",  "error",
    "debug",    "roughness", "metallic",  "metalness", "opacity",  "curvature", "facing",
    "fresnel",  "ior",       "wireframe", "coverage",  "tangent",  "samples",   "samplecount",
    "indexma",  "indexob",   "dpdu",      "dpdv",      "dzdx",     "dzdy",      "multimatte"};

bool holds(std::span<const std::string_view> list, std::string_view word) {
  return std::find(list.begin(), list.end(), word) != list.end();
}

/// "DenoisingAlbedo 2" → denoising, albedo; "AO" → ao; "ZDepth" → z, depth; "crypto00" → crypto.
std::vector<std::string> wordsOf(std::string_view text) {
  std::vector<std::string> words(1);
  const auto is = [&](std::size_t i, int (*kind)(int)) {
    return i < text.size() && kind(static_cast<unsigned char>(text[i])) != 0;
  };
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool begins =
        is(i, std::isupper) && i > 0 &&
        (is(i - 1, std::islower) || (is(i - 1, std::isupper) && is(i + 1, std::islower)));
    if (begins || !is(i, std::isalpha)) words.emplace_back();
    if (is(i, std::isalpha))
      words.back() += static_cast<char>(std::tolower(static_cast<unsigned char>(text[i])));
  }
  std::erase_if(words, [](const std::string& word) { return word.empty(); });
  return words;
}

std::string joined(const std::vector<std::string>& words) {
  std::string all;
  for (const std::string& word : words) all += word;
  return all;
}

/// Nothing: words that say nothing, or none. Unnamed: "colour", of whatever.
std::optional<Pass> passOfWords(const std::vector<std::string>& words) {
  const std::string whole = joined(words);
  const auto any = [&](std::span<const std::string_view> list) {
    const auto listed = [&](const std::string& word) { return holds(list, word); };
    return holds(list, whole) || std::any_of(words.begin(), words.end(), listed);
  };
  const auto silent = [](const std::string& word) { return holds(kSilent, word); };
  if (whole.starts_with("crypto")) return Pass::Other;
  if (any(kPictures)) return Pass::Picture;
  if (any(kOthers)) return Pass::Other;
  if (any(kShares)) return any(kColours) ? Pass::Other : Pass::Share;  // "Diffuse Color": an albedo
  if (any(kColours)) return Pass::Unnamed;
  if (holds(kSilent, whole) || std::all_of(words.begin(), words.end(), silent)) return std::nullopt;
  return Pass::Unknown;
}

}  // namespace

Pass passOf(std::string_view name) {
  Pass found = Pass::Unnamed;
  bool colour = false;
  for (bool more = true; more;) {
    const std::size_t dot = name.rfind('.');
    more = dot != std::string_view::npos;
    const std::optional<Pass> pass = passOfWords(wordsOf(more ? name.substr(dot + 1) : name));
    colour = colour || pass == Pass::Unnamed;
    if (pass == Pass::Unknown)
      found = Pass::Unknown;
    else if (pass && *pass != Pass::Unnamed)
      return *pass;
    if (more) name = name.substr(0, dot);
  }
  return colour ? Pass::Picture : found;
}

bool sameName(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](char x, char y) {
    return std::tolower(static_cast<unsigned char>(x)) ==
           std::tolower(static_cast<unsigned char>(y));
  });
}

}  // namespace lambent::image::formats
