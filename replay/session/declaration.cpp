#include "replay/session/declaration.h"

#include <algorithm>

#include "capture_format/nearest_name.h"
#include "passes/gbuffer/surfaces.h"
#include "passes/stages.h"
#include "passes/technique.h"
#include "replay/session/memo.h"

namespace strata {
namespace {

FrameImages start(const Sources& sources, Graph& graph) {
    const Frame& frame = sources.loaded.frame;
    FrameImages images{.recorded = &frame,
                       .features = &sources.loaded.features,
                       .facts = &sources.loaded.facts,
                       .extent = {frame.view.width, frame.view.height, 1},
                       .samples = frame.view.samples,
                       .makes_unused = !sources.loaded.variant.force.empty()};
    sources.scene.import_into(graph, images);
    return images;
}

/// Declares the view or table "stage/technique:name", where its technique is the chosen one, and keeps it.
Result<void> add_inside(Declaration& d, const std::string& output) {
    const std::size_t colon = output.find(':');
    const std::string_view technique = std::string_view(output).substr(0, colon);
    const std::string_view wanted = std::string_view(output).substr(colon + 1);
    for (const auto& [stage, choice] : d.choices) {
        if (choice.technique->name != technique) continue;
        std::vector<std::string_view> known;
        const auto is_wanted = [&](const auto& candidate) {
            known.push_back(candidate.name);
            return candidate.name == wanted;
        };
        const auto make = [&](const auto& candidate) {
            d.graph.enter({ScopeKind::view, stage, stage, std::string(technique), std::string(wanted)},
                          choice.technique->counter_bytes);
            const Image image = candidate.declare(d.graph, d.images, choice.settings);
            d.graph.keep(image);
            return image;
        };
        for (const DebugView& view : choice.technique->views)
            if (is_wanted(view)) return d.outputs[output] = make(view), Result<void>();
        for (const DebugTable& table : choice.technique->tables)
            if (is_wanted(table)) return d.tables[output] = {&table, make(table)}, Result<void>();
        return fail(Fault::usage, "technique.unknown_view", "{technique} has no view '{view}'{suggestion}", technique, wanted,
                    did_you_mean(wanted, known));
    }
    return fail(Fault::usage, "technique.not_chosen",
                "'{technique}' is not chosen for this frame, so it has no views; choose it with --use", technique);
}

/// Fills Declaration::outputs and keeps them.
Result<void> keep_outputs(Declaration& d, std::span<const std::string> wanted) {
    for (const std::string& output : wanted) {
        if (output.find(':') != std::string::npos) {
            if (const auto added = add_inside(d, output); !added) return added;
            continue;
        }
        const FrameImageRow* row = find_frame_image(output);
        std::vector<std::string_view> known;
        for (const FrameImageRow& candidate : frame_images()) known.push_back(candidate.name);
        if (!row)
            return fail(Fault::usage, "frame.unknown_image", "a frame has no image '{image}'{suggestion}", output,
                        did_you_mean(output, known));
        const Image image = d.images.*row->member;
        if (!image) continue;  // its stage was left out
        if (d.graph.shape(image).samples > 1)
            return fail(Fault::usage, "frame.multisampled_image",
                        "'{image}' has {samples} samples per pixel; ask for its layers ('depth_layers')", output,
                        d.images.samples);
        d.outputs[output] = image;
        d.graph.keep(image);
    }
    return {};
}

void keep_all_of(Declaration& d, const FrameImages& images) {
    for (const FrameImageRow& row : frame_images())
        if (const Image image = images.*row.member; image && d.graph.shape(image).samples == 1) d.graph.keep(image);
}

/// Also those in whose place a later pass put others.
void keep_all_images(Declaration& d) {
    for (const DeclaredPass& pass : d.frame.passes) keep_all_of(d, pass.before);
    keep_all_of(d, d.images);
}

void keep_counters(Declaration& d) {
    for (const DeclaredPass& pass : d.frame.passes) {
        const Buffer buffer = d.graph.counters(pass.scope);
        const bool is_dropped = std::ranges::count(d.graph.steps(), pass.scope, &Step::scope) == 0;
        if (!buffer || pass.technique->counters.empty() || is_dropped) continue;
        d.graph.keep(buffer);
        d.counters.push_back({pass.technique, buffer, pass.scope});
    }
}

/// After an image was written behind the frame's back, its handles become the newest version.
void refresh(const Graph& graph, FrameImages& images) {
    for (const FrameImageRow& row : frame_images())
        if (Image& image = images.*row.member; image) image.version = graph.record(image).version;
}

/// Replaces passes by what the memo kept, or has the memo keep what they make.
class Remember {
public:
    Remember(Declaration& d, const Sources& sources, std::vector<std::vector<std::string>> wanted, std::vector<bool> skip)
        : d_(&d),
          memo_(sources.memo),
          keys_(sources.loaded.key, memo_->runs(), sources.shaders),
          wanted_(std::move(wanted)),
          skip_(std::move(skip)) {}

    void operator()(const DeclaredPass& pass) {
        const std::size_t place = place_++;
        Graph& graph = d_->graph;
        const std::uint64_t key = keys_.key(graph, pass, d_->choices.at(pass.technique->stage).settings);
        d_->pass_keys.push_back(key);
        if (skip_[place]) return remember_counters(key, pass);
        if (wanted_[place].empty()) return;
        if (const KeptPass* kept = memo_->find(key, wanted_[place])) {
            graph.drop_scope(pass.scope);
            enter_memo(pass);
            for (const auto& image : kept->images) {
                Image to = graph.find_image(image.name);
                graph.copy(graph.import("kept " + image.name, image.shape, image.id), to);
            }
            d_->kept_counters.insert(d_->kept_counters.end(), kept->counters.begin(), kept->counters.end());
            d_->scopes_from_memo.insert(pass.scope);
        } else {
            std::vector<ImageRecord> records;
            for (const std::string& name : wanted_[place]) records.push_back(graph.record(graph.find_image(name)));
            const KeptPass* room = memo_->reserve(key, records);
            if (!room) return;
            enter_memo(pass);
            for (const auto& image : room->images) {
                Image to = graph.import("kept " + image.name, image.shape, image.id);
                graph.copy(graph.find_image(image.name), to);
            }
            d_->memo_writes.emplace_back(key, pass.scope);
        }
        refresh(graph, d_->images);
    }

private:
    void enter_memo(const DeclaredPass& pass) {
        Scope scope = d_->graph.scopes()[pass.scope];
        scope.kind = ScopeKind::memo;
        d_->graph.enter(std::move(scope));
    }
    /// A pass that feeds buffers is declared every time; when nobody needs it this time, its counters are those it had.
    void remember_counters(std::uint64_t key, const DeclaredPass& pass) {
        if (const KeptPass* kept = memo_->find(key, {})) {
            d_->counters_if_idle[pass.scope] = kept->counters;
        } else if (memo_->reserve(key, {})) {
            d_->memo_writes.emplace_back(key, pass.scope);
        }
    }

    Declaration* d_;
    Memo* memo_;
    PassKeys keys_;
    std::vector<std::vector<std::string>> wanted_;
    std::vector<bool> skip_;
    std::size_t place_ = 0;
};

/// Whether the pass made or changed an image of the frame, of which these are the handles after it.
bool writes(const DeclaredPass& pass, const FrameImages& after, std::string_view image) {
    const FrameImageRow* row = find_frame_image(image);
    return row && after.*row->member && pass.before.*row->member != after.*row->member;
}

/// The place of the pass that gives later ones a stage's first output, as shadow maps are filtered at a later stage; of the
/// stage's own where none does. Nothing where the frame does not need the stage.
std::optional<std::size_t> giving_pass(const Declaration& d, Stage stage) {
    std::optional<std::size_t> own;
    const std::vector<DeclaredPass>& passes = d.frame.passes;
    const auto read_later = images_read_later(d.graph, passes);
    for (std::size_t i = 0; i < passes.size(); ++i) {
        if (passes[i].technique->stage != stage) continue;
        const FrameImages& after = i + 1 < passes.size() ? passes[i + 1].before : d.images;
        if (!read_later[i].empty() && writes(passes[i], after, info(stage).outputs.front())) return i;
        if (passes[i].at == stage) own = i;
    }
    return own;
}

/// Puts images in the place of what a pass gives of its technique's stage.
class Give {
public:
    Give(Declaration& d, std::size_t place, const ImageSet& outputs) : d_(&d), passes_before_(place), outputs_(&outputs) {}

    void operator()(const DeclaredPass& pass) {
        if (passes_before_-- != 0) return;
        Graph& graph = d_->graph;
        const Scope scope = graph.scopes()[pass.scope];
        const auto& leaves = info(scope.stage).leaves;
        const auto is_left = [&](std::string_view image) { return writes(pass, d_->images, image); };
        if (std::ranges::none_of(leaves, is_left)) graph.drop_scope(pass.scope);
        graph.enter({ScopeKind::given, scope.stage, scope.at, scope.technique});
        const bool makes_nothing = std::ranges::none_of(*outputs_, [&](const auto& output) { return has_image(output.first); });
        for (const auto& [name, texels] : *outputs_) {
            const FrameImageRow* row = find_frame_image(name);
            if (!row || std::ranges::count(leaves, name) > 0) continue;
            Image& image = d_->images.*row->member;
            // Later stages do without the outputs of a baseline that declares nothing; of given ones they do not.
            if (makes_nothing) image = graph.create(name, shape_of(texels));
            if (!image) continue;
            const ImportId id{first_given_import + d_->given.size()};
            d_->given.emplace_back(id, &texels);
            const bool is_integer = strata::row(graph.shape(image).format).kind == FormatKind::integer;
            graph.compute(is_integer ? "shaders/given_numbers.comp" : "shaders/given_image.comp")
                .loads("Given", graph.import("given " + name, texels.texels.size() * sizeof(glm::vec4), id))
                .stores("image", image)
                .over({texels.width, texels.height, texels.layers});
        }
        if (outputs_->contains("surface_normal")) gbuffer::read_surfaces(d_->images);
    }

private:
    bool has_image(std::string_view name) const {
        const FrameImageRow* row = find_frame_image(name);
        return row && (d_->images.*row->member);
    }

    static Shape shape_of(const ReferenceImage& texels) {
        return {.extent = {texels.width, texels.height},
                .format = texels.channels == 1 ? Format::r32f : Format::rgba32f,
                .layers = texels.layers};
    }

    Declaration* d_;
    std::size_t passes_before_;
    const ImageSet* outputs_;
};

/// Why images cannot take the place of what the pass gives, or nothing.
std::optional<Error> cannot_give(const Declaration& d, std::size_t place, const ImageSet& outputs) {
    const DeclaredPass& pass = d.frame.passes[place];
    const StageInfo& stage = info(pass.technique->stage);
    if (feeds_buffers(d.graph, pass.scope))
        return fail(Fault::usage, "stage.buffers_are_read", "later stages read buffers of {technique}", pass.technique->name);
    const std::vector<std::string> images_read = images_read_later(d.graph, d.frame.passes)[place];
    bool are_all_left = !images_read.empty();
    for (const std::string& read : images_read) {
        const auto is_read = [&](std::string_view image_name) {
            const Image image = d.images.*find_frame_image(image_name)->member;
            return image && d.graph.record(image).name == read;
        };
        if (std::ranges::any_of(stage.leaves, is_read)) continue;
        are_all_left = false;
        const auto output = std::ranges::find_if(stage.outputs, is_read);
        const auto given = output == stage.outputs.end() ? outputs.end() : outputs.find(*output);
        if (given == outputs.end())
            return fail(Fault::usage, "stage.output_not_given", "later stages read '{image}', which is not given", read);
        const Shape& shape = d.graph.shape(d.graph.find_image(read));
        const ReferenceImage& image = given->second;
        if (row(shape.format).kind == FormatKind::depth || shape.samples > 1 || shape.extent.width != image.width ||
            shape.extent.height != image.height || shape.layers != image.layers)
            return fail(Fault::usage, "stage.output_of_another_shape", "'{image}' has another shape than the image given", read);
    }
    if (are_all_left)
        return fail(Fault::usage, "stage.only_left_outputs_are_read",
                    "later stages read '{image}', which the truth does not contain", images_read.front());
    return {};
}

/// Passes that were culled whole count what they counted when they ran.
void settle_idle_counters(Declaration& d) {
    for (const auto& [scope, counters] : d.counters_if_idle) {
        const auto in_scope = [&](const PlannedStep& planned) { return planned.step.scope == scope; };
        if (std::ranges::any_of(d.plan.steps, in_scope)) continue;
        d.kept_counters.insert(d.kept_counters.end(), counters.begin(), counters.end());
        std::erase_if(d.counters, [&](const CounterSource& source) { return source.scope == scope; });
    }
}

Result<void> fill(Declaration& d, const Request& request, const Sources& sources, Keep keep, const AfterPass& after) {
    d.images = start(sources, d.graph);
    auto frame = declare_frame(d.graph, d.images, d.choices, sources.device.capabilities, after);
    if (!frame) return frame.error();
    d.frame = *std::move(frame);
    if (const auto kept = keep_outputs(d, request.outputs); !kept) return kept.error();
    if (keep == Keep::all_images) keep_all_images(d);
    keep_counters(d);
    return {};
}

Result<void> add_plan(Declaration& d, const Sources& sources) {
    auto plan = compile(d.graph, sources.shaders);
    if (!plan) return plan.error();
    d.plan = *std::move(plan);
    return {};
}

}  // namespace

Result<Declaration> declare(const Request& request, const Sources& sources, Keep keep) {
    auto choices = choose(sources.loaded.frame, request.choices);
    if (!choices) return choices.error();

    Declaration d;
    d.choices = *choices;
    if (const auto filled = fill(d, request, sources, keep, {}); !filled) return filled.error();
    if (sources.memo) {
        // Declaring is cheap (DECISIONS.md 13): the first declaration tells what later passes read, the second one remembers it.
        std::vector<bool> skip;
        for (const DeclaredPass& pass : d.frame.passes) skip.push_back(feeds_buffers(d.graph, pass.scope));
        auto wanted = images_read_later(d.graph, d.frame.passes);
        sources.memo->begin_run();
        d = Declaration{};
        d.choices = *choices;
        Remember remember(d, sources, std::move(wanted), std::move(skip));
        if (const auto filled = fill(d, request, sources, keep, std::ref(remember)); !filled) return filled.error();
    }
    if (const auto planned = add_plan(d, sources); !planned) return planned.error();
    settle_idle_counters(d);
    return d;
}

Result<Declaration> declare_from(const Request& request, const Sources& sources, Stage stage, const ImageSet& outputs) {
    auto choices = choose(sources.loaded.frame, request.choices);
    if (!choices) return choices.error();
    Declaration d;
    d.choices = *choices;
    if (const auto filled = fill(d, request, sources, Keep::outputs, {}); !filled) return filled.error();
    const auto place = giving_pass(d, stage);
    if (!place) return fail(Fault::usage, "stage.not_needed", "the frame does not need the stage {stage}", name(stage));
    if (const auto why = cannot_give(d, *place, outputs))
        return within(*why, "no image can take the place of what {stage} gives", name(stage));
    d = Declaration{};
    d.choices = *choices;
    const auto filled = fill(d, request, sources, Keep::outputs, Give(d, *place, outputs));
    if (!filled) return filled.error();
    if (const auto planned = add_plan(d, sources); !planned) return planned.error();
    return d;
}

Result<Declaration> declare_counts(const Request& request, const Sources& sources, const Plan& whole,
                                   const std::set<const Technique*>& counting) {
    auto choices = choose(sources.loaded.frame, request.choices);
    if (!choices) return choices.error();
    Declaration d;
    d.choices = *std::move(choices);
    Request counts = request;
    counts.outputs.clear();
    if (const auto filled = fill(d, counts, sources, Keep::outputs, {}); !filled) return filled.error();
    for (const PlannedStep& planned : whole.steps)
        if (const auto* compute = std::get_if<ComputeWork>(&planned.step.work)) d.graph.keep(compute->arguments);
    for (const CounterSource& source : d.counters)
        if (counting.contains(source.technique)) d.graph.keep_counting(source.buffer);
    if (const auto planned = add_plan(d, sources); !planned) return planned.error();
    return d;
}

}  // namespace strata
