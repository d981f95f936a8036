#include "ui/save_window.h"

#include "capture_format/container/whole_file.h"
#include "replay/images/image_io.h"
#include "ui/picture/save_shown.h"

namespace strata::ui {

void SaveWindow::start(WorkQueue& host, Picture picture, std::string tree) {
    using Path = std::filesystem::path;
    jobs_.push_back(ui::start<Path>(host, [picture = std::move(picture), tree = std::move(tree)](Progress&) -> Result<Path> {
        const Path path = free_path(Path(), "strata_window");
        const Extent extent{picture.width, picture.height, 1};
        if (const auto done = write_png(path.string() + ".png", extent, picture.rgb); !done) return done.error();
        // Last: whoever waits for it finds both.
        if (const auto done = write_whole_file(path.string() + ".json", tree); !done) return done.error();
        return std::filesystem::absolute(path);
    }));
}

void SaveWindow::take_results(Services& services) {
    std::erase_if(jobs_, [&](const JobOf<std::filesystem::path>& job) {
        if (!job->result()) return false;
        const Result<std::filesystem::path>& path = *job->result();
        if (path)
            services.log.push_back(
                {LogLine::Kind::said, services.seconds, fmt::format("saved {}.png and .json", path->string())});
        else services.log.push_back({LogLine::Kind::failed, services.seconds, path.error().sentence});
        return true;
    });
}

}  // namespace strata::ui
