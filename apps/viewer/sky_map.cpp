#include "apps/viewer/sky_map.h"

#include <epoxy/gl.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "lambent/math/directions.h"
#include "lambent/radiometry/luminance.h"
#include "lambent/radiometry/srgb.h"
#include "lambent/tone/tone_curve.h"
#include "lambent/view/placement.h"

namespace lambent::viewer {

namespace {

constexpr int kWidth = 160, kHeight = 80;

// As every latitude-longitude picture here: u = azimuth/2π + ½, elevation = π(½ − v).
Vec3 directionAt(double u, double v) {
  return math::directionFromAzimuthElevation(2.0 * kPi * (u - 0.5), kPi * (0.5 - v)).cast<float>();
}

ImVec2 placeOf(const view::Disc& disc, const ImVec2& corner, const ImVec2& size) {
  const double turns = disc.azimuth / 360.0 + 0.5;
  return {corner.x + float(turns - std::floor(turns)) * size.x,
          corner.y + float(0.5 - disc.elevation / 180.0) * size.y};
}

ImU32 colorOf(const view::Disc& disc) {
  const float peak = std::max(disc.radiance.maxCoeff(), 1e-6f);
  const Rgb hue = disc.radiance / peak;
  return ImGui::GetColorU32(ImVec4(radiometry::srgbEncode(hue[0]), radiometry::srgbEncode(hue[1]),
                                   radiometry::srgbEncode(hue[2]), 1.0f));
}

}  // namespace

void SkyMap::paint(const Session& session) {
  const std::pair wanted(session.state.environment, session.state.environmentRotation);
  if (painted_ == wanted) return;
  painted_ = wanted;
  const Mat3 environmentFromWorld = view::worldFromEnvironment(session.state).transpose();
  std::vector<Rgb> pixels;
  double mean = 0.0;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const Vec3 world = directionAt((x + 0.5) / kWidth, (y + 0.5) / kHeight);
      pixels.push_back(session.stage.environment().radiance(environmentFromWorld * world));
      mean += double(radiometry::luminance(pixels.back())) / (kWidth * kHeight);
    }
  // Exposed for itself: the map shows where light is, not how much.
  const float ev = mean > 0.0 ? float(std::log2(0.3 / mean)) : 0.0f;
  tone::toneMap(pixels, ev, tone::Curve::Filmic);
  std::vector<unsigned char> bytes;
  for (const Rgb& pixel : pixels) {
    for (int c = 0; c < 3; ++c)
      bytes.push_back(static_cast<unsigned char>(
          std::lround(255.0f * std::clamp(radiometry::srgbEncode(pixel[c]), 0.0f, 1.0f))));
    bytes.push_back(255);
  }
  if (!texture_.name()) {
    texture_ = render::makeTexture(GL_RGBA8, kWidth, kHeight);
    glTextureParameteri(texture_.name(), GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTextureParameteri(texture_.name(), GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  }
  glTextureSubImage2D(texture_.name(), 0, 0, 0, kWidth, kHeight, GL_RGBA, GL_UNSIGNED_BYTE,
                      bytes.data());
}

void SkyMap::draw(Session& session) {
  paint(session);
  const float width = ImGui::GetContentRegionAvail().x;
  const ImVec2 size(width, 0.5f * width), corner = ImGui::GetCursorScreenPos();
  ImGui::InvisibleButton("sky", size);
  const bool hovered = ImGui::IsItemHovered();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 end(corner.x + size.x, corner.y + size.y);
  list.PushClipRect(corner, end, true);
  list.AddImage(reinterpret_cast<ImTextureID>(std::intptr_t(texture_.name())), corner, end);
  list.AddLine({corner.x, corner.y + 0.5f * size.y}, {end.x, corner.y + 0.5f * size.y},
               IM_COL32(255, 255, 255, 40));

  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const float reach = 0.6f * ImGui::GetFontSize();
  int under = -1;
  for (int i = 0; i < int(session.state.discs.size()); ++i) {
    const view::Disc& disc = session.state.discs[std::size_t(i)];
    const ImVec2 at = placeOf(disc, corner, size);
    const float radius =
        std::clamp(float(disc.diameter / 360.0) * size.y, 0.3f * reach, 0.5f * size.y);
    const bool chosen = i == session.desk.disc;
    // Twice more, so that what hangs over the seam shows on both sides.
    for (const float shift : {-size.x, 0.0f, size.x}) {
      const ImVec2 middle(at.x + shift, at.y);
      list.AddCircleFilled(middle, radius, colorOf(disc), 32);
      list.AddCircle(middle, radius + 1.0f, IM_COL32(0, 0, 0, 200), 32, 1.0f);
      if (chosen)
        list.AddCircle(middle, radius + 3.0f, ImGui::GetColorU32(ImGuiCol_CheckMark), 32, 2.0f);
    }
    if (std::hypot(mouse.x - at.x, mouse.y - at.y) < std::max(radius, reach)) under = i;
  }
  list.PopClipRect();

  if (!ImGui::IsMouseDown(ImGuiMouseButton_Left)) dragged_ = -1;
  const double u = std::clamp(double((mouse.x - corner.x) / size.x), 0.0, 1.0);
  const double v = std::clamp(double((mouse.y - corner.y) / size.y), 0.0, 1.0);
  if (hovered && ImGui::IsMouseClicked(ImGuiMouseButton_Left)) {
    if (under < 0) {
      view::Disc disc;
      disc.azimuth = 360.0 * (u - 0.5), disc.elevation = 180.0 * (0.5 - v);
      disc.radiance = Rgb::Constant(10.0f);
      session.addDisc(disc);
      under = session.desk.disc;
    }
    session.desk.disc = dragged_ = under;
  }
  if (dragged_ >= 0 && dragged_ < int(session.state.discs.size()) &&
      ImGui::IsMouseDragging(ImGuiMouseButton_Left, 1.0f)) {
    view::Disc& disc = session.state.discs[std::size_t(dragged_)];
    disc.azimuth = 360.0 * (u - 0.5), disc.elevation = 180.0 * (0.5 - v);
  }
  if (hovered && dragged_ < 0)
    ImGui::SetTooltip(under < 0 ? "Click: a disc of light there" : "Drag to move");
}

}  // namespace lambent::viewer
