#include "tests/7_tool/browser.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <regex>
#include <stdexcept>
#include <thread>

#include "tests/7_tool/process.h"

extern char** environ;

namespace strata {
namespace {

using nlohmann::json;
using namespace std::chrono_literals;

constexpr const char* program = "/usr/bin/chromium-headless-shell";
constexpr auto longest_wait = 10s;
// As the browser has them.
constexpr int reads_from = 3, writes_to = 4;

/// Both ends above what the browser uses.
std::array<int, 2> pipe_of_high_numbers() {
    int ends[2];
    if (::pipe(ends) != 0) throw std::runtime_error("no pipe");
    std::array<int, 2> high{};
    for (std::size_t i = 0; i < 2; ++i) {
        high[i] = ::fcntl(ends[i], F_DUPFD_CLOEXEC, 20);
        ::close(ends[i]);
    }
    return high;
}

}  // namespace

std::filesystem::path page() { return folder() / "page.html"; }

bool asks_a_network(const std::string& html) {
    return std::regex_search(html, std::regex("(src|href)=\"?https?:|url\\(https?:|@import"));
}

bool Browser::is_there() { return std::filesystem::exists(program); }

Browser::Browser(const std::filesystem::path& page) {
    const auto in = pipe_of_high_numbers(), out = pipe_of_high_numbers();
    const std::string profile = "--user-data-dir=" + (page.parent_path() / "browser").string();
    std::vector<std::string> words = {program,
                                      "--headless",
                                      "--no-sandbox",
                                      "--disable-gpu",
                                      "--disable-dev-shm-usage",
                                      "--hide-scrollbars",
                                      "--no-first-run",
                                      "--proxy-server=127.0.0.1:9",
                                      profile,
                                      "--remote-debugging-pipe",
                                      "about:blank"};
    std::vector<char*> arguments;
    arguments.reserve(words.size() + 1);
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    ::posix_spawn_file_actions_init(&actions);
    ::posix_spawn_file_actions_adddup2(&actions, in[0], reads_from);
    ::posix_spawn_file_actions_adddup2(&actions, out[1], writes_to);
    ::posix_spawn_file_actions_addopen(&actions, 2, "/dev/null", O_WRONLY, 0);
    const int problem = ::posix_spawn(&process_, program, &actions, nullptr, arguments.data(), environ);
    ::posix_spawn_file_actions_destroy(&actions);
    ::close(in[0]), ::close(out[1]);
    to_ = in[1], from_ = out[0];
    if (problem != 0) throw std::runtime_error("the browser does not start");
    const std::string target = call("Target.createTarget", {{"url", "about:blank"}})["targetId"];
    session_ = call("Target.attachToTarget", {{"targetId", target}, {"flatten", true}})["sessionId"];
    for (const char* domain : {"Page", "Runtime", "Network", "Log"}) call(std::string(domain) + ".enable");
    call("Emulation.setDeviceMetricsOverride", {{"width", 1440}, {"height", 900}, {"deviceScaleFactor", 1}, {"mobile", false}});
    call("Page.navigate", {{"url", "file://" + page.string()}});
    if (!becomes_true("document.documentElement?.dataset.ready === '1'")) throw std::runtime_error("the page is never ready");
}

Browser::~Browser() {
    ::close(to_), ::close(from_);
    ::kill(process_, SIGKILL);
    ::waitpid(process_, nullptr, 0);
}

json Browser::value(const std::string& expression) {
    const json answer = call("Runtime.evaluate", {{"expression", expression}, {"returnByValue", true}, {"awaitPromise", true}});
    if (answer.contains("exceptionDetails")) throw std::runtime_error(expression + ": " + answer["exceptionDetails"].dump());
    return answer["result"].value("value", json());
}

void Browser::press(char key) {
    const std::string text(1, key);
    for (const char* type : {"rawKeyDown", "char", "keyUp"})
        call("Input.dispatchKeyEvent", {{"type", type}, {"key", text}, {"text", std::string(type) == "char" ? text : ""}});
}

void Browser::click(double x, double y) {
    for (const char* type : {"mousePressed", "mouseReleased"})
        call("Input.dispatchMouseEvent", {{"type", type}, {"x", x}, {"y", y}, {"button", "left"}, {"clickCount", 1}});
}

bool Browser::becomes_true(const std::string& expression) {
    const auto end = std::chrono::steady_clock::now() + longest_wait;
    while (value(expression) != true) {
        if (std::chrono::steady_clock::now() > end) return false;
        std::this_thread::sleep_for(20ms);
    }
    return true;
}

json Browser::call(const std::string& method, const json& parameters) {
    json message = {{"id", ++last_}, {"method", method}, {"params", parameters}};
    if (!session_.empty()) message["sessionId"] = session_;
    const std::string text = message.dump() + '\0';
    if (::write(to_, text.data(), text.size()) != ssize_t(text.size())) throw std::runtime_error("the browser is gone");
    for (;;) {
        const json answer = read_message();
        if (answer.value("id", 0) != last_) {
            note(answer);
            continue;
        }
        if (answer.contains("error")) throw std::runtime_error(method + ": " + answer["error"].dump());
        return answer["result"];
    }
}

json Browser::read_message() {
    for (;;) {
        if (const std::size_t end = unread_.find('\0'); end != std::string::npos) {
            const json message = json::parse(unread_.substr(0, end));
            unread_.erase(0, end + 1);
            return message;
        }
        pollfd waits{.fd = from_, .events = POLLIN, .revents = 0};
        if (::poll(&waits, 1, int(std::chrono::milliseconds(longest_wait).count())) <= 0)
            throw std::runtime_error("the browser is silent");
        std::array<char, 1 << 16> bytes{};
        const ssize_t count = ::read(from_, bytes.data(), bytes.size());
        if (count <= 0) throw std::runtime_error("the browser is gone");
        unread_.append(bytes.data(), std::size_t(count));
    }
}

void Browser::note(const json& event) {
    const std::string method = event.value("method", "");
    if (method == "Runtime.exceptionThrown" || method == "Runtime.consoleAPICalled" || method == "Log.entryAdded")
        complaints_.push_back(event["params"].dump());
    if (method != "Network.requestWillBeSent") return;
    const std::string url = event["params"]["request"]["url"];
    if (!url.starts_with("file:") && !url.starts_with("data:") && !url.starts_with("about:"))
        complaints_.push_back("asks for " + url);
}

}  // namespace strata
