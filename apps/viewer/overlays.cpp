// What lies over the picture: remarks, help, the question for a file, problems.
#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include "apps/viewer/actions.h"
#include "apps/viewer/gestures.h"
#include "apps/viewer/panels.h"

namespace lambent::viewer {

namespace {

constexpr ImGuiWindowFlags kOverlay = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                      ImGuiWindowFlags_NoSavedSettings |
                                      ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav |
                                      ImGuiWindowFlags_AlwaysAutoResize;

void helpRow(const char* keys, const char* text) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::TextUnformatted(keys);
  ImGui::TableNextColumn();
  ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
  ImGui::TextWrapped("%s", text);
  ImGui::PopStyleColor();
}

void helpTitle(std::string_view title) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::Spacing();
  ImGui::TextColored(ImGui::GetStyleColorVec4(ImGuiCol_CheckMark), "%s",
                     std::string(title).c_str());
}

const char* askedFor(FileQuestion::What what) {
  using What = FileQuestion::What;
  switch (what) {
    case What::OpenAsset:
      return "A baked .glb, a light (.exr .hdr .png .jpg .webp, LIGHT.json) or a saved view.";
    case What::OpenLight:
      return "A picture of what is around (.exr .hdr .png .jpg .webp) or a LIGHT.json.";
    case What::SavePicture:
      return "As .png.";
    case What::SaveView:
      return "As .json, which lambent view and lambent render --view take.";
  }
  return "";
}

}  // namespace

std::string wordsOf(const Session::OwnQuestion& question) {
  const bool saves = question.question.saves();
  return fmt::format(
      "No file dialog of the desktop: {}. {}", question.why,
      saves ? "Type a name to save under." : "Type the file's name, or drop it on the window.");
}

void drawHelp(Session& session, const Layout& layout) {
  const PixelSize& window = layout.window;
  const float scale = layout.scale;
  const ImVec2 size(std::min(880.0f * scale, float(window.width) - 24 * scale),
                    std::min(660.0f * scale, float(window.height) - 24 * scale));
  ImGui::SetNextWindowSize(size);
  ImGui::SetNextWindowPos({0.5f * float(window.width), 0.5f * float(window.height)}, 0,
                          {0.5f, 0.5f});
  ImGui::SetNextWindowFocus();
  if (ImGui::Begin("Keys and mouse", &session.desk.help,
                   ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                       ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings)) {
    // Two columns where there is room for them; each a table of keys and what they do.
    const bool wide = size.x > 600 * scale;
    const auto all = actions();
    std::size_t next = 0;
    const float width = wide ? 0.5f * ImGui::GetContentRegionAvail().x : 0.0f;
    const auto column = [&](const char* id, bool mouse, std::size_t last) {
      if (!ImGui::BeginTable(id, 2, ImGuiTableFlags_None, {width, 0})) return;
      ImGui::TableSetupColumn("keys", ImGuiTableColumnFlags_WidthFixed);
      ImGui::TableSetupColumn("what", ImGuiTableColumnFlags_WidthStretch);
      if (mouse) {
        helpTitle("Mouse");
        for (const auto& [how, what] : gestureHelp()) helpRow(how, what);
      }
      for (std::string_view group; next < last; ++next) {
        if (all[next].group != group) helpTitle(group = all[next].group);
        helpRow(all[next].keys.c_str(), std::string(all[next].text).c_str());
      }
      ImGui::EndTable();
    };
    std::size_t half = 0;
    while (half < all.size() && all[half].group != "Object") ++half;
    column("left", true, wide ? half : all.size());
    if (wide) {
      ImGui::SameLine();
      column("right", false, all.size());
    }
  }
  ImGui::End();
}

void drawRemarks(const Session& session, const Layout& layout) {
  const PixelSize picture = layout.pictureUnits();
  const float scale = layout.scale;
  std::string text;
  const std::string reading = session.loader().reading();
  // A sky that follows the hand is there before anybody could read of it.
  const bool brief = session.sky() && session.loader().seconds() < 0.3;
  if (!reading.empty() && !brief)
    text = session.loader().seconds() > 1.0
               ? fmt::format("reading {} … {:.0f} s", reading, session.loader().seconds())
               : fmt::format("reading {} …", reading);
  if (const auto share = session.loader().share(); share && !text.empty())
    text += fmt::format(" {:.0f}%", 100 * *share);
  if (session.fileDialog.waiting())
    text +=
        (text.empty() ? "" : "\n") + std::string("The desktop asks for the file; Esc: never mind");
  for (const Notices::Remark& remark : session.notices.remarks())
    text += (text.empty() ? "" : "\n") + remark.text;
  if (!text.empty()) {
    ImGui::SetNextWindowPos({14 * scale, float(picture.height) - 14 * scale}, 0, {0, 1});
    ImGui::SetNextWindowBgAlpha(0.75f);
    ImGui::Begin("remarks", nullptr, kOverlay | ImGuiWindowFlags_NoInputs);
    ImGui::PushTextWrapPos(std::max(float(picture.width) - 60 * scale, 100.0f));
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
    ImGui::End();
  }
  if (session.stage.empty() && reading.empty()) {
    ImGui::SetNextWindowPos({0.5f * float(picture.width), 0.5f * float(picture.height)}, 0,
                            {0.5f, 0.5f});
    ImGui::SetNextWindowBgAlpha(0.0f);
    ImGui::Begin("nothing", nullptr, kOverlay | ImGuiWindowFlags_NoInputs);
    ImGui::TextDisabled("Drop a baked asset here, or open one (O)");
    ImGui::End();
  }
}

void Panels::drawQuestion(Session& session) {
  const auto& own = session.ownQuestion();
  const std::string title = (own ? titleOf(own->question.what) : "") + "###question";
  if (own && !asking_) {
    ImGui::OpenPopup(title.c_str());
    file_ = own->question.name;
  }
  asking_ = own.has_value();
  const ImVec2 middle = ImGui::GetMainViewport()->GetCenter();
  ImGui::SetNextWindowPos(middle, ImGuiCond_Appearing, {0.5f, 0.5f});
  ImGui::SetNextWindowSize({32 * ImGui::GetFontSize(), 0});
  if (!ImGui::BeginPopupModal(title.c_str(), nullptr,
                              ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings))
    return;
  if (!own) {
    ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
    return;
  }
  const bool saves = own->question.saves();
  ImGui::TextWrapped("%s", askedFor(own->question.what));
  ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
  ImGui::TextWrapped("%s", wordsOf(*own).c_str());
  ImGui::PopStyleColor();
  if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
  ImGui::SetNextItemWidth(-1);
  const bool entered = ImGui::InputText("##file", &file_, ImGuiInputTextFlags_EnterReturnsTrue);
  const bool pressed = ImGui::Button(saves ? "Save" : "Open");
  ImGui::SameLine();
  const bool cancelled = ImGui::Button("Cancel");
  const bool answered = (entered || pressed) && !file_.empty();
  if (answered)
    session.answerOwn(file_);
  else if (entered || pressed || cancelled)
    session.askNoMore();
  if (!session.ownQuestion()) ImGui::CloseCurrentPopup();
  ImGui::EndPopup();
}

void Panels::drawProblem(Session& session, float scale) {
  const char* title = "That did not work";
  const Error* problem = session.notices.current();
  if (problem && !complaining_) ImGui::OpenPopup(title);
  complaining_ = problem != nullptr;
  ImGui::SetNextWindowPos(ImGui::GetMainViewport()->GetCenter(), 0, {0.5f, 0.5f});
  const float widest = ImGui::GetMainViewport()->Size.x - 40 * scale;
  ImGui::SetNextWindowSize({std::min(34 * ImGui::GetFontSize(), widest), 0});
  if (!ImGui::BeginPopupModal(title, nullptr,
                              ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings))
    return;
  if (problem) {
    ImGui::TextWrapped("%s", problem->message.c_str());
    ImGui::Spacing();
    ImGui::TextDisabled("What was shown stays as it is.");
    ImGui::Spacing();
    if (ImGui::Button("OK", {6 * ImGui::GetFontSize(), 0})) session.notices.putAway();
    ImGui::SetItemDefaultFocus();
  }
  if (!session.notices.current()) ImGui::CloseCurrentPopup();
  ImGui::EndPopup();
}

}  // namespace lambent::viewer
