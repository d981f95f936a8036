#include "tests/7_inspector_window/screen.h"

#include <signal.h>

#include <cctype>
#include <chrono>
#include <cstdlib>
#include <iterator>
#include <stdexcept>
#include <thread>

#include <fmt/format.h>

#include "tests/7_tool/process.h"
#include "tests/support/file_text.h"

namespace strata {
namespace {

constexpr std::chrono::seconds patience(20);

/// The header of XWDFile.h: 32-bit words, the largest byte first.
enum XwdWord {
    header_bytes,
    version,
    width = 4,
    height = 5,
    byte_order = 7,
    pixel_bits = 11,
    line_bytes = 12,
    red_mask = 14,
    colors = 19
};

std::uint32_t word(const std::string& file, std::size_t index) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<unsigned char>(file.at(4 * index + i));
    return value;
}

}  // namespace

std::string printed_by(const std::string& line) {
    const std::string whole = fmt::format("cd {} && {{ {}; }} >printed.txt 2>printed_errors.txt", folder().string(), line);
    if (std::system(whole.c_str()) == 0) return file_text(folder() / "printed.txt");
    throw std::runtime_error(fmt::format("{}: {}", line, file_text(folder() / "printed_errors.txt")));
}

Screen::Screen(int wide, int high) {
    server_ = start("Xvfb", fmt::format("-displayfd 1 -screen 0 {}x{}x24 -nolisten tcp", wide, high), "display.txt");
    const auto is_ready = [] {
        const std::string said = file_text(folder() / "display.txt");
        return said.size() > 1 && said.ends_with('\n') && std::isdigit(static_cast<unsigned char>(said[said.size() - 2]));
    };
    const auto end = std::chrono::steady_clock::now() + patience;
    while (!is_ready() && std::chrono::steady_clock::now() < end) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    std::string said = file_text(folder() / "display.txt");
    if (!is_ready()) throw std::runtime_error(fmt::format("Xvfb does not start: {}", said));
    // Where a display is taken it says so, and tries the next.
    said.pop_back();
    setenv("DISPLAY", fmt::format(":{}", said.substr(said.rfind('\n') + 1)).c_str(), 1);
}

Screen::~Screen() {
    unsetenv("DISPLAY");
    kill(server_, SIGTERM);
    code_of(server_);
}

void Screen::hand(const std::string& line) const { printed_by("xdotool " + line); }

HostImage Screen::shot() const {
    const std::string file = printed_by("xwd -root -silent");
    const bool is_known = word(file, version) == 7 && word(file, pixel_bits) == 32 && word(file, byte_order) == 0 &&
                          word(file, red_mask) == 0xff0000;
    if (!is_known) throw std::runtime_error("xwd writes what this does not read");
    HostImage image{{.extent = {word(file, width), word(file, height), 1}, .format = Format::rgba8_unorm}, {}};
    constexpr std::size_t color_bytes = 12;
    const std::size_t begin = word(file, header_bytes) + color_bytes * word(file, colors);
    for (std::size_t y = 0; y < image.shape.extent.height; ++y)
        for (std::size_t x = 0; x < image.shape.extent.width; ++x) {
            const std::size_t at = begin + y * word(file, line_bytes) + 4 * x;  // blue, green, red
            for (const std::size_t channel : {2u, 1u, 0u}) image.texels.push_back(static_cast<std::byte>(file.at(at + channel)));
            image.texels.push_back(std::byte{255});
        }
    return image;
}

std::string Screen::clipboard() const { return printed_by("xclip -o -selection clipboard"); }

}  // namespace strata
