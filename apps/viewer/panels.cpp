#include "apps/viewer/panels.h"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace lambent::viewer {

namespace {

/// Azimuth of a rotation: its turn about +y, degrees.
double turnOf(const view::ViewState& state) {
  const auto& q = state.environmentRotation;
  double degrees = 2.0 * std::atan2(q[1], q[3]) * 180.0 / kPi;
  if (degrees > 180.0) degrees -= 360.0;
  if (degrees < -180.0) degrees += 360.0;
  return degrees;
}

std::string nameOfSource(const std::string& source) {
  const std::size_t plus = source.find('+');
  if (plus != source.npos) return source;
  return std::filesystem::path(source).filename().string();
}

void label(const char* text) {
  ImGui::TextDisabled("%s", text);
}

bool section(const char* title) {
  ImGui::Spacing();
  return ImGui::CollapsingHeader(title, ImGuiTreeNodeFlags_DefaultOpen);
}

/// Sliders leave room for their own label.
void leaveRoom() {
  ImGui::PushItemWidth(-ImGui::GetFontSize() * 6.2f);
}

}  // namespace

void Panels::draw(Session& session, const FrameTimes& times, const Layout& layout) {
  if (layout.panel > 0) {
    ImGui::SetNextWindowPos({float(layout.window.width - layout.panel), 0});
    ImGui::SetNextWindowSize({float(layout.panel), float(layout.window.height)});
    ImGui::Begin("Lambent", nullptr,
                 ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus);
    // Frame times stand at the foot, in sight whatever is scrolled above them.
    const float foot = 4.0f * ImGui::GetFontSize() + 2 * ImGui::GetTextLineHeightWithSpacing() +
                       ImGui::GetStyle().ItemSpacing.y;
    ImGui::BeginChild("controls", {0, -foot});
    drawFiles(session, layout.picture);
    if (section("Picture")) drawPicture(session);
    if (section("Sky")) drawSky(session);
    if (section("Light")) drawLight(session);
    if (session.stage.hasSurroundings() && section("Around it")) drawSurroundings(session);
    if (section("Surface")) drawAsset(session);
    ImGui::EndChild();
    drawTimes(session, times);
    ImGui::End();
  }
  if (session.desk.help) drawHelp(session, layout);
  drawRemarks(session, layout);
  drawQuestion(session);
  drawProblem(session, layout.scale);
}

void Panels::drawFiles(Session& session, const PixelSize& picture) {
  if (session.stage.empty()) {
    ImGui::TextUnformatted("No asset");
    label("Drop a baked .glb on the window");
  } else {
    const asset::Asset& asset = session.stage.asset();
    std::size_t vertices = 0;
    for (const scene::Mesh& mesh : asset.scene.meshes) vertices += mesh.positions.size();
    ImGui::TextUnformatted(session.stage.path().filename().string().c_str());
    ImGui::TextDisabled(
        "%s", fmt::format("{} vertices, {} bands", vertices, asset.transfer.bands).c_str());
  }
  using What = FileQuestion::What;
  const float half = (ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ItemSpacing.x) / 2;
  const auto button = [&](const char* name, const char* tip, What what, bool offered) {
    ImGui::BeginDisabled(!offered);
    if (ImGui::Button(name, {half, 0})) session.ask(what, picture);
    ImGui::EndDisabled();
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", tip);
  };
  button("Open…", "A baked asset; also a light or a saved view (O)", What::OpenAsset, true);
  ImGui::SameLine();
  button("Open a light…", "A picture of what is around, or a LIGHT.json (Shift+O)", What::OpenLight,
         true);
  button("Save picture…", "As .png (Shift+S). S saves it at once, in the current folder",
         What::SavePicture, !session.stage.empty());
  ImGui::SameLine();
  button("Save view…",
         "As .json, which lambent view and lambent render --view take (Ctrl+Shift+S).\n"
         "Ctrl+S saves it at once, in the current folder",
         What::SaveView, true);
}

void Panels::drawLight(Session& session) {
  view::ViewState& state = session.state;
  const float arrow = ImGui::GetFrameHeight();
  const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
  ImGui::BeginDisabled(session.environments.size() < 2);
  if (ImGui::ArrowButton("previous", ImGuiDir_Left)) session.nextEnvironment(-1);
  ImGui::SameLine(0, gap);
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - arrow - gap);
  if (ImGui::BeginCombo("##environment", nameOfSource(state.environment).c_str())) {
    for (const std::string& source : session.environments)
      if (ImGui::Selectable(nameOfSource(source).c_str(), source == state.environment))
        session.openEnvironment(source);
    ImGui::EndCombo();
  }
  ImGui::SameLine(0, gap);
  if (ImGui::ArrowButton("next", ImGuiDir_Right)) session.nextEnvironment(1);
  ImGui::EndDisabled();

  leaveRoom();
  float turn = float(turnOf(state));
  if (ImGui::SliderFloat("turn", &turn, -180.0f, 180.0f, "%.0f°"))
    session.turnEnvironment(Vec3d::UnitY(), (double(turn) - turnOf(state)) * kPi / 180.0);
  ImGui::Checkbox("let it go round", &session.desk.turnEnvironment);
  ImGui::SameLine();
  if (ImGui::SmallButton("reset")) state.environmentRotation = {0, 0, 0, 1};

  drawDiscs(session, sky_);

  const char* windows[] = {"auto", "none", "hann", "lanczos", "minimal"};
  const std::string kind = state.window.substr(0, state.window.find(':'));
  if (ImGui::BeginCombo("smoothing", kind.c_str())) {
    for (const char* each : windows)
      if (ImGui::Selectable(each, kind == each)) state.window = each;
    ImGui::EndCombo();
  }
  if (ImGui::IsItemHovered())
    ImGui::SetTooltip(
        "Against rings around highlights: of gloss alone (auto), or windowing of the light (W)");
  if (kind == "hann" || kind == "lanczos") {
    const std::size_t colon = state.window.find(':');
    const int bands = session.stage.empty() ? 5 : session.stage.asset().transfer.bands;
    float width =
        colon == state.window.npos ? float(bands) : std::strtof(&state.window[colon + 1], nullptr);
    if (ImGui::SliderFloat("detail", &width, 1.0f, 20.0f, "%.1f bands"))
      state.window = fmt::format("{}:{:.1f}", kind, width);
  }
  ImGui::PopItemWidth();
}

void Panels::drawAsset(Session& session) {
  view::ViewState& state = session.state;
  const Possibilities can = session.stage.possibilities();
  drawTransfer(session);

  const auto switchFor = [](const char* name, bool* value, bool offered, const char* why) {
    ImGui::BeginDisabled(!offered);
    ImGui::Checkbox(name, value);
    ImGui::EndDisabled();
    if (!offered && ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled))
      ImGui::SetTooltip("%s", why);
  };
  bool sharp = state.sunShadow == shade::SunShadow::Sharp;
  switchFor("sharp shadow of the Sun", &sharp, can.sharpSun,
            "The asset holds direct light and bounces as one (lambent bake --keep-shadowed)");
  state.sunShadow = sharp ? shade::SunShadow::Sharp : shade::SunShadow::Soft;
  const char* noMeso = "Only for assets with meso-structure (lambent synthesize)";
  switchFor("shadows on the relief", &state.macro, can.mesoStructure, noMeso);
  switchFor("relief changes with the view", &state.viewDependent, can.mesoStructure, noMeso);
  PatchOverlays& overlays = session.stage.overlays;
  label("how the patch lies (L)");
  switchFor("field", &overlays.field, can.mesoStructure, noMeso);
  ImGui::SameLine();
  switchFor("singularities", &overlays.singularities, can.mesoStructure, noMeso);
  switchFor("seams", &overlays.seams, can.mesoStructure, noMeso);
  ImGui::SameLine();
  switchFor("cuts", &overlays.cuts, can.mesoStructure, noMeso);

  ImGui::BeginDisabled(!can.glossy);
  bool own = state.lobe.has_value();
  if (ImGui::Checkbox("gloss of my own", &own))
    state.lobe = own ? std::optional(16.0) : std::nullopt;
  ImGui::EndDisabled();
  if (!can.glossy && ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled))
    ImGui::SetTooltip("This asset has no glossy transfer");
  if (state.lobe && can.glossy) {
    ImGui::SameLine();
    ImGui::SetNextItemWidth(-1);
    float exponent = float(*state.lobe);
    if (ImGui::SliderFloat("##lobe", &exponent, 1.0f, 256.0f, "%.0f", ImGuiSliderFlags_Logarithmic))
      state.lobe = double(exponent);
  }
  ImGui::Checkbox("object turns by itself", &session.desk.turnObject);
  ImGui::SameLine();
  if (ImGui::SmallButton("reset")) session.resetView();
}

void Panels::drawPicture(Session& session) {
  view::ViewState& state = session.state;
  leaveRoom();
  float exposure = float(state.exposure);
  if (ImGui::SliderFloat("exposure", &exposure, -12.0f, 30.0f, "%+.2f EV"))
    state.exposure = std::round(double(exposure) * 100.0) / 100.0;
  const bool filmic = state.tone == tone::Curve::Filmic;
  if (ImGui::BeginCombo("tone", filmic ? "filmic" : "linear")) {
    if (ImGui::Selectable("filmic", filmic)) state.tone = tone::Curve::Filmic;
    if (ImGui::Selectable("linear", !filmic)) state.tone = tone::Curve::Linear;
    ImGui::EndCombo();
  }
  ImGui::SliderInt("samples", &state.samples, 1, 256, "%d", ImGuiSliderFlags_Logarithmic);
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("Per pixel, once nothing moves");
  state.samples = std::clamp(state.samples, 1, 4096);
  ImGui::PopItemWidth();
  ImGui::Checkbox("background", &state.background);
  ImGui::SameLine();
  ImGui::Checkbox("vsync", &session.desk.vsync);
}

void Panels::drawTimes(const Session& session, const FrameTimes& times) {
  const FrameTime median = times.median();
  ImGui::TextUnformatted(fmt::format("GPU {:.2f} ms", median.gpu).c_str());
  ImGui::SameLine();
  ImGui::TextDisabled("%s", fmt::format("CPU {:.2f} ms", median.cpu).c_str());
  ImGui::SameLine();
  const char* rest = session.stage.empty() ? "" : session.stage.settled() ? "at rest" : "drawing";
  const float width = ImGui::CalcTextSize(rest).x;
  ImGui::SetCursorPosX(ImGui::GetCursorPosX() + ImGui::GetContentRegionAvail().x - width);
  ImGui::TextDisabled("%s", rest);
  drawGraph(times);
  label("?  shows the keys, Tab hides the panel");
}

}  // namespace lambent::viewer
