// The part of the panel where a sky is made.
#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "apps/viewer/panels.h"

namespace lambent::viewer {

namespace {

/// What a change of the sky waits for.
enum class Answer {
  None,
  Held,    ///< the hand still moves: what costs seconds waits until it lets go
  Wanted,  ///< to be shown
};

Answer stronger(Answer a, Answer b) {
  return std::max(a, b);
}

/// A slider. `live`: it is shown while it moves.
Answer slide(const char* name, double& value, double least, double most, const char* as,
             double step, bool live) {
  float shown = float(value);
  Answer answer = Answer::None;
  if (ImGui::SliderFloat(name, &shown, float(least), float(most), as,
                         ImGuiSliderFlags_AlwaysClamp)) {
    value = std::round(double(shown) / step) * step;
    // Decimals as a person would write them.
    value = std::round(value * 1e4) / 1e4;
    answer = live ? Answer::Wanted : Answer::Held;
  }
  return ImGui::IsItemDeactivatedAfterEdit() ? Answer::Wanted : answer;
}

Answer chooseModel(sky::SkyRequest& request) {
  constexpr const char* kModels[] = {"fast",     "exact",     "preetham",    "perez",
                                     "asrc-cie", "cie-clear", "cie-overcast"};
  const auto is = [&](const std::string& name) {
    sky::SkyRequest other;
    return sky::setKey(other, "model", name) && other.model == request.model &&
           (other.model != sky::Model::CieGeneral || other.cieType == request.cieType);
  };
  std::string now;
  for (const char* name : kModels)
    if (is(name)) now = name;
  if (now.empty()) now = fmt::format("cie:{}", request.cieType);
  Answer answer = Answer::None;
  const auto offer = [&](const std::string& name) {
    if (!ImGui::Selectable(name.c_str(), name == now) || name == now) return;
    sky::SkyRequest next = request;
    next.refine = 0, next.directNormal.reset(), next.diffuseHorizontal.reset();
    if (sky::setKey(next, "model", name)) request = next, answer = Answer::Wanted;
  };
  if (ImGui::BeginCombo("model", now.c_str())) {
    for (const char* name : kModels) offer(name);
    for (int type = 1; type <= 15; ++type) offer(fmt::format("cie:{}", type));
    ImGui::EndCombo();
  }
  return answer;
}

Answer choosePlace(sky::SkyRequest& request, bool live) {
  Answer answer = Answer::None;
  const char* here = "elsewhere";
  for (const City& city : cities())
    if (request.latitude == city.latitude && request.longitude == city.longitude) here = city.name;
  if (ImGui::BeginCombo("place", here)) {
    for (const City& city : cities())
      if (ImGui::Selectable(city.name, city.name == here)) {
        request.latitude = city.latitude, request.longitude = city.longitude;
        request.utcOffset = city.utcOffset;
        answer = Answer::Wanted;
      }
    ImGui::EndCombo();
  }
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("With its clock, without summer time");
  double latitude = request.latitude.value_or(0), longitude = request.longitude.value_or(0);
  answer = stronger(answer, slide("latitude", latitude, -90, 90, "%.2f°", 0.01, live));
  answer = stronger(answer, slide("longitude", longitude, -180, 180, "%.2f°", 0.01, live));
  request.latitude = latitude, request.longitude = longitude;
  return stronger(answer, slide("UTC offset", request.utcOffset, -12, 14, "%+.2f h", 0.25, live));
}

Answer chooseMoment(sky::SkyRequest& request, bool live) {
  Answer answer = Answer::None;
  std::string date = request.date.value_or("");
  ImGui::InputText("date", &date);
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("YYYY-MM-DD, 1600 to 2400");
  // Typed letter by letter: it is taken once it is a day.
  if (date != request.date && date.size() == 10 && sky::setKey(request, "date", date))
    answer = Answer::Wanted;
  const auto [month, day] = std::pair(std::atoi(request.date->substr(5, 2).c_str()),
                                      std::atoi(request.date->substr(8, 2).c_str()));
  constexpr int kBefore[] = {0, 31, 59, 90, 120, 151, 181, 212, 243, 273, 304, 334, 365};
  int ofYear = kBefore[std::clamp(month, 1, 12) - 1] + day;
  if (ImGui::SliderInt("day", &ofYear, 1, 365, request.date->substr(5).c_str(),
                       ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_NoInput)) {
    int m = 1;
    while (ofYear > kBefore[m]) ++m;
    request.date =
        fmt::format("{}-{:02}-{:02}", request.date->substr(0, 4), m, ofYear - kBefore[m - 1]);
    answer = stronger(answer, live ? Answer::Wanted : Answer::Held);
  }
  if (ImGui::IsItemDeactivatedAfterEdit()) answer = Answer::Wanted;
  int minute = minuteOf(request);
  const std::string clock = fmt::format("{:02}:{:02}", minute / 60, minute % 60);
  if (ImGui::SliderInt("time", &minute, 0, 24 * 60, clock.c_str(),
                       ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_NoInput)) {
    setMinute(request, minute);
    answer = stronger(answer, live ? Answer::Wanted : Answer::Held);
  }
  if (ImGui::IsItemDeactivatedAfterEdit()) answer = Answer::Wanted;
  return answer;
}

Answer chooseSun(sky::SkyRequest& request, bool live) {
  double elevation = request.sunElevation.value_or(30), bearing = request.sunAzimuth.value_or(180);
  Answer answer = slide("height##sun", elevation, -18, 90, "%.1f°", 0.1, live);
  answer = stronger(answer, slide("bearing", bearing, 0, 360, "%.1f°", 0.1, live));
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("Compass: north 0, east 90");
  request.sunElevation = elevation, request.sunAzimuth = bearing;
  return answer;
}

Answer chooseAir(sky::SkyRequest& request, bool live) {
  const auto of = [&](std::optional<double>& value, double usual, const char* name, double least,
                      double most, const char* as, double step) {
    double shown = value.value_or(usual);
    const Answer answer = slide(name, shown, least, most, as, step, live);
    if (answer != Answer::None) value = shown;
    return answer;
  };
  Answer answer = of(request.turbidity, 2.5, "haze", 1, 10,
                     request.turbidity ? "%.1f" : "as the air has it", 0.1);
  answer = stronger(answer, of(request.albedo, 0.2, "albedo", 0, 1,
                               request.albedo ? "%.2f" : "as the air has it", 0.01));
  answer = stronger(answer, slide("altitude", request.altitude, 0, 10000, "%.0f m", 10, live));
  return answer;
}

/// The air before what is seen, of the state.
void drawAirShown(Session& session) {
  std::optional<view::AirShown>& air = session.state.air;
  bool shown = air.has_value();
  if (ImGui::Checkbox("seen through the air", &shown))
    air = shown ? std::optional<view::AirShown>(std::in_place) : std::nullopt;
  if (ImGui::IsItemHovered())
    ImGui::SetTooltip("Aerial perspective: what is far away pales in this sky's air");
  if (!air) return;
  const bool sharp = session.state.sunShadow == shade::SunShadow::Sharp;
  ImGui::BeginDisabled(!sharp);
  ImGui::Checkbox("shafts of light", &air->shafts);
  ImGui::EndDisabled();
  if (ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled))
    ImGui::SetTooltip("%s", sharp ? "Shadows of the Sun in the air"
                                  : "They take the sharp shadow of the Sun (see Surface)");
  float metres = float(air->metresPerUnit);
  ImGui::PushItemWidth(-ImGui::GetFontSize() * 6.2f);
  if (ImGui::SliderFloat("one unit", &metres, 0.01f, 1e5f, "%.4g m",
                         ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp))
    // Digits as a person would write them.
    air->metresPerUnit = std::strtod(fmt::format("{:.3g}", metres).c_str(), nullptr);
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("How large the scene is");
  ImGui::PopItemWidth();
  if (!session.airRemark().empty()) ImGui::TextWrapped("%s", session.airRemark().c_str());
}

}  // namespace

void drawSky(Session& session) {
  if (!session.sky()) {
    if (ImGui::Button("Light it by the sky", {-1, 0})) session.showSky(firstSky());
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("Of any place and moment");
    if (session.state.air) drawAirShown(session);
    return;
  }
  sky::SkyRequest request = *session.sky();
  const bool simulated = request.model == sky::Model::Fast || request.model == sky::Model::Exact;
  const bool live = request.model != sky::Model::Exact;
  ImGui::PushItemWidth(-ImGui::GetFontSize() * 6.2f);
  Answer answer = chooseModel(request);
  if (ImGui::RadioButton("by moment", byMoment(request)) && !byMoment(request))
    goByMoment(request, true), answer = Answer::Wanted;
  ImGui::SameLine();
  if (ImGui::RadioButton("by the Sun", !byMoment(request)) && byMoment(request))
    goByMoment(request, false), answer = Answer::Wanted;
  if (byMoment(request)) {
    answer = stronger(answer, chooseMoment(request, live));
    answer = stronger(answer, choosePlace(request, live));
  } else {
    answer = stronger(answer, chooseSun(request, live));
  }
  answer = stronger(answer, chooseAir(request, !simulated));
  ImGui::PopItemWidth();

  if (const auto sun = sunPositionOf(request))
    ImGui::TextDisabled(
        "%s",
        fmt::format("Sun {:+.1f}° high, bearing {:.1f}°", sun->elevation, sun->bearing).c_str());
  if (!session.skyRemark().empty()) ImGui::TextWrapped("%s", session.skyRemark().c_str());
  if (const auto share = session.loader().share(); share && session.loader().seconds() > 0.3)
    ImGui::ProgressBar(float(*share), {-1, 0}, "the air of this sky");
  if (ImGui::Checkbox("exposure follows", &session.desk.exposeSky) && session.desk.exposeSky)
    session.state.exposure = exposureFor(session.stage.environment());
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("Day and night differ by a factor of 10⁸");

  drawAirShown(session);

  if (answer == Answer::Held) session.holdSky(request);
  if (answer == Answer::Wanted) session.showSky(request);
}

}  // namespace lambent::viewer
