#include "capture_format/import/gltf_animation.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "capture_format/import/gltf_accessors.h"
#include "capture_format/import/gltf_check.h"

namespace strata::gltf {
namespace {

std::optional<Path> path_of(const std::string& name) {
    if (name == "translation") return Path::translation;
    if (name == "rotation") return Path::rotation;
    if (name == "scale") return Path::scale;
    if (name == "weights") return Path::weights;
    return std::nullopt;
}

std::optional<Interpolation> interpolation_of(const std::string& name) {
    if (name == "LINEAR") return Interpolation::linear;
    if (name == "STEP") return Interpolation::step;
    if (name == "CUBICSPLINE") return Interpolation::cubic;
    return std::nullopt;
}

/// glTF 2.0, 3.11: times are floats, and so are values, but for rotations and weights, which may be normalized integers.
Result<void> check_type(const Document& document, int index, const char* what, bool may_be_normalized) {
    if (index < 0 || static_cast<std::size_t>(index) >= document.accessors.size()) return {};  // read_numbers() says so
    const Accessor& accessor = document.accessors[static_cast<std::size_t>(index)];
    const bool is_normalized = accessor.normalized && accessor.component_type != uint32;
    if (accessor.component_type == float32 || (may_be_normalized && is_normalized)) return {};
    return within(not_floats(accessor.component_type, may_be_normalized ? " or normalized" : ""),
                  "{numbers} in accessor {accessor}", what, index);
}

Result<std::vector<double>> read_numbers(const Document& document, int accessor, std::uint32_t components, MemoryBudget& budget) {
    const auto values = read_floats(document, accessor, components, budget);
    if (!values) return values.error();
    if (!std::all_of(values->begin(), values->end(), [](float value) { return std::isfinite(value); })) {
        return within(not_finite(), "accessor {accessor}", accessor);
    }
    return std::vector<double>(values->begin(), values->end());
}

/// The keys of one sampler for one path.
Result<Track> read_track(const Document& document, const AnimationSampler& sampler, Track track, MemoryBudget& budget) {
    const auto interpolation = interpolation_of(sampler.interpolation);
    if (!interpolation)
        return fail(Fault::bad_input, "import.gltf.interpolation", "interpolation '{interpolation:.40}' does not exist",
                    sampler.interpolation);
    track.interpolation = *interpolation;
    const bool may_be_normalized = track.path == Path::rotation || track.path == Path::weights;
    if (const auto good = check_type(document, sampler.input, "keyframe times", false); !good) return good.error();
    if (const auto good = check_type(document, sampler.output, "values", may_be_normalized); !good) return good.error();
    auto times = read_numbers(document, sampler.input, 1, budget);
    if (!times) return times.error();
    track.times = *std::move(times);
    if (track.times.empty()) return fail(Fault::bad_input, "import.gltf.no_keys", "the sampler has no keys");
    if (!std::is_sorted(track.times.begin(), track.times.end()))
        return fail(Fault::bad_input, "import.gltf.key_order", "the times of the keys decrease");
    const std::uint32_t components = track.path == Path::weights ? 1 : track.path == Path::rotation ? 4 : 3;
    auto values = read_numbers(document, sampler.output, components, budget);
    if (!values) return values.error();
    track.values = *std::move(values);
    const std::size_t parts = track.times.size() * (track.interpolation == Interpolation::cubic ? 3 : 1);
    track.width = track.path == Path::weights ? track.values.size() / parts : components;
    if (track.width == 0 || track.values.size() != parts * track.width) {
        return fail(Fault::bad_input, "import.gltf.key_count", "{keys} keys have {numbers} numbers", track.times.size(),
                    track.values.size());
    }
    return track;
}

std::vector<double> normalized(std::vector<double> q) {
    double length = 0;
    for (const double x : q) length += x * x;
    length = std::sqrt(length);
    for (double& x : q) x = length > 0 ? x / length : x;
    return q;
}

/// glTF 2.0, appendix C.4: along the great circle, the short way.
std::vector<double> slerp(const std::vector<double>& from, std::vector<double> to, double u) {
    double cosine = 0;
    for (std::size_t i = 0; i < 4; ++i) cosine += from[i] * to[i];
    if (cosine < 0) {
        for (double& x : to) x = -x;
    }
    const double angle = std::acos(std::min(std::abs(cosine), 1.0)), sine = std::sin(angle);
    const bool straight = sine < 1e-9;  // the arc is a line but for the last bits
    const double a = straight ? 1 - u : std::sin((1 - u) * angle) / sine, b = straight ? u : std::sin(u * angle) / sine;
    std::vector<double> result(4);
    for (std::size_t i = 0; i < 4; ++i) result[i] = a * from[i] + b * to[i];
    return normalized(result);
}

/// glTF 2.0, appendix C.5.
std::vector<double> spline(const Track& track, std::size_t key, double u) {
    const double span = track.times[key + 1] - track.times[key], u2 = u * u, u3 = u2 * u;
    const std::size_t w = track.width;
    const double* here = &track.values[key * 3 * w];
    const double* next = here + 3 * w;
    std::vector<double> result(w);
    for (std::size_t i = 0; i < w; ++i) {
        const double value = here[w + i], out_tangent = here[2 * w + i], next_in_tangent = next[i], next_value = next[w + i];
        result[i] = (2 * u3 - 3 * u2 + 1) * value + span * (u3 - 2 * u2 + u) * out_tangent + (-2 * u3 + 3 * u2) * next_value +
                    span * (u3 - u2) * next_in_tangent;
    }
    return result;
}

/// The value of one key.
std::vector<double> key_value(const Track& track, std::size_t key) {
    const bool cubic = track.interpolation == Interpolation::cubic;
    const auto begin = track.values.begin() + static_cast<std::ptrdiff_t>((cubic ? key * 3 + 1 : key) * track.width);
    std::vector<double> value(begin, begin + static_cast<std::ptrdiff_t>(track.width));
    return track.path == Path::rotation ? normalized(std::move(value)) : value;
}

glm::dvec3 vector3(const std::vector<double>& v) { return {v[0], v[1], v[2]}; }

}  // namespace

std::vector<double> value_at(const Track& track, double time) {
    const auto after = std::upper_bound(track.times.begin(), track.times.end(), time);
    if (after == track.times.begin()) return key_value(track, 0);
    const auto key = static_cast<std::size_t>(after - track.times.begin()) - 1;
    if (after == track.times.end() || track.interpolation == Interpolation::step) return key_value(track, key);
    const double u = (time - track.times[key]) / (track.times[key + 1] - track.times[key]);
    if (track.interpolation == Interpolation::cubic) {
        std::vector<double> value = spline(track, key, u);
        return track.path == Path::rotation ? normalized(std::move(value)) : value;
    }
    std::vector<double> from = key_value(track, key), to = key_value(track, key + 1);
    if (track.path == Path::rotation) return slerp(from, std::move(to), u);
    for (std::size_t i = 0; i < from.size(); ++i) from[i] += u * (to[i] - from[i]);
    return from;
}

Result<int> find_animation(const Document& document, const std::string& wanted) {
    const std::vector<Animation>& all = document.animations;
    if (wanted.empty()) return all.empty() ? -1 : 0;
    const auto named = std::find_if(all.begin(), all.end(), [&](const Animation& clip) { return clip.name == wanted; });
    if (named != all.end()) return static_cast<int>(named - all.begin());
    std::size_t index = all.size();
    const auto parsed = std::from_chars(wanted.data(), wanted.data() + wanted.size(), index);
    if (parsed.ec == std::errc() && parsed.ptr == wanted.data() + wanted.size() && index < all.size())
        return static_cast<int>(index);
    std::string names = all.empty() ? "" : ":";
    for (std::size_t i = 0; i < std::min<std::size_t>(all.size(), 16); ++i) names += fmt::format(" {} '{:.60}'", i, all[i].name);
    return fail(Fault::usage, "import.gltf.animation_missing",
                "there is no animation '{animation:.60}'; the glTF has {animations}{names}", wanted, all.size(), names);
}

Result<Clip> Clip::read(const Document& document, const Animation& animation, MemoryBudget& budget) {
    Clip clip;
    for (const AnimationChannel& channel : animation.channels) {
        if (channel.node < 0) continue;  // glTF 2.0, 5.3: a target that only an extension knows
        const auto node = static_cast<std::size_t>(channel.node), sampler = static_cast<std::size_t>(channel.sampler);
        const auto path = path_of(channel.path);
        if (node >= document.nodes.size())
            return within(no_such("node", channel.node, document.nodes.size()), "animation '{animation:.60}'", animation.name);
        if (channel.sampler < 0 || sampler >= animation.samplers.size())
            return within(no_such("sampler", channel.sampler, animation.samplers.size()), "animation '{animation:.60}'",
                          animation.name);
        if (!path || (*path != Path::weights && document.nodes[node].matrix)) {
            clip.warnings_.push_back(fmt::format("animation '{:.60}': '{:.40}' of node {} stays as it is{}", animation.name,
                                                 channel.path, node, path ? ", because the node has a matrix" : ""));
            continue;
        }
        auto track = read_track(document, animation.samplers[sampler], {.node = channel.node, .path = *path}, budget);
        if (!track) return within(track.error(), "animation '{animation:.60}'", animation.name);
        clip.duration_ = std::max(clip.duration_, track->times.back());
        clip.tracks_.push_back(*std::move(track));
    }
    return clip;
}

NodePose Clip::pose(const Document& document, double time) const {
    const double within = duration_ > 0 ? std::fmod(time, duration_) : 0;
    NodePose pose = rest_pose(document);
    for (const Track& track : tracks_) {
        const std::vector<double> value = value_at(track, within);
        const auto node = static_cast<std::size_t>(track.node);
        if (track.path == Path::translation) pose.transforms[node].translation = vector3(value);
        if (track.path == Path::scale) pose.transforms[node].scale = vector3(value);
        if (track.path == Path::rotation) pose.transforms[node].rotation = {value[3], value[0], value[1], value[2]};
        if (track.path == Path::weights) pose.weights[node] = value;
    }
    return pose;
}

std::vector<bool> Clip::animated(std::size_t nodes) const {
    std::vector<bool> result(nodes);
    for (const Track& track : tracks_) result[static_cast<std::size_t>(track.node)] = true;
    return result;
}

}  // namespace strata::gltf
