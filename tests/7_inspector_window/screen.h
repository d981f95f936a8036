// A display of its own, with nobody to manage its windows, and the hands before it.
#pragma once

#include <sys/types.h>

#include <string>

#include "replay/images/host_image.h"

namespace strata {

/// Runs a line of the shell in the test's folder and gives what it printed; throws where it fails.
std::string printed_by(const std::string& line);

class Screen {
public:
    /// Programs that are started from now on have it.
    Screen(int width, int height);
    Screen(const Screen&) = delete;
    ~Screen();

    /// What xdotool does: "mousemove 10 20 click 1".
    void hand(const std::string& line) const;
    /// What the display shows, as bytes with alpha.
    HostImage shot() const;
    std::string clipboard() const;

private:
    pid_t server_ = 0;
};

}  // namespace strata
