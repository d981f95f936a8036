// What a step says and what its shaders say must agree. Each failure is one sentence with the shader, the binding and the
// nearest known name.
#include <algorithm>

#include "capture_format/nearest_name.h"
#include "passes/graph/compiling.h"
#include "passes/graph/graph.h"

namespace strata {
namespace {

// Vulkan guarantees no more (maxPushConstantsSize), and lavapipe has no more.
constexpr std::size_t largest_push = 128;

bool is_argument(Access access) { return access == Access::indirect || access == Access::indexed; }

std::string_view verb(Access access) {
    switch (access) {
        case Access::sampled:
            return "samples";
        case Access::loaded:
            return "loads";
        case Access::stored:
            return "stores";
        default:
            return "updates";
    }
}

Result<const Shader*> find_shader(const ShaderLibrary& library, const std::string& name) {
    if (const Shader* shader = library.find(name)) return shader;
    const std::vector<std::string> names = library.names();
    const std::vector<std::string_view> known(names.begin(), names.end());
    return fail(Fault::usage, "shader.unknown", "there is no shader {shader}{suggestion}", name, did_you_mean(name, known));
}

/// A draw's own vertex shader, or the one for the scene's meshes; its fragment shader may be missing where only depth is written.
std::vector<std::string> shaders_of_draw(const Step& step, const ShaderLibrary& library) {
    std::vector<std::string> shaders = step.shaders;
    const auto is_color = [](const Attachment& a) {
        return a.access == Access::color_written || a.access == Access::color_blended;
    };
    const bool own_vertex = library.find(shaders.front()) != nullptr;
    const bool depth_only = own_vertex && !library.find(shaders.back()) && std::ranges::none_of(step.attachments, is_color);
    if (depth_only) shaders.pop_back();
    if (!own_vertex) shaders.front() = scene_vertex_shader(std::get<DrawWork>(step.work).list);
    return shaders;
}

Result<void> find_shaders(PlannedStep& planned, const ShaderLibrary& library) {
    if (std::holds_alternative<DrawWork>(planned.step.work)) planned.step.shaders = shaders_of_draw(planned.step, library);
    for (const std::string& name : planned.step.shaders) {
        const auto shader = find_shader(library, name);
        if (!shader) return shader.error();
        planned.shaders.push_back(*shader);
    }
    return {};
}

const Graph::Offer* find_offer(const Graph& graph, const Step& step, std::string_view name) {
    const Graph::Offer* found = nullptr;
    for (const Graph::Offer& offer : graph.offers()) {
        if (offer.name != name || (offer.scope && *offer.scope != step.scope)) continue;
        if (!found || offer.scope || !found->scope) found = &offer;  // the scope's own wins, then the latest
    }
    return found;
}

Access access_of(const ShaderBinding& binding) {
    if (!binding.written) return Access::loaded;
    return binding.read ? Access::updated : Access::stored;
}

/// The offer of a block's name under the step's prefix, else of the name alone.
const Graph::Offer* offer_to(const Graph& graph, const Step& step, std::string_view name) {
    if (!step.offers_first.empty())
        if (const Graph::Offer* offer = find_offer(graph, step, fmt::format("{}{}", step.offers_first, name))) return offer;
    return find_offer(graph, step, name);
}

/// What the step or an offer gives the shader for this name.
Result<Binding> given(const Graph& graph, const Step& step, const Shader& shader, const ShaderBinding& wanted) {
    for (const Binding& binding : step.bindings)
        if (!is_argument(binding.access) && binding.name == wanted.name) return binding;
    const bool is_buffer = wanted.kind == BindingKind::storage_buffer || wanted.kind == BindingKind::uniform_buffer;
    const Graph::Offer* offer = is_buffer ? offer_to(graph, step, wanted.name) : nullptr;
    if (offer) return Binding{.name = wanted.name, .access = access_of(wanted), .buffer = offer->buffer};
    return fail(Fault::usage, "graph.not_bound", "{shader} declares '{binding}', and the step binds nothing to it", shader.name,
                wanted.name);
}

Result<void> check_kind(const Shader& shader, const ShaderBinding& wanted, const Binding& binding) {
    const bool wants_buffer = wanted.kind == BindingKind::storage_buffer || wanted.kind == BindingKind::uniform_buffer;
    const auto mismatch = [&](std::string_view is) {
        return fail(Fault::usage, "graph.binding_kind", "{shader}: '{binding}' is {declared}, but the step {access} {bound}",
                    shader.name, wanted.name, is, verb(binding.access), binding.buffer ? "a buffer" : "an image");
    };
    if (wants_buffer && binding.image) return mismatch("a buffer");
    if (wants_buffer && !binding.buffer)
        return fail(Fault::usage, "graph.no_buffer_bound", "{shader}: '{binding}' is bound to no buffer", shader.name,
                    wanted.name);
    if (!wants_buffer && binding.buffer) return mismatch("an image");
    if (wanted.kind == BindingKind::sampled_image && binding.access != Access::sampled) return mismatch("a sampler");
    if (wanted.kind == BindingKind::storage_image && binding.access == Access::sampled) return mismatch("a storage image");
    return {};
}

/// `updates` of what a shader only writes is fine: it says that texels the shader leaves alone stay.
Result<void> check_direction(const Shader& shader, const ShaderBinding& wanted, const Binding& binding) {
    const std::string_view does = verb(binding.access);
    if (!writes(binding.access) && wanted.written)
        return fail(Fault::usage, "graph.not_readonly", "{shader}: '{binding}' is not readonly, but the step only {access} it",
                    shader.name, wanted.name, does);
    if (writes(binding.access) && !wanted.written)
        return fail(Fault::usage, "graph.readonly_written", "{shader}: '{binding}' is readonly, but the step {access} it",
                    shader.name, wanted.name, does);
    if (binding.access == Access::stored && wanted.read)
        return fail(Fault::usage, "graph.not_writeonly", "{shader}: '{binding}' is not writeonly, but the step only stores it",
                    shader.name, wanted.name);
    const bool nothing = !binding.image && !binding.buffer;
    if (nothing && writes(binding.access))
        return fail(Fault::usage, "graph.no_image_bound", "{shader}: the step {access} '{binding}', but binds no image to it",
                    shader.name, does, wanted.name);
    return {};
}

Result<void> check_part(const Shape& shape, const Part& part, const std::string& image, const std::string& used_by) {
    if (part.mip && *part.mip >= shape.mips)
        return fail(Fault::usage, "graph.no_mip", "{user}: image '{image}' has no mip {mip}", used_by, image, *part.mip);
    if (part.layer && *part.layer >= shape.layers)
        return fail(Fault::usage, "graph.no_layer", "{user}: image '{image}' has no layer {layer}", used_by, image, *part.layer);
    return {};
}

/// The image's shape and format against the variable's type.
Result<void> check_image(const Graph& graph, const Shader& shader, const ShaderBinding& wanted, const Binding& binding) {
    const Shape& shape = graph.shape(binding.image);
    const std::string& name = graph.record(binding.image).name;
    const auto mismatch = [&](std::string_view is, std::string_view has) {
        return fail(Fault::usage, "graph.image_type", "{shader}: '{binding}' is {declared}, but image '{image}' {found}",
                    shader.name, wanted.name, is, name, has);
    };
    const FormatRow& format = row(shape.format);
    if ((wanted.dimension == ImageDimension::three) != (shape.extent.depth > 1))
        return shape.extent.depth > 1 ? mismatch("2D", "is 3D") : mismatch("3D", "is 2D");
    if (wanted.multisampled != (shape.samples > 1))
        return wanted.multisampled ? mismatch("multisampled", "has one sample")
                                   : mismatch("not multisampled", "has several samples");
    if (!wanted.arrayed && shape.layers > 1 && !binding.part.layer) return mismatch("not an array", "has several layers");
    if (wanted.integer != (format.kind == FormatKind::integer))
        return mismatch(wanted.integer ? "integer" : "not integer", fmt::format("is {}", format.name));
    if (wanted.format && *wanted.format != shape.format)
        return mismatch(row(*wanted.format).name, fmt::format("is {}", format.name));
    const bool storage = wanted.kind == BindingKind::storage_image;
    if (storage && format.kind == FormatKind::depth) return mismatch("a storage image", "is a depth image");
    if (storage && shape.mips > 1 && !binding.part.mip) return mismatch("a storage image", "has several mips and none is named");
    return check_part(shape, binding.part, name, shader.name);
}

PlannedBinding planned_binding(const Binding& binding, const ShaderBinding& wanted) {
    return {.binding = binding,
            .set = wanted.set,
            .slot = wanted.binding,
            .kind = wanted.kind,
            .dimension = wanted.dimension,
            .arrayed = wanted.arrayed,
            .multisampled = wanted.multisampled,
            .integer = wanted.integer,
            .format = wanted.format};
}

/// Vertex and fragment shader may share a name: what both do to it is done to it.
ShaderBinding in_all_shaders(const std::vector<const Shader*>& shaders, ShaderBinding binding) {
    for (const Shader* shader : shaders) {
        for (const ShaderBinding& other : shader->bindings) {
            if (other.name != binding.name) continue;
            binding.read |= other.read;
            binding.written |= other.written;
        }
    }
    return binding;
}

/// ... and then it must be the same place, which nothing else has.
Result<void> add_once(std::vector<PlannedBinding>& all, const PlannedBinding& planned, const Shader& shader) {
    const std::string& name = planned.binding.name;
    const auto known = std::ranges::find(all, name, [](const PlannedBinding& p) { return std::string_view(p.binding.name); });
    const auto neighbor = std::ranges::find_if(
        all, [&](const PlannedBinding& p) { return p.set == planned.set && p.slot == planned.slot && p.binding.name != name; });
    if (neighbor != all.end())
        return fail(Fault::usage, "graph.binding_place_taken",
                    "{shader} declares '{binding}' where the step's other shader declares '{other}': set {set}, binding {slot}",
                    shader.name, name, neighbor->binding.name, planned.set, planned.slot);
    if (known == all.end()) {
        all.push_back(planned);
    } else if (known->set != planned.set || known->slot != planned.slot || known->kind != planned.kind) {
        return fail(Fault::usage, "graph.binding_in_two_places",
                    "{shader} declares '{binding}' with another set, binding or kind than the step's other shader", shader.name,
                    name);
    }
    return {};
}

Result<void> place_bindings(const Graph& graph, PlannedStep& planned) {
    for (const Shader* shader : planned.shaders) {
        for (const ShaderBinding& declared : shader->bindings) {
            const ShaderBinding wanted = in_all_shaders(planned.shaders, declared);
            const auto binding = given(graph, planned.step, *shader, wanted);
            if (!binding) return binding.error();
            if (auto kind = check_kind(*shader, wanted, *binding); !kind) return kind;
            if (auto direction = check_direction(*shader, wanted, *binding); !direction) return direction;
            if (binding->image) {
                if (auto image = check_image(graph, *shader, wanted, *binding); !image) return image;
            }
            if (auto added = add_once(planned.bindings, planned_binding(*binding, wanted), *shader); !added) return added;
        }
    }
    return {};
}

/// Names the step binds or fixes that no shader of it has.
Result<void> check_unknown_names(const PlannedStep& planned) {
    std::vector<std::string_view> bindings, constants;
    for (const Shader* shader : planned.shaders) {
        for (const ShaderBinding& binding : shader->bindings) bindings.push_back(binding.name);
        for (const ShaderConstant& constant : shader->constants) constants.push_back(constant.name);
    }
    for (const Binding& binding : planned.step.bindings) {
        if (is_argument(binding.access) || std::ranges::find(bindings, binding.name) != bindings.end()) continue;
        return fail(Fault::usage, "graph.unknown_binding", "{shader} uses no '{binding}'{suggestion}",
                    planned.shaders.back()->name, binding.name, did_you_mean(binding.name, bindings));
    }
    for (const Fixed& fixed : planned.step.fixed) {
        if (std::ranges::find(constants, fixed.name) != constants.end()) continue;
        return fail(Fault::usage, "graph.unknown_constant", "{shader} has no specialization constant '{constant}'{suggestion}",
                    planned.shaders.back()->name, fixed.name, did_you_mean(fixed.name, constants));
    }
    return {};
}

Result<void> check_push(const PlannedStep& planned) {
    const auto largest = std::ranges::max_element(planned.shaders, {}, [](const Shader* shader) { return shader->push_bytes; });
    const std::uint32_t wanted = largest == planned.shaders.end() ? 0 : (*largest)->push_bytes;
    if (wanted > largest_push)
        return fail(Fault::usage, "graph.push_too_large",
                    "{shader} declares {bytes} bytes of push constants; devices guarantee {limit}", (*largest)->name, wanted,
                    largest_push);
    if (planned.step.push.size() != wanted)
        return fail(Fault::usage, "graph.push_size",
                    "{step} declares {declared} bytes of push constants, but the step pushes {bytes}", planned.step.name, wanted,
                    planned.step.push.size());
    return {};
}

Extent extent_of(const Shape& shape, const Part& part) {
    const std::uint32_t mip = part.mip.value_or(0);
    return {std::max(1u, shape.extent.width >> mip), std::max(1u, shape.extent.height >> mip), 1};
}

Result<void> check_attachment(const Graph& graph, const Step& step, const Attachment& attachment) {
    if (!attachment.image) return fail(Fault::usage, "graph.no_attachment_image", "{step} draws into no image", step.name);
    const Shape& shape = graph.shape(attachment.image);
    const Attachment& first = step.attachments.front();
    const std::string& name = graph.record(attachment.image).name;
    const bool is_depth = attachment.access == Access::depth_tested || attachment.access == Access::depth_written;
    if (is_depth != (row(shape.format).kind == FormatKind::depth))
        return fail(Fault::usage, "graph.attachment_format", "{step} draws {aspect} into '{image}', which is {format}", step.name,
                    is_depth ? "depth" : "color", name, row(shape.format).name);
    if (shape.samples != graph.shape(first.image).samples)
        return fail(Fault::usage, "graph.attachment_samples",
                    "{step} draws into '{image}' with {samples} samples and into '{other}' with {other_samples}", step.name,
                    graph.record(first.image).name, graph.shape(first.image).samples, name, shape.samples);
    if (extent_of(shape, attachment.part) != extent_of(graph.shape(first.image), first.part))
        return fail(Fault::usage, "graph.attachment_extents",
                    "{step} draws into '{image}' and into '{other}', whose extents differ", step.name,
                    graph.record(first.image).name, name);
    if (shape.mips > 1 && !attachment.part.mip)
        return fail(Fault::usage, "graph.attachment_mip_not_named",
                    "{step} draws into '{image}', which has several mips, and names none", step.name, name);
    return check_part(shape, attachment.part, name, step.name);
}

std::uint32_t layers_of(const Graph& graph, const Attachment& attachment) {
    return attachment.part.layer ? 1 : graph.shape(attachment.image).layers;
}

/// Attachments of several layers are drawn into at once, so all have as many, and a shader says which one a triangle is in.
Result<void> check_layers(const Graph& graph, PlannedStep& planned) {
    const Step& step = planned.step;
    if (step.attachments.empty()) return {};
    const Attachment& first = step.attachments.front();
    planned.layers = layers_of(graph, first);
    for (const Attachment& attachment : step.attachments)
        if (layers_of(graph, attachment) != planned.layers)
            return fail(Fault::usage, "graph.attachment_layers",
                        "{step} draws into '{image}' with {layers} layers and into '{other}' with {other_layers}", step.name,
                        graph.record(first.image).name, planned.layers, graph.record(attachment.image).name,
                        layers_of(graph, attachment));
    const bool chosen = std::ranges::any_of(planned.shaders, &Shader::chooses_layer);
    if (planned.layers > 1 && !chosen)
        return fail(Fault::usage, "graph.layer_not_named",
                    "{step} draws into '{image}', which has {layers} layers: name one, or let a shader write gl_Layer", step.name,
                    graph.record(first.image).name, planned.layers);
    return {};
}

Extent drawn_extent(const Graph& graph, const Step& step, const DrawWork& draw) {
    if (draw.viewport) return *draw.viewport;
    const Attachment& first = step.attachments.front();
    return extent_of(graph.shape(first.image), first.part);
}

template <typename Lines>
bool are_within(const Lines& lines, std::uint32_t count) {
    return lines.count > 0 && lines.first < count && lines.count <= count - lines.first;
}

/// A device would refuse rows and columns outside, and none at all are a mistake.
Result<void> check_rows(const Graph& graph, const Step& step, const DrawWork& draw) {
    if (!draw.rows && !draw.columns) return {};
    const Extent extent = drawn_extent(graph, step, draw);
    if (draw.rows && !are_within(*draw.rows, extent.height))
        return fail(Fault::usage, "graph.rows_out_of_range",
                    "{step} draws {rows} rows from row {first} of an image that has {height} rows", step.name, draw.rows->count,
                    draw.rows->first, extent.height);
    if (draw.columns && !are_within(*draw.columns, extent.width))
        return fail(Fault::usage, "graph.columns_out_of_range",
                    "{step} draws {columns} columns from column {first} of an image that has {width} columns", step.name,
                    draw.columns->count, draw.columns->first, extent.width);
    return {};
}

Result<void> check_attachments(const Graph& graph, PlannedStep& planned) {
    const Step& step = planned.step;
    const auto* draw = std::get_if<DrawWork>(&step.work);
    const auto* fullscreen = std::get_if<FullscreenWork>(&step.work);
    if (!draw && !fullscreen) return {};
    std::uint32_t colors = 0;
    for (const Attachment& attachment : step.attachments) {
        if (auto checked = check_attachment(graph, step, attachment); !checked) return checked;
        if (row(graph.shape(attachment.image).format).kind != FormatKind::depth) ++colors;
    }
    if (auto checked = check_layers(graph, planned); !checked) return checked;
    const std::uint32_t outputs = planned.shaders.back()->color_outputs;
    if (colors > outputs || (colors < outputs && !step.drops_other_colors))
        return fail(Fault::usage, "graph.color_count",
                    "{shader} writes {colors} colors, but the step has {attachments} color attachments",
                    planned.shaders.back()->name, outputs, colors);
    if (step.attachments.empty() && !(draw ? draw->viewport : fullscreen->viewport))
        return fail(Fault::usage, "graph.no_extent",
                    "{step} has no attachments and does not say which pixels it draws: add .within(extent)", step.name);
    if (draw && draw->list.count > 0 && (!draw->list.commands || (draw->count && !draw->list.indices)))
        return fail(Fault::usage, "graph.no_draw_commands",
                    "{step} draws {draws} indirect commands, but names no buffer that holds them", step.name, draw->list.count);
    return draw ? check_rows(graph, step, *draw) : Result<void>{};
}

bool overlap(std::optional<std::uint32_t> a, std::optional<std::uint32_t> b) { return !a || !b || *a == *b; }

/// An image has one layout at a time: two accesses of one step to the same texels must agree on it.
Result<void> check_conflicts(const Graph& graph, const PlannedStep& planned) {
    const std::vector<Use> all = uses(planned);
    for (std::size_t i = 0; i < all.size(); ++i) {
        for (std::size_t j = i + 1; j < all.size(); ++j) {
            const Use &a = all[i], &b = all[j];
            if (!a.image || a.image.id != b.image.id || a.access == b.access) continue;
            if (!overlap(a.part.mip, b.part.mip) || !overlap(a.part.layer, b.part.layer)) continue;
            const auto storage = [](Access access) {
                return access == Access::loaded || access == Access::stored || access == Access::updated;
            };
            const bool both_read = !writes(a.access) && !writes(b.access);
            if (both_read && a.part == b.part) continue;
            if (storage(a.access) && storage(b.access)) continue;
            return fail(Fault::usage, "graph.access_conflict",
                        "{step} uses '{image}' as {access} ('{binding}') and as {other_access} ('{other}') at once",
                        planned.step.name, graph.record(a.image).name, name(a.access), a.as, name(b.access), b.as);
        }
    }
    return {};
}

Result<void> check_copy(const Graph& graph, const Step& step) {
    const auto* copy = std::get_if<CopyWork>(&step.work);
    if (!copy) return {};
    const bool equal = copy->from ? graph.shape(copy->from) == graph.shape(copy->to)
                                  : graph.record(copy->buffer_from).bytes == graph.record(copy->buffer_to).bytes;
    if (!equal)
        return fail(Fault::usage, "graph.copy_mismatch", "{step}: source and destination of the copy differ in shape or size",
                    step.name);
    return {};
}

Result<void> count_groups(PlannedStep& planned) {
    const auto* work = std::get_if<ComputeWork>(&planned.step.work);
    if (!work) return {};
    const int said = int{work->over.has_value()} + int{work->groups.has_value()} + int{static_cast<bool>(work->arguments)};
    if (said != 1)
        return fail(Fault::usage, "graph.dispatch_size", "{step} must say exactly one of .over(), .groups() and .indirect()",
                    planned.step.name);
    if (work->groups) planned.groups = *work->groups;
    if (work->over) {
        const Extent group = group_size(planned);
        const auto rounded_up = [](std::uint32_t threads, std::uint32_t size) {
            return (threads + size - 1) / std::max(1u, size);
        };
        planned.groups = {rounded_up(work->over->width, group.width), rounded_up(work->over->height, group.height),
                          rounded_up(work->over->depth, group.depth)};
    }
    return {};
}

}  // namespace

Extent group_size(const PlannedStep& planned) {
    const Shader& shader = *planned.shaders.front();
    Extent group = shader.group;
    std::uint32_t* const sizes[] = {&group.width, &group.height, &group.depth};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        for (const Fixed& fixed : planned.step.fixed) {
            const bool sets_it = !shader.group_constants[axis].empty() && fixed.name == shader.group_constants[axis];
            if (sets_it) std::visit([&](auto value) { *sizes[axis] = static_cast<std::uint32_t>(value); }, fixed.value);
        }
    }
    return group;
}

Result<PlannedStep> check_step(const Graph& graph, const Step& step, const ShaderLibrary& library) {
    PlannedStep planned;
    planned.step = step;
    if (auto r = find_shaders(planned, library); !r) return r.error();
    if (!planned.shaders.empty()) {
        if (auto r = check_unknown_names(planned); !r) return r.error();
    }
    if (auto r = place_bindings(graph, planned); !r) return r.error();
    if (auto r = check_push(planned); !r) return r.error();
    if (auto r = check_attachments(graph, planned); !r) return r.error();
    if (auto r = check_copy(graph, step); !r) return r.error();
    if (auto r = check_conflicts(graph, planned); !r) return r.error();
    if (auto r = count_groups(planned); !r) return r.error();
    return planned;
}

}  // namespace strata
