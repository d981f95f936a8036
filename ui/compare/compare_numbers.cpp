#include "ui/compare/compare_numbers.h"

#include <array>
#include <cmath>

#include "replay/plural.h"

namespace strata::ui {

std::string flip_text(const ComparedPictures& compared) {
    const auto& flip = compared.measured.flip;
    return flip ? fmt::format("FLIP {:.4g}", flip->mean) : "no FLIP: it is no light";
}

std::string flip_help(const ComparedPictures& compared) {
    const auto& flip = compared.measured.flip;
    if (!flip) return "FLIP judges what a person sees; this image is not light";
    std::string text = fmt::format(
        "mean over all pixels, 0: the same, 1: as different as can be\nhalf of all error is in pixels above {:.3g}; the largest "
        "is "
        "{:.3g}\nfor a person 0.7 m before a monitor 0.7 m wide with 3840 pixels",
        flip->median, flip->high);
    if (flip->exposures.count > 0)
        text += fmt::format("\nthe worst of {} from {:+.1f} to {:+.1f} stops", plural(flip->exposures.count, "exposure"),
                            flip->exposures.start, flip->exposures.stop);
    return text;
}

std::string rmse_text(const ComparedPictures& compared) {
    const ImageError& error = compared.measured.error;
    return fmt::format("RMSE {:.4g}, {:.3g} % of A", error.rmse, error.relative_rmse * 100);
}

std::string worst_text(const ComparedPictures& compared) {
    constexpr std::array<std::string_view, 4> letters = {", r", ", g", ", b", ", a"};
    const ImageError& error = compared.measured.error;
    const WorstPixel& at = error.worst_pixel;
    const std::string far = std::isinf(error.worst) ? fmt::format("{:.3g} against {:.3g}", at.a, at.b)
                            : error.kind == ImageError::Kind::depth
                                ? plural(static_cast<std::uint64_t>(error.worst), "float step")
                                : fmt::format("{:.4g}", error.worst);
    return fmt::format("worst {} at {} {}{}{}", far, at.x, at.y, at.layer > 0 ? fmt::format(" layer {}", at.layer) : "",
                       error.channels > 1 ? letters[at.channel] : "");
}

std::string differing_text(const ComparedPictures& compared) {
    const ImageError& error = compared.measured.error;
    return fmt::format("{} of {} texels differ", error.over_limit, error.pixels);
}

std::string oddities_text(const ComparedPictures& compared) {
    const ImageError& error = compared.measured.error;
    std::string text;
    if (error.in_a.nan + error.in_b.nan > 0) text += fmt::format("NaN: {} in A, {} in B  ", error.in_a.nan, error.in_b.nan);
    if (error.in_a.inf + error.in_b.inf > 0) text += fmt::format("infinite: {} in A, {} in B  ", error.in_a.inf, error.in_b.inf);
    if (error.disagreeing > 0) text += fmt::format("{} in one alone, in no RMSE  ", plural(error.disagreeing, "value"));
    if (compared.undecided > 0)
        text += fmt::format("{} ignored (coverage depends on rounding)", plural(compared.undecided, "texel"));
    return text;
}

double round_up(double most) {
    if (!(most > 0) || std::isinf(most)) return 1;
    const double power = std::pow(10, std::floor(std::log10(most)));
    for (const double times : {1.0, 2.0, 5.0})
        if (most <= times * power * (1 + 1e-9)) return times * power;
    return 10 * power;
}

}  // namespace strata::ui
