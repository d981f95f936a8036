// Shaders compiled anew from a folder while the inspector runs.
#pragma once

#include "ui/panel.h"

namespace strata::ui {

class ShaderReload {
public:
    /// Nothing while one is under way.
    void start(const Model&, Replayer&);
    /// Once per frame: replays again once shaders are loaded; what is to be said goes to the log.
    void take_result(Model&, Services&);
    /// The badge of the top bar; nothing while the shaders built in are used and nobody changed them.
    void draw(Widgets&) const;
    bool is_busy() const { return job_ != nullptr; }

private:
    JobOf<ReloadedShaders> job_;
    std::string error_, says_;
};

}  // namespace strata::ui
