#include "replay/isa/pipeline_request.h"

#include <algorithm>
#include <map>

#include <nlohmann/json.hpp>

#include "capture_format/frame/no_index.h"

namespace strata {
namespace {

using nlohmann::ordered_json;

/// What a shader of the step declares of what the step fixes.
std::vector<Fixed> fixed_of(const PlannedStep& planned) {
    std::vector<Fixed> found;
    for (const Fixed& fixed : planned.step.fixed) {
        const auto declares = [&](const Shader* shader) {
            return std::ranges::find(shader->constants, fixed.name, &ShaderConstant::name) != shader->constants.end();
        };
        if (std::ranges::any_of(planned.shaders, declares)) found.push_back(fixed);
    }
    return found;
}

/// Sets of bits are easier to tell apart in sixteens.
bool is_set_of_bits(const std::string& name) {
    return name.ends_with("features") || name.ends_with("mask") || name.ends_with("bits");
}

std::string text(const Fixed& fixed) {
    const auto* bits = std::get_if<std::uint32_t>(&fixed.value);
    if (bits && is_set_of_bits(fixed.name)) return fmt::format("{}={:#x}", fixed.name, *bits);
    return std::visit([&](auto value) { return fmt::format("{}={}", fixed.name, value); }, fixed.value);
}

PipelineRequest request_of(const PlannedStep& planned, const std::vector<ImageRecord>& images) {
    PipelineRequest request{.label = planned.step.name};
    PlannedStep& kept = request.step;
    kept.step.name = planned.step.name;
    kept.step.shaders = planned.step.shaders;
    kept.step.fixed = fixed_of(planned);
    kept.step.push.resize(planned.step.push.size());
    kept.shaders = planned.shaders;
    for (const Fixed& fixed : kept.step.fixed) request.label.append(" ").append(text(fixed));
    for (const PlannedBinding& binding : planned.bindings)
        kept.bindings.push_back({.binding = {}, .set = binding.set, .slot = binding.slot, .kind = binding.kind});
    for (const Attachment& attachment : planned.step.attachments) {
        const Shape& shape = images[attachment.image.id].shape;
        const Image image{static_cast<std::uint32_t>(request.images.size()), 0};
        request.images.push_back({.shape = {.format = shape.format, .samples = shape.samples}});
        kept.step.attachments.push_back({.access = attachment.access, .image = image, .blend = attachment.blend});
    }
    if (const auto* draw = std::get_if<DrawWork>(&planned.step.work))
        kept.step.work =
            DrawWork{.alpha_to_coverage = draw->alpha_to_coverage, .at_equal_depth = draw->at_equal_depth, .cull = draw->cull};
    else if (std::holds_alternative<FullscreenWork>(planned.step.work)) kept.step.work = FullscreenWork{};
    return request;
}

template <typename Enum>
std::uint32_t number(Enum value) {
    return static_cast<std::uint32_t>(value);
}

ordered_json json_of(const PipelineRequest& request) {
    const Step& step = request.step.step;
    ordered_json json{{"label", request.label}, {"name", step.name}, {"shaders", ordered_json::array()}};
    for (const Shader* shader : request.step.shaders) json["shaders"].push_back(shader->name);
    json["push_bytes"] = step.push.size();
    for (const Fixed& fixed : step.fixed)
        json["fixed"].push_back(
            {fixed.name, fixed.value.index(), std::visit([](auto value) { return ordered_json(value); }, fixed.value)});
    for (const PlannedBinding& binding : request.step.bindings)
        json["bindings"].push_back({binding.set, binding.slot, number(binding.kind)});
    for (const Attachment& attachment : step.attachments) {
        const Shape& shape = request.images[attachment.image.id].shape;
        json["attachments"].push_back({number(attachment.access), number(attachment.blend), number(shape.format), shape.samples});
    }
    json["work"] = step.work.index();
    if (const auto* draw = std::get_if<DrawWork>(&step.work)) {
        json["cull"] = number(draw->cull);
        json["alpha_to_coverage"] = draw->alpha_to_coverage;
        json["at_equal_depth"] = draw->at_equal_depth;
    }
    return json;
}

Fixed fixed_from(const ordered_json& json) {
    Fixed fixed{json.at(0), {}};
    if (json.at(1) == 0) fixed.value = json.at(2).get<std::uint32_t>();
    if (json.at(1) == 1) fixed.value = json.at(2).get<std::int32_t>();
    if (json.at(1) == 2) fixed.value = json.at(2).get<float>();
    return fixed;
}

Result<PipelineRequest> request_from(const ordered_json& json, const ShaderLibrary& library) {
    PipelineRequest request{.label = json.at("label")};
    PlannedStep& planned = request.step;
    planned.step.name = json.at("name");
    planned.step.push.resize(json.at("push_bytes"));
    for (const std::string name : json.at("shaders")) {
        const Shader* shader = library.find(name);
        if (!shader) return fail(Fault::bad_input, "shader.unknown", "there is no shader {shader}", name);
        planned.shaders.push_back(shader);
        planned.step.shaders.push_back(name);
    }
    for (const ordered_json& fixed : json.value("fixed", ordered_json::array())) planned.step.fixed.push_back(fixed_from(fixed));
    for (const ordered_json& b : json.value("bindings", ordered_json::array())) {
        PlannedBinding& binding = planned.bindings.emplace_back();
        binding.set = b.at(0);
        binding.slot = b.at(1);
        binding.kind = static_cast<BindingKind>(b.at(2).get<std::uint32_t>());
    }
    for (const ordered_json& a : json.value("attachments", ordered_json::array())) {
        const Image image{static_cast<std::uint32_t>(request.images.size()), 0};
        planned.step.attachments.push_back({.access = static_cast<Access>(a.at(0).get<std::uint32_t>()),
                                            .image = image,
                                            .blend = static_cast<Blend>(a.at(1).get<std::uint32_t>())});
        request.images.push_back({.shape = {.format = static_cast<Format>(a.at(2).get<std::uint32_t>()), .samples = a.at(3)}});
    }
    if (json.at("work") == Work(DrawWork{}).index())
        planned.step.work = DrawWork{.alpha_to_coverage = json.at("alpha_to_coverage"),
                                     .at_equal_depth = json.at("at_equal_depth"),
                                     .cull = static_cast<Cull>(json.at("cull").get<std::uint32_t>())};
    if (json.at("work") == Work(FullscreenWork{}).index()) planned.step.work = FullscreenWork{};
    return request;
}

}  // namespace

PipelineRequests pipelines_of(const Plan& plan) {
    PipelineRequests made;
    std::map<std::string, std::uint32_t> known;
    for (const PlannedStep& planned : plan.steps) {
        if (planned.shaders.empty()) {
            made.of_step.push_back(no_index);
            continue;
        }
        PipelineRequest request = request_of(planned, plan.images);
        const auto next = static_cast<std::uint32_t>(made.pipelines.size());
        const auto [found, is_new] = known.try_emplace(json_of(request).dump(), next);
        made.of_step.push_back(found->second);
        if (is_new) made.pipelines.push_back(std::move(request));
    }
    return made;
}

std::string as_json(const std::vector<PipelineRequest>& requests) {
    ordered_json json = ordered_json::array();
    for (const PipelineRequest& request : requests) json.push_back(json_of(request));
    return json.dump();
}

Result<std::vector<PipelineRequest>> pipelines_from_json(const std::string& text, const ShaderLibrary& library) {
    std::vector<PipelineRequest> requests;
    try {
        for (const ordered_json& json : ordered_json::parse(text)) {
            auto request = request_from(json, library);
            if (!request) return request.error();
            requests.push_back(*std::move(request));
        }
    } catch (const nlohmann::json::exception& problem) {
        return fail(Fault::bad_input, "isa.malformed_request", "not a list of pipelines: {reason}", problem.what());
    }
    return requests;
}

}  // namespace strata
