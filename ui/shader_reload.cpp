#include "ui/shader_reload.h"

#include <filesystem>

#include "replay/plural.h"
#include "ui/window/theme.h"

namespace strata::ui {

void ShaderReload::start(const Model& model, Replayer& replayer) {
    if (job_) return;
    replayer.await_shaders();
    job_ = replayer.start<ReloadedShaders>([folder = model.shaders, request = model.request()](Session& session, ui::Progress&) {
        return session.reload_shaders(folder, std::span(&request, 1));
    });
}

void ShaderReload::take_result(Model& model, Services& services) {
    if (!job_ || !job_->result()) return;
    const Result<ReloadedShaders> done = *job_->result();
    job_.reset();
    error_ = done ? "" : done.error().sentence;
    if (!done) {
        services.replayer.keep_shaders();
        services.log.push_back({LogLine::Kind::failed, services.seconds,
                                fmt::format("{}\nthe picture still uses the shaders before the change", error_)});
        return;
    }
    model.uses_shaders = !done->replaced.empty();
    says_ = model.uses_shaders ? fmt::format("{} of {}", plural(done->replaced.size(), "changed shader"),
                                             std::filesystem::absolute(model.shaders).lexically_normal().string())
                               : "";
    services.log.push_back(
        {LogLine::Kind::said, services.seconds,
         fmt::format("shaders: {}, {} compiled now", says_.empty() ? "all are those built in" : says_, done->compiled)});
    services.replayer.take_shaders();
}

void ShaderReload::draw(Widgets& widgets) const {
    if (job_) {
        widgets.text("shaders", "compiling shaders", &palette().warning);
    } else if (!error_.empty()) {
        widgets.text("shaders", "\xe2\x9a\xa0 shader error: the picture uses the shaders before the change", &palette().bad);
        widgets.help(error_);
    } else if (!says_.empty()) {
        widgets.text("shaders", "changed shaders", &palette().accent);
        widgets.help(says_);
    }
}

}  // namespace strata::ui
