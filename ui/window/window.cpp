#include "ui/window/window.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <thread>

#define GLFW_INCLUDE_VULKAN
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>

#include "replay/standard_streams.h"
#include "ui/window/imgui_layer_device.h"
#include "ui/window/imgui_layer_target.h"
#include "ui/window/input_queue.h"
#include "ui/window/window_swapchain.h"

namespace strata::ui {
namespace {

// Frames drawn after the last event, so that what it began (a hover, a list that opens) is seen to its end.
constexpr int frames_after_event = 10;
constexpr double busy_seconds = 1.0 / 60, resting_seconds = 0.5;

/// Xlib ends the process by exit(1) where the X server goes away; nothing else does while GLFW is there.
void end_without_display() {
    if (glfwGetTimerFrequency() == 0) return;  // GLFW is not there
    to_stderr("strata: the display is gone, and the window with it\n");
    std::_Exit(static_cast<int>(Fault::device_failed));
}

/// GLFW is there while one of these is.
class Glfw {
public:
    Glfw() : there_(glfwInit() == GLFW_TRUE) { std::atexit(end_without_display); }
    Glfw(const Glfw&) = delete;
    Glfw& operator=(const Glfw&) = delete;
    ~Glfw() {
        if (there_) glfwTerminate();
    }
    explicit operator bool() const { return there_; }

private:
    bool there_;
};

std::string glfw_error() {
    const char* text = nullptr;
    glfwGetError(&text);
    return text ? text : "it does not say why";
}

Error no_window() {
    return fail(Fault::device_lacks, "window.cannot_open", "no window can be opened ({reason}); --script plays without one",
                glfw_error());
}

class GlfwWindow final : public Window {
public:
    GlfwWindow(std::unique_ptr<Glfw> glfw, GLFWwindow* window) : glfw_(std::move(glfw)), window_(window, glfwDestroyWindow) {
        glfwSetWindowUserPointer(window, this);
        glfwSetDropCallback(window, [](GLFWwindow* on, int count, const char** paths) {
            if (count > 0) static_cast<GlfwWindow*>(glfwGetWindowUserPointer(on))->dropped_ = paths[0];
        });
        ImGui_ImplGlfw_InitForVulkan(window, /*install_callbacks=*/true);
        glfwSetWindowRefreshCallback(window, [](GLFWwindow* on) {
            static_cast<GlfwWindow*>(glfwGetWindowUserPointer(on))->shown_revision_ = 0;  // what it showed is lost
        });
        take_input();
    }
    ~GlfwWindow() override {
        swapchain_.reset();
        layer_.reset();  // its surface goes before the window
        ImGui_ImplGlfw_Shutdown();
    }

    Result<void> open_layer(const DeviceChoice& choice) {
        std::uint32_t count = 0;
        const char** names = glfwGetRequiredInstanceExtensions(&count);
        if (!names)
            return fail(Fault::device_lacks, "window.no_vulkan", "Vulkan cannot draw into windows here: {reason}", glfw_error());
        SurfaceSource source{{names, names + count}, [this](vk::Instance instance) { return surface(instance); }};
        auto device = LayerDevice::open(choice.validation ? Validation::on : Validation::off, source);
        if (!device) return device.error();
        auto layer = ImguiLayer::on(*std::move(device));
        if (!layer) return layer.error();
        layer_ = *std::move(layer);
        swapchain_ = std::make_unique<Swapchain>(layer_->device());
        return {};
    }

    ImguiLayer& layer() override { return *layer_; }
    void set_title(const std::string& title) override {
        if (title == title_) return;
        title_ = title;
        glfwSetWindowTitle(window_.get(), title.c_str());
    }
    std::filesystem::path take_dropped() override { return std::exchange(dropped_, {}); }
    std::pair<int, int> size() const override {
        std::pair<int, int> size;
        glfwGetWindowSize(window_.get(), &size.first, &size.second);
        return size;
    }

    bool begin_frame(Pace pace) override {
        if (after_event_ > 0) {
            std::this_thread::sleep_until(frame_began_ + std::chrono::duration<double>(busy_seconds));
            glfwPollEvents();
        } else {
            glfwWaitEventsTimeout(pace == Pace::busy ? busy_seconds : resting_seconds);
        }
        while (is_hidden() && !glfwWindowShouldClose(window_.get())) glfwWaitEventsTimeout(resting_seconds);
        frame_began_ = std::chrono::steady_clock::now();
        ImGui_ImplGlfw_NewFrame();
        input_.begin_frame(ImGui::GetIO());
        after_event_ = something_happened() ? frames_after_event : std::max(0, after_event_ - 1);
        return !glfwWindowShouldClose(window_.get());
    }

    Result<void> present() override {
        try {
            std::pair<int, int> extent;
            glfwGetFramebufferSize(window_.get(), &extent.first, &extent.second);
            const vk::Extent2D pixels(static_cast<std::uint32_t>(extent.first), static_cast<std::uint32_t>(extent.second));
            const LayerTarget& target = layer_->target();
            if (shown_revision_ == target.revision() && shown_extent_ == pixels) return {};
            if (!swapchain_->show(target, pixels)) return {};
            shown_revision_ = target.revision();
            shown_extent_ = pixels;
            return {};
        } catch (const vk::SystemError& problem) {
            return fail(Fault::device_failed, "window.cannot_draw", "the window cannot be drawn: {reason}", problem.what());
        }
    }

private:
    static InputQueue& input_of(GLFWwindow* window) { return static_cast<GlfwWindow*>(glfwGetWindowUserPointer(window))->input_; }
    /// In place of the backend's own callbacks, except those for focus.
    void take_input() {
        glfwSetKeyCallback(window_.get(), [](GLFWwindow* on, int key, int, int action, int) {
            if (key != GLFW_KEY_UNKNOWN && action != GLFW_REPEAT) input_of(on).key(key, action == GLFW_PRESS);
        });
        glfwSetMouseButtonCallback(window_.get(), [](GLFWwindow* on, int button, int action, int) {
            if (button < IM_ARRAYSIZE(ImGuiIO::MouseDown)) input_of(on).button(button, action == GLFW_PRESS);
        });
        glfwSetCursorPosCallback(window_.get(), [](GLFWwindow* on, double x, double y) {
            input_of(on).move({static_cast<float>(x), static_cast<float>(y)});
        });
        glfwSetScrollCallback(window_.get(), [](GLFWwindow* on, double x, double y) {
            input_of(on).wheel({static_cast<float>(x), static_cast<float>(y)});
        });
        glfwSetCharCallback(window_.get(), [](GLFWwindow* on, unsigned character) { input_of(on).text(character); });
    }
    vk::SurfaceKHR surface(vk::Instance instance) const {
        VkSurfaceKHR made = VK_NULL_HANDLE;
        const VkResult result = glfwCreateWindowSurface(instance, window_.get(), nullptr, &made);
        if (result != VK_SUCCESS) throw vk::InitializationFailedError("no surface for the window");
        return made;
    }
    bool is_hidden() const {
        std::pair<int, int> extent;
        glfwGetFramebufferSize(window_.get(), &extent.first, &extent.second);
        return extent.first == 0 || extent.second == 0;
    }
    /// What Dear ImGui was told since the last frame.
    bool something_happened() {
        const ImGuiIO& io = ImGui::GetIO();
        const bool held = std::ranges::any_of(io.MouseDown, [](bool down) { return down; }) ||
                          std::ranges::any_of(io.KeysDown, [](bool down) { return down; });
        const ImVec2 before = std::exchange(mouse_, io.MousePos);
        return held || io.MouseWheel != 0 || before.x != mouse_.x || before.y != mouse_.y;
    }

    std::unique_ptr<Glfw> glfw_;
    std::unique_ptr<GLFWwindow, void (*)(GLFWwindow*)> window_;
    std::unique_ptr<ImguiLayer> layer_;
    std::unique_ptr<Swapchain> swapchain_;
    InputQueue input_;
    std::filesystem::path dropped_;
    std::string title_;
    ImVec2 mouse_;
    std::uint64_t shown_revision_ = 0;
    vk::Extent2D shown_extent_;
    std::chrono::steady_clock::time_point frame_began_;
    int after_event_ = frames_after_event;
};

}  // namespace

Result<std::unique_ptr<Window>> Window::open(int width, int height, const DeviceChoice& choice) {
    auto glfw = std::make_unique<Glfw>();
    if (!*glfw) return no_window();
    glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
    GLFWwindow* made = glfwCreateWindow(width, height, "Strata", nullptr, nullptr);
    if (!made) return no_window();
    auto window = std::make_unique<GlfwWindow>(std::move(glfw), made);
    if (const auto opened = window->open_layer(choice); !opened) return opened.error();
    return std::unique_ptr<Window>(std::move(window));
}

}  // namespace strata::ui
