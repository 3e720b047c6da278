// How a patch lies on the surface, drawn over the picture: where it came from, where it was torn.
#pragma once

#include <optional>
#include <vector>

#include "apps/viewer/gl_window.h"
#include "lambent/asset/asset.h"
#include "lambent/render/gl_marks.h"
#include "lambent/synthesis/patch_lay.h"

namespace lambent::viewer {

/// Which of them are shown. Not part of a state.
struct PatchOverlays {
  bool field = false;          ///< strokes along the patch's +x, thinner towards it
  bool singularities = false;  ///< of the field: warm where its index is positive, else cold
  bool seams = false;          ///< where pieces of the patch meet (render::LiveView::seams)
  bool cuts = false;           ///< borders of charts

  bool any() const { return field || singularities || seams || cuts; }
  bool operator==(const PatchOverlays&) const = default;
};

// Radiances of what is exposed by 0 EV; web/viewer/src/patch_marks.ts has the same.
inline const Rgb kFieldColor(0.1f, 0.9f, 1.0f), kSeamColor(1.2f, 0.05f, 0.7f),
    kCutColor(1.2f, 0.9f, 0.05f), kPositiveColor(1.5f, 0.12f, 0.02f),
    kNegativeColor(0.05f, 0.15f, 1.5f), kRimColor(0.01f, 0.01f, 0.01f);

/// All but the seams, which shaders find in the id map.
class PatchMarks {
 public:
  explicit PatchMarks(const asset::Asset& asset);

  /// Into the framebuffer that holds the asset, as GlMarks::draw.
  Status draw(const PatchOverlays& overlays, unsigned framebuffer, const PixelSize& size,
              const render::MarkView& view);

 private:
  std::vector<render::Mark> marksOf(const PatchOverlays& overlays) const;

  std::vector<synthesis::PatchLay> lays_;
  PatchOverlays uploaded_;
  std::optional<render::GlMarks> marks_;
};

}  // namespace lambent::viewer
