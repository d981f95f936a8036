#include "tests/7_inspector_window/drop_file.h"

#include <X11/Xlib.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <chrono>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>

#include <fmt/format.h>

#include "tests/7_inspector_window/screen.h"

namespace strata {
namespace {

constexpr std::chrono::seconds patience(20);
constexpr long version = 5;

/// As RFC 3986 has it.
std::string uri_of(const std::filesystem::path& path) {
    std::string uri = "file://";
    for (const char each : path.string()) {
        const bool is_plain =
            std::isalnum(static_cast<unsigned char>(each)) || std::string("/._-").find(each) != std::string::npos;
        uri += is_plain ? std::string(1, each) : fmt::format("%{:02X}", static_cast<unsigned char>(each));
    }
    return uri + "\r\n";
}

/// Who offers the file: a window that is never shown.
class Source {
public:
    Source() {
        if (!display_) throw std::runtime_error("there is no display to drop a file on");
        window_ = XCreateSimpleWindow(display_.get(), DefaultRootWindow(display_.get()), 0, 0, 1, 1, 0, 0, 0);
        XSetSelectionOwner(display_.get(), atom("XdndSelection"), window_, CurrentTime);
    }

    Atom atom(const char* name) const { return XInternAtom(display_.get(), name, False); }

    void tell(Window target, const char* message, const std::array<long, 4>& words) const {
        XEvent event{};
        event.xclient = {.type = ClientMessage, .window = target, .message_type = atom(message), .format = 32};
        event.xclient.data.l[0] = static_cast<long>(window_);
        std::copy(words.begin(), words.end(), event.xclient.data.l + 1);
        XSendEvent(display_.get(), target, False, NoEventMask, &event);
        XFlush(display_.get());
    }

    /// The next event of a type.
    XEvent await(int type, const char* what) const {
        XEvent event{};
        for (const auto end = std::chrono::steady_clock::now() + patience; std::chrono::steady_clock::now() < end;) {
            if (XCheckTypedEvent(display_.get(), type, &event)) return event;
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
        throw std::runtime_error(fmt::format("a dropped file has no answer: {}", what));
    }
    /// Whether the window says yes. The protocol's yes is bit 0; GLFW 3.3 says how many bytes it took.
    bool is_granted(const char* message) const {
        XEvent answer{};
        do answer = await(ClientMessage, message);
        while (answer.xclient.message_type != atom(message));
        return answer.xclient.data.l[1] != 0;
    }

    void hand_over(const XSelectionRequestEvent& asked, const std::string& text) const {
        XChangeProperty(display_.get(), asked.requestor, asked.property, asked.target, 8, PropModeReplace,
                        reinterpret_cast<const unsigned char*>(text.data()), static_cast<int>(text.size()));
        XEvent event{};
        event.xselection = {.type = SelectionNotify,
                            .requestor = asked.requestor,
                            .selection = asked.selection,
                            .target = asked.target,
                            .property = asked.property,
                            .time = asked.time};
        XSendEvent(display_.get(), asked.requestor, False, NoEventMask, &event);
        XFlush(display_.get());
    }

private:
    std::unique_ptr<Display, decltype(&XCloseDisplay)> display_{XOpenDisplay(nullptr), XCloseDisplay};
    Window window_ = 0;
};

}  // namespace

void drop_file(const std::filesystem::path& file, const char* title, int x, int y) {
    const auto target = static_cast<Window>(std::stoul(printed_by(fmt::format("xdotool search --onlyvisible --name {}", title))));
    const Source source;
    source.tell(target, "XdndEnter", {version << 24, static_cast<long>(source.atom("text/uri-list")), 0, 0});
    source.tell(target, "XdndPosition", {0, long{x} << 16 | y, CurrentTime, static_cast<long>(source.atom("XdndActionCopy"))});
    if (!source.is_granted("XdndStatus")) throw std::runtime_error("the window takes no files");
    source.tell(target, "XdndDrop", {0, CurrentTime, 0, 0});
    source.hand_over(source.await(SelectionRequest, "nobody asks for it").xselectionrequest, uri_of(file));
    if (!source.is_granted("XdndFinished")) throw std::runtime_error("the window did not take the file");
}

}  // namespace strata
