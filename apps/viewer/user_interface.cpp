#include "apps/viewer/user_interface.h"

#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include "apps/viewer/theme.h"

namespace lambent::viewer {

UserInterface::UserInterface(GlWindow& window) {
  ImGui::CreateContext();
  ImGui::GetIO().IniFilename = nullptr;  // nothing is left in the folder where it is started
  ImGui_ImplGlfw_InitForOpenGL(window.handle(), true);
  ImGui_ImplOpenGL3_Init("#version 450 core");
}

UserInterface::~UserInterface() {
  ImGui_ImplOpenGL3_Shutdown();
  ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext();
}

void UserInterface::begin(float scale) {
  if (scale != scale_) {
    // Another display: letters are drawn for its density.
    applyTheme(scale);
    ImGui_ImplOpenGL3_DestroyFontsTexture();
    scale_ = scale;
  }
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  ImGui::NewFrame();
}

void UserInterface::end() {
  ImGui::Render();
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

}  // namespace lambent::viewer
