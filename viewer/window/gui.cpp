#include "viewer/window/gui.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <array>
#include <filesystem>

#include "viewer/window/window.h"

namespace relief {
namespace {

constexpr float kTextPixels = 15.0F;

/// Where Debian and others keep a font without serifs; the first that is there is taken.
constexpr std::array<const char*, 4> kFonts{"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
                                            "/usr/share/fonts/TTF/DejaVuSans.ttf",
                                            "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf",
                                            "/usr/share/fonts/truetype/noto/NotoSans-Regular.ttf"};

void load_font(float scale) {
  ImGuiIO& io = ImGui::GetIO();
  const std::array<ImWchar, 9> letters{0x20,   0x17F,  0x2010, 0x2027, 0x2190,
                                       0x2193, 0x2200, 0x22FF, 0};
  static const std::array<ImWchar, 9> kept = letters;  // read when the atlas is made
  for (const char* const font : kFonts) {
    std::error_code ignored;
    if (!std::filesystem::exists(font, ignored)) continue;
    if (io.Fonts->AddFontFromFileTTF(font, kTextPixels * scale, nullptr, kept.data()) != nullptr)
      return;
  }
  ImFontConfig config;
  config.SizePixels = 13.0F * scale;
  io.Fonts->AddFontDefault(&config);
}

void set_style(float scale) {
  ImGui::StyleColorsDark();
  ImGuiStyle& style = ImGui::GetStyle();
  style.WindowRounding = 6.0F;
  style.FrameRounding = 4.0F;
  style.GrabRounding = 4.0F;
  style.WindowBorderSize = 0.0F;
  style.WindowPadding = {10.0F, 10.0F};
  style.ItemSpacing = {8.0F, 6.0F};
  style.Colors[ImGuiCol_WindowBg] = {0.11F, 0.115F, 0.125F, 0.93F};
  style.Colors[ImGuiCol_TitleBg] =
      style.Colors[ImGuiCol_TitleBgActive] = {0.20F, 0.22F, 0.25F, 1.0F};
  style.Colors[ImGuiCol_Header] = {0.24F, 0.27F, 0.31F, 1.0F};
  style.Colors[ImGuiCol_HeaderHovered] = {0.29F, 0.33F, 0.38F, 1.0F};
  style.Colors[ImGuiCol_HeaderActive] = {0.33F, 0.38F, 0.44F, 1.0F};
  style.Colors[ImGuiCol_PopupBg] = {0.14F, 0.145F, 0.16F, 1.0F};
  style.Colors[ImGuiCol_FrameBg] = {0.20F, 0.21F, 0.23F, 1.0F};
  style.Colors[ImGuiCol_FrameBgHovered] = {0.24F, 0.26F, 0.29F, 1.0F};
  style.Colors[ImGuiCol_FrameBgActive] = {0.26F, 0.29F, 0.33F, 1.0F};
  style.Colors[ImGuiCol_Button] = {0.25F, 0.28F, 0.32F, 1.0F};
  style.Colors[ImGuiCol_ButtonHovered] = {0.31F, 0.35F, 0.41F, 1.0F};
  style.Colors[ImGuiCol_ButtonActive] = {0.36F, 0.42F, 0.50F, 1.0F};
  style.Colors[ImGuiCol_TextDisabled] = {0.58F, 0.60F, 0.63F, 1.0F};
  // The value of a slider is read through its grab.
  style.Colors[ImGuiCol_SliderGrab] = {0.27F, 0.42F, 0.62F, 1.0F};
  style.Colors[ImGuiCol_SliderGrabActive] = {0.33F, 0.52F, 0.76F, 1.0F};
  style.ScaleAllSizes(scale);
}

/// Pixels for each screen coordinate, which is what Dear ImGui measures in: 1 with X11.
float density_of(GLFWwindow* window) {
  int pixels = 0;
  int coordinates = 0;
  glfwGetFramebufferSize(window, &pixels, nullptr);
  glfwGetWindowSize(window, &coordinates, nullptr);
  return coordinates > 0 && pixels > 0
             ? static_cast<float>(pixels) / static_cast<float>(coordinates)
             : 1.0F;
}

}  // namespace

Gui::Gui(Window& window) : window_(window.handle()) {
  IMGUI_CHECKVERSION();
  ImGui::CreateContext();
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;  // what is remembered is remembered by viewer/settings
  io.ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
  const auto scale = static_cast<float>(window.scale());
  const float density = density_of(window.handle());
  load_font(scale);
  io.FontGlobalScale = 1.0F / density;
  set_style(scale / density);
  // Calls the window's own callbacks, too, which are set already.
  ImGui_ImplGlfw_InitForOpenGL(window.handle(), true);
  ImGui_ImplOpenGL3_Init("#version 450");
}

Gui::~Gui() {
  ImGui_ImplOpenGL3_Shutdown();
  ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext();
}

void Gui::note(const Event& event) {
  const auto* const key = std::get_if<KeyEvent>(&event);
  if (key != nullptr && key->pressed && !key->repeated && key->key >= 0 &&
      key->key <= GLFW_KEY_LAST)
    tapped_.push_back(key->key);
}

void Gui::begin() {
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
#if IMGUI_VERSION_NUM < 18700
  for (const int key : tapped_) ImGui::GetIO().KeysDown[key] = true;
  ImGui::NewFrame();
  for (const int key : tapped_)
    ImGui::GetIO().KeysDown[key] = glfwGetKey(window_, key) == GLFW_PRESS;
#else
  ImGui::NewFrame();
#endif
  tapped_.clear();
}

void Gui::end() {
  ImGui::Render();
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

bool Gui::wants_mouse() const {
  return ImGui::GetIO().WantCaptureMouse;
}

bool Gui::wants_keys() const {
  return ImGui::GetIO().WantTextInput;
}

}  // namespace relief
