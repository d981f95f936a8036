// The transmittance probe for a plot: T(z) of any set of techniques over the exact steps of a pixel's fragments.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "replay/probe/probe.h"
#include "ui/replayer/live_query.h"
#include "ui/widgets/plot.h"

namespace strata::ui {

struct ProbeQuestion {
    Request request;
    glm::uvec2 pixel{0};
    std::uint32_t sample = 0;
    DepthAxis axis = DepthAxis::logarithmic;
    std::vector<std::string> variants;  ///< as ProbeOptions::techniques: none twice, at least one
    friend bool operator==(const ProbeQuestion&, const ProbeQuestion&) = default;
};

/// One technique after the other. `known` is an answer to the same question with other techniques: their curves are not made
/// again.
Result<Probe> probe_each(Session&, Progress&, const ProbeQuestion&, const std::optional<Probe>& known);

enum class ProbeQuantity { transmittance, error };
enum class ProbeChannel { mean, red, green, blue };

double in_channel(const glm::dvec3&, ProbeChannel);

/// The exact steps first, then a line per technique that has a curve; of errors the techniques alone. Every point says what T is
/// there.
std::vector<PlotSeries> series_of(const Probe&, ProbeQuantity, ProbeChannel);

/// A technique with those of its settings that are not their defaults, as ProbeOptions::techniques takes it.
std::string variant_of(const Choice&);
/// "name key=value", without the stage.
std::string short_variant(std::string_view variant);
/// Of the techniques of a probe, by place.
ImVec4 color_of_variant(std::size_t place);

}  // namespace strata::ui
