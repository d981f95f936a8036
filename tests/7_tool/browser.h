// A page in a real browser, driven over its pipe (Chrome DevTools Protocol): no port, no driver.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace strata {

/// The page of a test, which it has written: page.html in its folder.
std::filesystem::path page();

/// Whether a page would load anything from a network.
bool asks_a_network(const std::string& html);

class Browser {
public:
    /// Whether chromium-headless-shell is installed.
    static bool is_there();

    /// Opens a file, 1440 x 900 pixels, and waits until the page has set data-ready on its root. Throws where it does not.
    explicit Browser(const std::filesystem::path& page);
    ~Browser();
    Browser(const Browser&) = delete;
    Browser& operator=(const Browser&) = delete;

    /// The value of an expression in the page; of a promise, its result. Throws what the page throws.
    nlohmann::json value(const std::string& expression);
    /// Presses and releases a key, a letter or digit.
    void press(char key);
    void click(double x, double y);
    /// Waits until an expression is true, at most 10 s.
    bool becomes_true(const std::string& expression);

    /// Errors, lines of the console and requests to anything but files and data, until now.
    const std::vector<std::string>& complaints() const { return complaints_; }

private:
    nlohmann::json call(const std::string& method, const nlohmann::json& parameters = nlohmann::json::object());
    nlohmann::json read_message();
    void note(const nlohmann::json& event);

    pid_t process_ = -1;
    int to_ = -1, from_ = -1;
    std::string unread_, session_;
    int last_ = 0;
    std::vector<std::string> complaints_;
};

}  // namespace strata
