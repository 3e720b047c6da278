#include "lambent/image/exr_choice.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStandardAttributes.h>

#include <algorithm>
#include <functional>
#include <map>
#include <optional>
#include <tuple>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "lambent/image/exr_passes.h"

namespace lambent::image::formats {
namespace {

using Model = ExrColour::Model;

/// The channels of one part with the same words before the last dot.
struct Layer {
  int part = 0;
  std::string partName, prefix;
  std::vector<std::string> channels;  ///< whole names
  int view = 0;                       ///< 0: the first or only one
};

std::string_view lastWord(std::string_view channel) {
  const std::size_t dot = channel.rfind('.');
  return dot == std::string_view::npos ? channel : channel.substr(dot + 1);
}

std::string_view prefixOf(std::string_view channel) {
  const std::size_t dot = channel.rfind('.');
  return dot == std::string_view::npos ? std::string_view() : channel.substr(0, dot);
}

bool isDeep(const Imf::Header& header) {
  return header.hasType() && Imf::isDeepData(header.type());
}

/// The place of a view in the file's list of them; without a list, left comes before right.
int placeOfView(std::string_view view, const std::vector<std::string>& views) {
  const auto at = std::find(views.begin(), views.end(), view);
  if (at != views.end()) return static_cast<int>(at - views.begin());
  return view == "right" ? 1 : 0;
}

/// A part's view, or the one that the name of a layer ends with.
int viewOf(const Imf::Header& header, std::string_view prefix,
           const std::vector<std::string>& views) {
  if (header.hasView()) return placeOfView(header.view(), views);
  return placeOfView(lastWord(prefix), views);
}

std::vector<Layer> layersOf(const Imf::MultiPartInputFile& file) {
  std::vector<Layer> layers;
  std::vector<std::string> views;
  if (file.parts() > 0 && Imf::hasMultiView(file.header(0))) views = Imf::multiView(file.header(0));
  for (int part = 0; part < file.parts(); ++part) {
    const Imf::Header& header = file.header(part);
    if (isDeep(header)) continue;
    const std::string partName = header.hasName() ? header.name() : "";
    std::map<std::string_view, std::size_t> placeOf;  // headers may name channels by the thousand
    for (auto i = header.channels().begin(); i != header.channels().end(); ++i) {
      const std::string_view prefix = prefixOf(i.name());
      const auto [at, isNew] = placeOf.emplace(prefix, layers.size());
      if (isNew)
        layers.push_back({part, partName, std::string(prefix), {}, viewOf(header, prefix, views)});
      layers[at->second].channels.emplace_back(i.name());
    }
  }
  return layers;
}

std::string find(const Layer& layer, std::string_view brief, std::string_view full = {}) {
  for (const std::string& channel : layer.channels) {
    const std::string_view word = lastWord(channel);
    if (sameName(word, brief) || (!full.empty() && sameName(word, full))) return channel;
  }
  return {};
}

/// What a layer is called where all parts are seen: "part.prefix", either, or neither.
std::string fullNameOf(const Layer& layer, int parts) {
  if (parts == 1 || layer.partName.empty()) return layer.prefix;
  if (layer.prefix.empty() || layer.prefix == layer.partName) return layer.partName;
  return layer.partName + "." + layer.prefix;
}

/// The best that a layer's channels can be read as; nothing: several channels and no colour.
std::optional<ExrColour> colourOf(const Layer& layer, Pass pass) {
  ExrColour colour{layer.part, layer.prefix, {}, find(layer, "a", "alpha"), Model::Rgb};
  const auto complete = [&](Model model, std::array<std::string, 3> channels) {
    colour.model = model;
    colour.channels = std::move(channels);
    return std::none_of(colour.channels.begin(), colour.channels.end(),
                        [](const std::string& name) { return name.empty(); });
  };
  if (complete(Model::Rgb,
               {find(layer, "r", "red"), find(layer, "g", "green"), find(layer, "b", "blue")}))
    return colour;
  const std::string y = find(layer, "y");
  // Elsewhere X, Y and Z are places and normals.
  const bool named = pass == Pass::Unknown || pass == Pass::Other;
  if (!named && complete(Model::Xyz, {find(layer, "x"), y, find(layer, "z")})) return colour;
  const bool vector = !find(layer, "x").empty();
  if (!y.empty() && !vector) {
    const bool chroma = !find(layer, "ry").empty() && !find(layer, "by").empty();
    (void)complete(chroma ? Model::Chroma : Model::Luminance, {y, y, y});
    return colour;
  }
  if (layer.channels.size() != 1) return std::nullopt;
  const std::string& only = layer.channels[0];
  (void)complete(Model::Single, {only, only, only});
  colour.alpha.clear();
  return colour;
}

struct Candidate {
  ExrColour colour;
  Pass pass;
  int view;
  std::string name;
  std::size_t layer;  ///< its place in the list

  auto rank() const {
    const bool single = colour.model == Model::Single;
    const bool grey = colour.model == Model::Luminance;
    // An unnamed picture comes first; a single channel is what is left.
    const int place = pass == Pass::Unnamed || (pass == Pass::Picture && colour.layer.empty())
                          ? 0
                          : static_cast<int>(pass) + 1;
    return std::tuple(single, place, grey, view, layer);
  }
};

std::vector<Candidate> candidatesOf(const std::vector<Layer>& layers, int parts) {
  std::vector<Candidate> candidates;
  for (std::size_t i = 0; i < layers.size(); ++i) {
    const std::string name = fullNameOf(layers[i], parts);
    const Pass pass = passOf(name);
    if (std::optional<ExrColour> colour = colourOf(layers[i], pass)) {
      const bool single = colour->model == Model::Single;
      const std::string whole = single ? name + "." + colour->channels[0] : name;
      candidates.push_back(
          {std::move(*colour), single ? passOf(whole) : pass, layers[i].view, name, i});
    }
  }
  return candidates;
}

/// "AO (R G B)"
std::string describe(const Layer& layer, int parts) {
  std::vector<std::string_view> words;
  for (const std::string& channel : layer.channels) words.push_back(lastWord(channel));
  const std::string name = fullNameOf(layer, parts);
  return fmt::format("{}{}({})", name, name.empty() ? "" : " ", fmt::join(words, " "));
}

std::string describe(const std::vector<Layer>& layers, int parts) {
  constexpr std::size_t kMost = 12;
  std::string text;
  for (std::size_t i = 0; i < std::min(layers.size(), kMost); ++i)
    text += (i > 0 ? ", " : "") + describe(layers[i], parts);
  return layers.size() > kMost ? text + fmt::format(" and {} more", layers.size() - kMost) : text;
}

/// A layer in what the picture takes of it and what it does not.
std::pair<Layer, Layer> divide(const Layer& layer, const ExrColour& colour) {
  Layer used{layer.part, layer.partName, layer.prefix, {}, layer.view}, unused = used;
  const std::string stem = colour.model == Model::Chroma
                               ? colour.channels[0].substr(0, colour.channels[0].size() - 1)
                               : std::string();
  for (const std::string& channel : layer.channels) {
    const bool chroma = colour.model == Model::Chroma &&
                        (sameName(channel, stem + "RY") || sameName(channel, stem + "BY"));
    const auto& three = colour.channels;
    const bool taken = chroma || channel == colour.alpha ||
                       std::find(three.begin(), three.end(), channel) != three.end();
    (taken ? used : unused).channels.push_back(channel);
  }
  return {std::move(used), std::move(unused)};
}

int deepParts(const Imf::MultiPartInputFile& file) {
  int count = 0;
  for (int part = 0; part < file.parts(); ++part) count += isDeep(file.header(part));
  return count;
}

/// What was taken and what was left; nothing if the picture is all that there is.
void tellChoice(const Candidate& taken, std::vector<Layer> layers,
                const Imf::MultiPartInputFile& file, std::string_view name, Findings& findings) {
  const auto [used, unused] = divide(layers[taken.layer], taken.colour);
  if (unused.channels.empty())
    layers.erase(layers.begin() + std::ptrdiff_t(taken.layer));
  else
    layers[taken.layer] = unused;
  const auto deep = static_cast<std::size_t>(deepParts(file));
  const bool dubious = taken.pass >= Pass::Share || taken.colour.model == Model::Single;
  if (layers.empty() && deep == 0 && !dubious) return;
  std::string text = fmt::format("{}: the picture is {}", name, describe(used, file.parts()));
  if (dubious) text += ", which by its name may be no light, or not all of it";
  if (!layers.empty())
    text += fmt::format("; left: {}. For another write its name behind the file's, FILE.exr:LAYER",
                        describe(layers, file.parts()));
  if (deep > 0) text += fmt::format("; {} part(s) with deep pixels cannot be read", deep);
  // What is left beside a picture that is one by its name is no loss of light.
  const bool unsure = dubious || taken.pass == Pass::Unknown;
  findings.push_back({unsure ? Severity::Warning : Severity::Note, "exr-layers", text,
                      layers.size() + deep, unsure});
}

/// Whether a person who writes `wanted` means this layer: its name, the name of its part, or the end
/// of either.
bool isMeant(const Layer& layer, int parts, std::string_view wanted) {
  const std::string full = fullNameOf(layer, parts);
  if (sameName(full, wanted) || sameName(layer.prefix, wanted) || sameName(layer.partName, wanted))
    return true;
  return full.size() > wanted.size() && full[full.size() - wanted.size() - 1] == '.' &&
         sameName(std::string_view(full).substr(full.size() - wanted.size()), wanted);
}

/// "depth.Z", "Z": one channel of any layer.
std::optional<Candidate> channelNamed(const std::vector<Layer>& layers, std::string_view wanted) {
  for (std::size_t i = 0; i < layers.size(); ++i)
    for (const std::string& channel : layers[i].channels)
      if (sameName(channel, wanted))
        return Candidate{
            {layers[i].part, layers[i].prefix, {channel, channel, channel}, {}, Model::Single},
            Pass::Unknown,
            0,
            channel,
            i};
  return std::nullopt;
}

}  // namespace

Result<WithFindings<ExrColour>> chooseColour(const Imf::MultiPartInputFile& file,
                                             std::string_view layer, std::string_view name) {
  const std::vector<Layer> layers = layersOf(file);
  if (layers.empty())
    return report::badInput(
        fmt::format("{}: deep pixels cannot be read; flatten the picture", name));
  std::vector<Candidate> candidates = candidatesOf(layers, file.parts());
  if (!layer.empty()) {
    std::erase_if(candidates, [&](const Candidate& candidate) {
      return !isMeant(layers[candidate.layer], file.parts(), layer);
    });
    if (candidates.empty())
      if (std::optional<Candidate> channel = channelNamed(layers, layer))
        candidates.push_back(std::move(*channel));
  }
  const auto exact = [&](const Candidate& candidate) { return sameName(candidate.name, layer); };
  if (!layer.empty() && std::any_of(candidates.begin(), candidates.end(), exact))
    std::erase_if(candidates, std::not_fn(exact));
  if (candidates.empty() && !layer.empty())
    return report::badInput(
        fmt::format("{}: has no layer {} with channels R, G, B or one channel; it has {}", name,
                    layer, describe(layers, file.parts())));
  if (candidates.empty())
    return report::badInput(fmt::format(
        "{}: has neither channels R, G, B nor Y; it has {}; save it with colour channels", name,
        describe(layers, file.parts())));
  const auto best =
      std::min_element(candidates.begin(), candidates.end(),
                       [](const Candidate& a, const Candidate& b) { return a.rank() < b.rank(); });
  WithFindings<ExrColour> chosen{best->colour, {}};
  if (layer.empty()) tellChoice(*best, layers, file, name, chosen.findings);
  return chosen;
}

}  // namespace lambent::image::formats
