// Shift+F12: the whole window as it was drawn, and its widgets: for reports of defects, and for whoever drives it from outside.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "ui/panel.h"

namespace strata::ui {

class SaveWindow {
public:
    /// Writes strata_window.png and then .json into the current folder, numbered where there are such files.
    void start(WorkQueue& host, Picture, std::string tree);
    /// Once per frame: what was written goes to the log.
    void take_results(Services&);

private:
    std::vector<JobOf<std::filesystem::path>> jobs_;
};

}  // namespace strata::ui
