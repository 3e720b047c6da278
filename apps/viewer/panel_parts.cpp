// The parts of the panel that are pictures or lists of their own.
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "apps/viewer/panels.h"

namespace lambent::viewer {

void drawDiscs(Session& session, SkyMap& sky) {
  view::ViewState& state = session.state;
  sky.draw(session);
  if (session.desk.disc < 0 || session.desk.disc >= int(state.discs.size())) {
    ImGui::TextDisabled("%s", state.discs.empty() ? "Click into the sky: a disc of light"
                                                  : "Click on a disc to change it");
    return;
  }
  view::Disc& disc = state.discs[std::size_t(session.desk.disc)];
  const auto slider = [](const char* name, double& value, float least, float most, const char* as,
                         ImGuiSliderFlags flags = 0) {
    float shown = float(value);
    if (ImGui::SliderFloat(name, &shown, least, most, as, flags)) value = double(shown);
  };
  slider("direction", disc.azimuth, -180.0f, 180.0f, "%.0f°");
  slider("height", disc.elevation, -90.0f, 90.0f, "%.0f°");
  slider("size", disc.diameter, 0.25f, 180.0f, "%.2f°", ImGuiSliderFlags_Logarithmic);

  // Hue and strength apart: radiance has no upper end.
  float strength = std::max(disc.radiance.maxCoeff(), 1e-4f);
  Rgb hue = disc.radiance / strength;
  if (ImGui::SliderFloat("brightness", &strength, 0.01f, 20000.0f, "%.2f",
                         ImGuiSliderFlags_Logarithmic))
    disc.radiance = hue * strength;
  if (ImGui::ColorEdit3("colour", hue.data(),
                        ImGuiColorEditFlags_Float | ImGuiColorEditFlags_NoInputs))
    disc.radiance = hue * strength;
  ImGui::SameLine();
  const float width = ImGui::CalcTextSize("Remove").x + 2 * ImGui::GetStyle().FramePadding.x;
  ImGui::SetCursorPosX(ImGui::GetCursorPosX() + ImGui::GetContentRegionAvail().x - width);
  if (ImGui::SmallButton("Remove")) session.removeDisc(session.desk.disc);
}

void drawTransfer(Session& session) {
  using Choice = std::optional<transfer::Kind>;
  const Possibilities can = session.stage.possibilities();
  const struct {
    const char* name;
    Choice choice;
    bool offered;
    const char* what;  ///< in the papers' words
    const char* why;   ///< it is not offered
  } choices[] = {
      {"best", Choice(), true, "The most that the asset holds", ""},
      {"bare", transfer::Kind::Unshadowed, can.unshadowed, "Unshadowed transfer",
       "This asset records no transfer"},
      {"shadows", transfer::Kind::Shadowed, can.shadowed, "Shadowed transfer",
       "The asset does not hold it: lambent bake --keep-shadowed keeps it"},
      {"bounces", transfer::Kind::Interreflected, can.interreflected,
       "Interreflected transfer: shadows and bounces",
       "The asset does not hold it: lambent bake --transfer interreflected"},
  };
  int column = 0;
  for (const auto& each : choices) {
    if (column++ % 2) ImGui::SameLine(ImGui::GetWindowContentRegionMax().x * 0.5f);
    ImGui::BeginDisabled(!each.offered);
    if (ImGui::RadioButton(each.name, session.state.transfer == each.choice))
      session.state.transfer = each.choice;
    ImGui::EndDisabled();
    if (ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled))
      ImGui::SetTooltip("%s", each.offered ? each.what : each.why);
  }
}

/// What moves, and at how many points of the object its light is captured.
void drawSurroundings(Session& session) {
  ImGui::Checkbox("It moves", &session.desk.moveSurroundings);
  int samples = session.stage.lightSamples();
  ImGui::PushItemWidth(-ImGui::GetFontSize() * 6.2f);
  ImGui::SliderInt("light at", &samples, 1, 32, "%d points");
  ImGui::PopItemWidth();
  if (samples != session.stage.lightSamples())
    session.notices.check(session.stage.setLightSamples(samples));
}

void drawGraph(const FrameTimes& times) {
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const ImVec2 size(ImGui::GetContentRegionAvail().x, 4.0f * ImGui::GetFontSize());
  ImGui::Dummy(size);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 end(corner.x + size.x, corner.y + size.y);
  list.AddRectFilled(corner, end, ImGui::GetColorU32(ImGuiCol_FrameBg), 3.0f);

  // The scale steps through halves and doubles of 60 Hz, so that it does not jump with every frame.
  float slowest = 0.0f;
  for (const FrameTime& time : times.kept()) slowest = std::max({slowest, time.cpu, time.gpu});
  float top = 1000.0f / 60.0f / 8.0f;
  while (top < slowest && top < 1e5f) top *= 2.0f;
  const auto height = [&](float ms) { return end.y - size.y * std::min(ms / top, 1.0f); };
  const float step = size.x / float(FrameTimes::kKept);
  float x = end.x - step * float(times.kept().size());
  const ImU32 gpu = ImGui::GetColorU32(ImGuiCol_CheckMark, 0.85f);
  const ImU32 cpu = ImGui::GetColorU32(ImGuiCol_TextDisabled);
  const FrameTime* before = nullptr;
  for (const FrameTime& time : times.kept()) {
    list.AddRectFilled({x, height(time.gpu)}, {x + step, end.y}, gpu);
    if (before) list.AddLine({x - step, height(before->cpu)}, {x, height(time.cpu)}, cpu);
    before = &time;
    x += step;
  }
  list.AddText({corner.x + 5, corner.y + 2}, ImGui::GetColorU32(ImGuiCol_TextDisabled),
               fmt::format("{:.{}f} ms", top, top < 10.0f ? 1 : 0).c_str());
}

}  // namespace lambent::viewer
