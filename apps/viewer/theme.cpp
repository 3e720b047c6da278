#include "apps/viewer/theme.h"

#include <imgui.h>

#include <filesystem>

namespace lambent::viewer {

namespace {

constexpr float kFontPixels = 15.0f;

/// A face with hinted outlines, where the system has one; ImGui's own bitmap face otherwise.
constexpr const char* kFaces[] = {
    "/usr/share/fonts/truetype/noto/NotoSans-Regular.ttf",
    "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
    "/usr/share/fonts/truetype/liberation/LiberationSans-Regular.ttf",
    "/usr/share/fonts/truetype/liberation2/LiberationSans-Regular.ttf",
    "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf",
    "/usr/share/fonts/TTF/DejaVuSans.ttf",
};

// Latin, Greek, punctuation (… – ·), arrows, mathematics: what file names and labels hold.
constexpr ImWchar kGlyphs[] = {0x0020, 0x024F, 0x0370, 0x03FF, 0x2010, 0x2030,
                               0x2190, 0x21FF, 0x2200, 0x22FF, 0};

void chooseFont(float scale) {
  ImGuiIO& io = ImGui::GetIO();
  io.Fonts->Clear();
  ImFontConfig config;
  config.OversampleH = 2;
  for (const char* face : kFaces) {
    std::error_code ignored;
    if (std::filesystem::exists(face, ignored) &&
        io.Fonts->AddFontFromFileTTF(face, kFontPixels * scale, &config, kGlyphs))
      return;
  }
  config.SizePixels = 13.0f * scale;
  io.Fonts->AddFontDefault(&config);
}

ImVec4 grey(float value, float alpha = 1.0f) {
  return {value, value * 1.01f, value * 1.035f, alpha};  // a touch of blue keeps it from brown
}

}  // namespace

void applyTheme(float scale) {
  chooseFont(scale);
  ImGuiStyle style;
  ImGui::StyleColorsDark(&style);
  style.WindowPadding = {14, 12};
  style.FramePadding = {8, 3};
  style.ItemSpacing = {8, 5};
  style.ItemInnerSpacing = {7, 5};
  style.IndentSpacing = 12;
  style.ScrollbarSize = 10;
  style.GrabMinSize = 10;
  style.WindowRounding = 0;
  style.FrameRounding = style.GrabRounding = style.PopupRounding = style.ScrollbarRounding = 3;
  style.WindowBorderSize = 0;
  style.FrameBorderSize = 0;
  style.PopupBorderSize = 1;
  style.DisabledAlpha = 0.4f;
  style.ScaleAllSizes(scale);

  const ImVec4 accent(0.88f, 0.66f, 0.30f, 1.0f), dim(0.88f, 0.66f, 0.30f, 0.35f);
  ImVec4* colors = style.Colors;
  colors[ImGuiCol_Text] = grey(0.88f);
  colors[ImGuiCol_TextDisabled] = grey(0.55f);
  colors[ImGuiCol_WindowBg] = grey(0.125f);
  colors[ImGuiCol_PopupBg] = grey(0.15f, 0.98f);
  colors[ImGuiCol_Border] = grey(0.28f);
  colors[ImGuiCol_FrameBg] = grey(0.2f);
  colors[ImGuiCol_FrameBgHovered] = grey(0.25f);
  colors[ImGuiCol_FrameBgActive] = grey(0.29f);
  colors[ImGuiCol_Header] = grey(0.185f);
  colors[ImGuiCol_HeaderHovered] = grey(0.24f);
  colors[ImGuiCol_HeaderActive] = grey(0.28f);
  colors[ImGuiCol_Button] = grey(0.22f);
  colors[ImGuiCol_ButtonHovered] = grey(0.29f);
  colors[ImGuiCol_ButtonActive] = dim;
  colors[ImGuiCol_SliderGrab] = grey(0.55f);
  colors[ImGuiCol_SliderGrabActive] = accent;
  colors[ImGuiCol_CheckMark] = accent;
  colors[ImGuiCol_Separator] = grey(0.22f);
  colors[ImGuiCol_TextSelectedBg] = dim;
  colors[ImGuiCol_ScrollbarBg] = grey(0.125f);
  colors[ImGuiCol_ScrollbarGrab] = grey(0.28f);
  colors[ImGuiCol_ScrollbarGrabHovered] = grey(0.36f);
  colors[ImGuiCol_ScrollbarGrabActive] = grey(0.42f);
  colors[ImGuiCol_TitleBg] = colors[ImGuiCol_TitleBgActive] = grey(0.17f);
  colors[ImGuiCol_ModalWindowDimBg] = ImVec4(0, 0, 0, 0.45f);
  colors[ImGuiCol_NavHighlight] = accent;
  ImGui::GetStyle() = style;
}

}  // namespace lambent::viewer
