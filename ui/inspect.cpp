#include "ui/inspect.h"

#include <cstdlib>
#include <fstream>
#include <future>
#include <sstream>

#include "capture_format/frame/frame.h"
#include "capture_format/reader.h"
#include "replay/progress_line.h"
#include "replay/standard_streams.h"
#include "ui/script/script.h"
#include "ui/window/window.h"

namespace strata::ui {
namespace {

Replayer::Open opener(const std::filesystem::path& capture, const InspectOptions& options) {
    return
        [=, device = options.device, partial = options.partial, shaders = options.shaders]() -> Result<std::unique_ptr<Session>> {
            auto session = Session::open(capture, device, partial);
            if (!session || shaders.empty()) return session;
            if (const auto loaded = (*session)->reload_shaders(shaders); !loaded) return loaded.error();
            return session;
        };
}

/// A session for the window that comes. Held by pointers, because whoever makes an inspector of it hands it to a thread.
struct OpenedCapture {
    std::filesystem::path path;
    std::shared_ptr<std::unique_ptr<Session>> session;
};

/// Opens the capture the only time, with device and shaders, so that what cannot be shown is said without a window.
Result<OpenedCapture> opened(const std::filesystem::path& path, const InspectOptions& options) {
    let_the_window_go_first();
    return within_memory<std::unique_ptr<Session>>(opener(path, options)).and_then([&](auto& session) {
        return OpenedCapture{path, std::make_shared<std::unique_ptr<Session>>(std::move(session))};
    });
}

/// What the first picture needs: its frame, its choices, a device that can do them.
Result<OpenedCapture> first_opened(const InspectOptions& options) {
    auto capture = opened(options.capture, options);
    if (!capture) return capture;
    if (const auto planned = (**capture->session).plan(options.first); !planned) return planned.error();
    for (const std::string& sentence : (**capture->session).capture()->summary().left_out) to_stderr("strata: {}\n", sentence);
    return capture;
}

/// The session that is there; another one where its device is lost.
Replayer::Open open_again(const OpenedCapture& capture, const InspectOptions& options) {
    return [session = capture.session, again = opener(capture.path, options)]() -> Result<std::unique_ptr<Session>> {
        return *session ? Result<std::unique_ptr<Session>>(std::move(*session)) : again();
    };
}

Model model_of(const std::filesystem::path& capture, const InspectOptions& options, const Request& first) {
    Model model(capture, options.device, first);
    model.uses_shaders = !options.shaders.empty();
    if (model.uses_shaders) model.shaders = options.shaders;
    model.program = "/proc/self/exe";
    return model;
}

/// What a window would show and nobody is there to read.
Result<void> report_opening(const Inspector& inspector) {
    for (const LogLine& line : inspector.log())
        if (line.kind == LogLine::Kind::warned) to_stderr("strata: {}\n", line.text);
    const Replayer& replayer = inspector.replayer();
    const Error* error = replayer.open_error() ? replayer.open_error() : replayer.error("A");
    return error ? Result<void>(*error) : Result<void>();
}

Result<void> play_script(const InspectOptions& options) {
    std::ifstream file(options.script);
    std::stringstream text;
    text << file.rdbuf();
    if (file.bad()) return fail(Fault::bad_input, "file.cannot_read", "cannot read {file}", options.script.string());
    const auto lines = parse_script(text.str(), options.script.string());
    if (!lines) return lines.error();
    const strata::Progress progress = progress_line();
    progress("opening " + options.capture.filename().string(), 0);
    const Context context;
    auto layer = ImguiLayer::headless(options.device);
    if (!layer) return layer.error();
    const auto [width, height] = options.extent.first ? options.extent : std::pair(1280u, 800u);
    Inspector inspector(**layer, model_of(options.capture, options, options.first), opener(options.capture, options), Layout());
    Player player(inspector, **layer, {static_cast<float>(width), static_cast<float>(height)});
    if (const auto opened = player.wait(); !opened) return opened;
    if (const auto opened = report_opening(inspector); !opened) return opened;
    if (const auto played = play(player, *lines, options.script.string(), std::filesystem::current_path(), progress); !played)
        return played;
    const std::vector<std::string> messages = (*layer)->take_messages();
    return messages.empty() ? Result<void>()
                            : fail(Fault::device_failed, "window.validation_message",
                                   "the validation layer says of the inspector: {message}", messages.front());
}

Result<void> show_window(const InspectOptions& options) {
    // On a thread of its own: the driver's threads have their maker's priority.
    auto capture = std::async(std::launch::async, first_opened, std::cref(options)).get();
    if (!capture) return capture.error();
    const auto file = layout_file(std::getenv("XDG_STATE_HOME"), std::getenv("HOME"));
    Layout layout = file ? read_layout(*file) : Layout();
    if (options.extent.first != 0) {
        layout.width = static_cast<int>(options.extent.first);
        layout.height = static_cast<int>(options.extent.second);
    }
    const Context context;
    auto window = Window::open(layout.width, layout.height, options.device);
    if (!window) return window.error();
    auto inspector = std::make_unique<Inspector>((*window)->layer(), model_of(options.capture, options, options.first),
                                                 open_again(*capture, options), layout);
    WorkQueue opening;
    JobOf<OpenedCapture> dropped;
    while ((*window)->begin_frame(inspector->is_settled() && !dropped ? Pace::resting : Pace::busy)) {
        (*window)->set_title(inspector->title());
        inspector->frame();
        if (const auto drawn = inspector->render(); !drawn) return drawn;
        if (const auto shown = (*window)->present(); !shown) return shown;
        if (inspector->is_closing()) break;
        if (const std::filesystem::path path = (*window)->take_dropped(); !path.empty())
            dropped = start<OpenedCapture>(opening, [path, &options](Progress&) { return opened(path, options); });
        if (!dropped || !dropped->result()) continue;
        const JobOf<OpenedCapture> done = std::exchange(dropped, nullptr);
        const Result<OpenedCapture>& next = *done->result();
        if (!next) {
            inspector->refuse(next.error());
            continue;
        }
        layout = inspector->layout();
        inspector = std::make_unique<Inspector>((*window)->layer(), model_of(next->path, options, {}), open_again(*next, options),
                                                layout);
    }
    layout = inspector->layout();
    const auto [width, height] = (*window)->size();
    remember_size(layout, width, height);
    inspector.reset();
    return file ? write_layout(*file, layout) : Result<void>();
}

}  // namespace

Result<void> inspect(const InspectOptions& options) {
    return options.script.empty() ? show_window(options) : play_script(options);
}

}  // namespace strata::ui
