// Which part and channels of an OpenEXR file are the picture. Internal to this room.
#pragma once

#include <OpenEXR/ImfMultiPartInputFile.h>

#include <array>
#include <string>
#include <string_view>

#include "lambent/report/finding.h"
#include "lambent/report/result.h"

namespace lambent::image::formats {

struct ExrColour {
  enum class Model {
    Rgb,
    Xyz,        ///< channels X, Y, Z
    Chroma,     ///< luminance Y with RY and BY, subsampled
    Luminance,  ///< Y alone
    Single      ///< any other channel, as grey
  };
  int part = 0;
  std::string layer;  ///< what stands before the last dot of its channels, or empty
  std::array<std::string, 3> channels;  ///< whole names; the same three times: grey
  std::string alpha;                    ///< empty: opaque
  Model model = Model::Rgb;
};

/// Takes colour where colour is: a whole picture (unnamed, or "Combined", "beauty", "rgba" …) before
/// layers with other names, those before shares of the light, and those before what is no light (AO,
/// depth, albedo, normals); RGB before grey; of several views the first. If `layer` is not empty:
/// the layer, part, or single channel of that name.
///
/// "exr-layers" names what was taken and what was left. BadInput: no flat part, no colour, or no
/// such layer.
Result<WithFindings<ExrColour>> chooseColour(const Imf::MultiPartInputFile& file,
                                             std::string_view layer, std::string_view name);

}  // namespace lambent::image::formats
