#include "ui/replayer/step_work.h"

#include <fmt/format.h>

#include "replay/plural.h"

namespace strata::ui {
namespace {

std::string fixed_text(const PlannedStep& planned) {
    std::string text;
    for (const Fixed& fixed : planned.step.fixed)
        text += fmt::format("{}{} = {}", text.empty() ? ", " : " and ", fixed.name,
                            std::visit([](auto value) { return fmt::format("{}", value); }, fixed.value));
    return text;
}

}  // namespace

std::string work_text(const PlannedStep& planned) {
    struct Say {
        const PlannedStep& planned;
        std::string operator()(const ComputeWork& work) const {
            if (work.arguments) return "compute, groups counted on the device";
            const Extent& groups = planned.groups;
            return fmt::format("compute, {} x {} x {} groups", groups.width, groups.height, groups.depth);
        }
        std::string operator()(const DrawWork& work) const {
            const std::string layers = planned.layers > 1 ? fmt::format(" into {} layers at once", planned.layers) : "";
            return fmt::format("draws {}{}{}", work.count ? "at most " : "", work.list.count, layers);
        }
        std::string operator()(const FullscreenWork&) const { return "every pixel"; }
        std::string operator()(const CopyWork&) const { return "copy"; }
        std::string operator()(const ClearWork&) const { return "clear"; }
    };
    return std::visit(Say{planned}, planned.step.work) + fixed_text(planned);
}

std::string short_work(const PlannedStep& planned) {
    struct Say {
        const PlannedStep& planned;
        std::string operator()(const ComputeWork& work) const {
            if (work.arguments) return "indirect";
            const Extent& groups = planned.groups;
            return plural(std::size_t{groups.width} * groups.height * groups.depth, "group");
        }
        std::string operator()(const DrawWork& work) const {
            return fmt::format("{}{}", work.count ? "\xe2\x89\xa4 " : "", plural(work.list.count, "draw"));
        }
        std::string operator()(const FullscreenWork&) const { return "every pixel"; }
        std::string operator()(const CopyWork&) const { return "copy"; }
        std::string operator()(const ClearWork&) const { return "clear"; }
    };
    return std::visit(Say{planned}, planned.step.work);
}

std::size_t draws_of(const PlannedStep& planned) {
    const auto* work = std::get_if<DrawWork>(&planned.step.work);
    return work ? work->list.count : 0;
}

}  // namespace strata::ui
