// What a technique says about itself. Command line, inspector, report and test matrix are loops over these values.
// One function per technique folder returns one; the list in passes/CMakeLists.txt is its registration.
#pragma once

#include <array>
#include <cstring>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "capture_format/frame_features.h"
#include "capture_format/result.h"
#include "passes/capability.h"
#include "passes/frame_images.h"
#include "passes/graph/graph.h"
#include "passes/stages.h"

namespace strata {

enum class Scalar : std::uint32_t { real, integer };
enum class Scale : std::uint32_t { linear, logarithmic };

/// A parameter: it is the command line's option, the slider, the sweep range, the JSON key and the help text.
struct Param {
    std::string_view name;
    std::string_view group = {};  ///< heading of this row and those after it, where there are many
    double low = 0, high = 1, fallback = 0;
    std::string_view help;
    Scale scale = Scale::linear;
    std::span<const std::string_view> choices = {};  ///< an integer parameter's values by name, from 0
    Scalar scalar = Scalar::real;                    ///< set by param<>()
    std::size_t offset = 0;                          ///< set by param<>()
};

namespace detail {
template <typename Member>
struct MemberOf;
template <typename Struct, typename Field>
struct MemberOf<Field Struct::*> {
    using Owner = Struct;
    using Type = Field;
};
template <auto Member>
std::size_t offset_of() {
    using Owner = typename MemberOf<decltype(Member)>::Owner;
    const Owner owner{};
    return static_cast<std::size_t>(reinterpret_cast<const std::byte*>(&(owner.*Member)) -
                                    reinterpret_cast<const std::byte*>(&owner));
}
}  // namespace detail

/// Ties a row to the field it sets: a float, an int32 or a uint32.
template <auto Member>
Param param(Param row) {
    using Field = typename detail::MemberOf<decltype(Member)>::Type;
    static_assert(std::is_same_v<Field, float> || std::is_same_v<Field, std::int32_t> || std::is_same_v<Field, std::uint32_t>);
    row.scalar = std::is_same_v<Field, float> ? Scalar::real : Scalar::integer;
    row.offset = detail::offset_of<Member>();
    return row;
}

/// A number the shaders count, with the place of its uint32 in the technique's counter struct.
struct Counter {
    std::string_view name, help;
    bool is_fatal = false;   ///< above 0 the picture is wrong: the run fails
    std::size_t offset = 0;  ///< set by counter<>()
};

template <auto Member>
Counter counter(Counter row) {
    static_assert(std::is_same_v<typename detail::MemberOf<decltype(Member)>::Type, std::uint32_t>);
    row.offset = detail::offset_of<Member>();
    return row;
}

/// The row of what shaders count with passes/shaders/finished.glsl.
inline constexpr Counter unfinished_row = {
    .name = "unfinished", .help = "threads whose loops the driver ended before they were done", .is_fatal = true};

/// The name of a choice or the number: what Settings::set() reads back as this value.
std::string text_of(const Param&, double value);

/// The values of a technique's parameters, in the order of its rows.
class Settings {
public:
    Settings() = default;
    /// Every parameter at its fallback.
    explicit Settings(std::span<const Param> params);
    explicit Settings(std::vector<Param>&&) = delete;  ///< it keeps the rows where they are

    /// Fails with the range or the known names. Accepts a choice by name or number.
    Result<void> set(std::string_view name, std::string_view value);
    Result<void> set(std::string_view name, double value);
    double get(std::string_view name) const;
    /// "falloff=20": what `--set` accepts.
    std::vector<std::string> lines() const;
    std::span<const Param> params() const { return params_; }

    /// The values as the struct that C++ and GLSL share.
    template <typename Block>
    Block as() const {
        Block block{};
        write(std::as_writable_bytes(std::span(&block, 1)));
        return block;
    }

    friend bool operator==(const Settings& a, const Settings& b) { return a.values_ == b.values_; }

private:
    void write(std::span<std::byte>) const;

    std::span<const Param> params_;
    std::vector<double> values_;
};

using DeclareFunction = void (*)(Graph&, FrameImages&, const Settings&);

/// What a technique does at a stage: its own, or another one before it (preparing) or after it (finishing).
struct StageWork {
    Stage at;
    DeclareFunction declare;
};

/// What a color of a view stands for.
struct ViewColor {
    glm::vec3 color;  ///< as the view writes it, 0 to 1
    std::string meaning;
};

/// A picture of a technique's inside. `declare` makes it as an rgba32f image of the frame's extent with one layer.
struct DebugView {
    std::string_view name, help, unit;
    double low = 0, high = 1;  ///< shown from black to white, in unit
    Image (*declare)(Graph&, FrameImages&, const Settings&) = nullptr;
    std::array<std::string_view, 3> channels = {};  ///< what red, green and blue show; empty: all show one number
    std::vector<ViewColor> colors = {};             ///< of a view without a scale: what its colors stand for
    std::string_view if_zero = {};                  ///< the sentence for people where every pixel is 0: "nothing is culled"
};

struct TableColumn {
    std::string_view name, unit;
};

/// Numbers of a technique's inside, for JSON and curves. `declare` makes them as an rgba32f image one texel wide: a row of the
/// table per texel, a column per channel. A row that begins with NaN is none.
struct DebugTable {
    std::string_view name, help;
    std::vector<TableColumn> columns;  ///< 1 to 4
    std::uint32_t tile = 0;            ///< pixels a side of the tiles, counted row by row, of column "tile"; 0: it has none
    Image (*declare)(Graph&, FrameImages&, const Settings&) = nullptr;
    bool is_curves = false;  ///< the columns are curves over the first one
};

/// Variants of a technique's shader, of which every tile is shaded by one: its shading modes.
struct ShaderVariants {
    std::string_view constant;  ///< specialization constant that holds a variant's number
    std::string_view view;      ///< of the technique: the number of each pixel's variant, below 0 where nothing is shaded
    std::string_view table;     ///< of the technique: a column named as the constant, one "tiles", and whatever tells them apart
};

/// Shading modes that serve tiles by the features these need of lights and surfaces.
struct FeatureModes {
    std::string_view table;                   ///< of the technique: spectra; columns spectrum, tiles, mode, superfluous
    std::string_view constant;                ///< specialization constant that holds the features of a pipeline's mode
    std::string_view count;                   ///< parameter: how many modes there are
    std::span<const std::string_view> modes;  ///< parameters: the features of each
};

/// What some techniques can do and others cannot. A verb that needs one finds those that have it.
struct Abilities {
    std::optional<ShaderVariants> variants = {};
    std::optional<FeatureModes> feature_modes = {};
    /// Of the table that says where its slices of depth lie, in metres: from the first column to the second; empty: it has none.
    std::string_view slices_table = {};
    /// Exact up to rounding: may stand in for the stage's truth where that is too slow, once its own error is known.
    bool stands_in_for_truth = false;
    /// The common way to do the stage: reports give the others' times as multiples of its time.
    bool is_time_unit = false;
    /// Draws objects and particles in an order that the host sorts in every frame (passes/scene/object_order.h).
    bool sorts_objects = false;
};

/// The method on whole images: returns the stage's outputs.
using Model = ImageSet (*)(const StageInput&, const Settings&);

/// A frame on which the GPU may be farther from the model than on all others: without it the tolerance would hide bugs on those.
struct ToleranceException {
    std::string_view settings;  ///< as Settings::lines() join by spaces: "kind=power8"; empty: the defaults
    std::string_view scenario;
    double rmse = 0, worst = 0;
    std::string_view because;
};
/// Where a model comes from. `paper`: from the published formulas alone. `mirror`: where the method is a bit pattern (a hash, a
/// code, a list made by tests in float) the model repeats the shader's, so a mistake in both goes unseen. A mirror has property
/// tests beside it, named in its README, that derive what they expect by other arithmetic.
enum class ModelKind : std::uint32_t { paper, mirror };
std::string_view name(ModelKind);

/// How far the GPU may be from the model, relative to max(|model|, its root mean square). An empty reason fails a test.
struct Tolerance {
    double rmse = 0, worst = 0;
    std::string_view because;
    std::span<const ToleranceException> exceptions = {};
};

/// The tolerance on a scenario, at settings as in ToleranceException.
Tolerance tolerance_at(const Tolerance&, std::string_view settings, std::string_view scenario);

/// A hard case (replay/report/hard_cases.h) that a method is known not to hold, and by how much: neither more nor less.
struct KnownFailure {
    std::string_view hard_case;
    double error = 0;
    std::string_view because;
};

/// What is changed in a scenario's frame before it is measured.
struct FrameChange {
    std::string_view name = {};  ///< "64 lights"; empty: nothing is changed
    void (*change)(Frame&) = nullptr;
};

/// How many times as long one way takes as another, as a source states it: `strata bench` measures it. A way is settings of the
/// technique ("slices=64 bits=16"; none: its defaults), or another technique of its stage by name, with its settings.
struct TimeRatio {
    std::string_view name;
    std::string_view of, against;  ///< the ways; the ratio is the time of the one by that of the other
    /// Parts of the names of the technique's steps that count; none: all of them.
    std::vector<std::string_view> steps = {};
    std::optional<double> published = {};
    std::string_view source = {};  ///< of what is published: times, machine, extent
    std::string_view scenario = "particle_storm";
    std::vector<std::string_view> counters = {};  ///< that explain it, of either way
    /// In place of `steps`: stages of which every step counts, whichever technique it belongs to.
    std::vector<Stage> stages = {};
    /// What differs between the frames of the two ways.
    FrameChange of_frame = {}, against_frame = {};
};

/// What is stated of a technique, and measured.
struct Claims {
    std::vector<KnownFailure> failures = {};
    std::vector<TimeRatio> ratios = {};
};

struct Technique {
    Stage stage;
    std::string_view name;  ///< "transparency/weighted": its folder below passes/
    std::string_view title;
    std::string_view source;   ///< paper or talk
    std::string_view summary;  ///< one sentence: what it does and how it fails
    std::vector<Param> params = {};
    /// Settings beside the defaults that a report measures, too: "layers=4 tail=drop".
    std::vector<std::string_view> points = {};
    std::vector<Counter> counters = {};
    std::size_t counter_bytes = 0;  ///< sizeof its counter struct
    std::vector<DebugView> views = {};
    std::vector<DebugTable> tables = {};
    Abilities abilities = {};
    Capabilities needs = {};  ///< of the device, beyond the baseline
    /// Why the device of these images cannot do their frame at these settings, or nothing. Null: it always can.
    std::optional<std::string> (*beyond_device)(const FrameImages&, const Settings&) = nullptr;
    /// Features it cannot do: the report says "not supported" where a frame has one.
    std::vector<Feature> cannot = {};
    Claims claims = {};
    DeclareFunction declare = nullptr;
    /// Name of the stage's other truth that it approximates at these settings; empty: the stage's truth. Null: always that.
    std::string_view (*approximates)(const Settings&) = nullptr;
    std::vector<StageWork> at_other_stages = {};
    Model model = nullptr;
    ModelKind model_is = ModelKind::paper;
    Tolerance tolerance = {};
    /// What a run should say of its frame at these settings: what is recorded too finely for the method. Null: nothing.
    std::vector<std::string> (*notes)(const FrameImages&, const Settings&) = nullptr;
};

/// What a technique at its settings is judged by.
TruthRow truth_of(const Technique&, const Settings&);

}  // namespace strata
