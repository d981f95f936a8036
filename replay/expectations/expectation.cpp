#include "replay/expectations/expectation.h"

#include <algorithm>
#include <new>

#include <xxhash.h>
#include <nlohmann/json.hpp>

#include "capture_format/reader.h"
#include "passes/frame_images.h"
#include "replay/expectations/expectation_keys.h"
#include "replay/images/image_io.h"
#include "replay/plural.h"

namespace strata {
namespace {

using nlohmann::ordered_json;

constexpr std::string_view schema = "strata.expectation";

ordered_json json_of(const ExpectedImage& image) {
    const Shape& s = image.shape;
    ordered_json json{{"name", image.name},
                      {"hash", image.hash},
                      {"extent", {s.extent.width, s.extent.height, s.extent.depth}},
                      {"layers", s.layers},
                      {"format", row(s.format).name}};
    if (!image.texels.empty()) json["texels"] = image.texels;
    return json;
}

ExpectedImage image_from(const ordered_json& json) {
    ExpectedImage image{.name = json.at("name"), .hash = json.at("hash"), .texels = json.value("texels", "")};
    const auto extent = json.at("extent").get<std::array<std::uint32_t, 3>>();
    image.shape.extent = {extent[0], extent[1], extent[2]};
    image.shape.layers = json.at("layers");
    const std::string format = json.at("format");
    const auto known = std::ranges::find(format_rows, std::string_view(format), &FormatRow::name);
    if (known == std::end(format_rows)) throw std::invalid_argument(fmt::format("there is no format '{}'", format));
    image.shape.format = known->format;
    return image;
}

ordered_json json_of(const ExpectedOn& on) {
    return {{"device", on.device},
            {"driver", on.driver},
            {"driver_version", on.driver_version},
            {"cpu", on.cpu},
            {"vector_width", on.vector_width}};
}

ExpectedOn on_from(const ordered_json& json) {
    return {json.at("device"), json.at("driver"), json.at("driver_version"), json.at("cpu"), json.at("vector_width")};
}

ExpectedPass pass_from(const ordered_json& json, const ExpectationKeys& keys) {
    ExpectedPass pass{.label = json.at(keys.pass), .choice = json.at("choice"), .images = {}};
    for (const ordered_json& image : json.at("images")) pass.images.push_back(image_from(image));
    return pass;
}

Expectation expectation_from(const ordered_json& json) {
    const int version = json.at("schema_version");
    if (json.at("schema") != schema || version < 1 || version > expectation_version)
        throw std::invalid_argument(fmt::format("it is no {} of version 1 to {}", schema, expectation_version));
    const ExpectationKeys keys = expectation_keys(version);
    Expectation e{.frame = json.at("frame"),
                  .samples = json.at("samples"),
                  .forced = json.at("forced"),
                  .on = on_from(json.at("on")),
                  .tool = json.at("tool"),
                  .also = json.value("also", false),
                  .passes = {}};
    for (const ordered_json& pass : json.at(keys.passes)) e.passes.push_back(pass_from(pass, keys));
    return e;
}

}  // namespace

ExpectedOn expected_on(const DeviceInfo& device) {
    return {device.name, device.driver, device.driver_version, device.cpu, device.vector_width};
}

std::string text(const ExpectedOn& on) {
    return fmt::format("{}, {} {}, {}, {}", on.device, on.driver, on.driver_version, plural(on.vector_width, "lane"), on.cpu);
}

Expectation expectation_of(const Session& session, const Request& request, const Run& run) {
    Expectation e{.frame = request.variant.frame, .samples = run.samples, .on = expected_on(session.device())};
    for (const Feature feature : request.variant.force) e.forced.emplace_back(name(feature));
    for (const PassImages& pass : run.passes) {
        e.passes.push_back({pass.label, pass.choice, {}});
        for (const auto& [name, image] : pass.images) e.passes.back().images.push_back({name, hash_of(image), image.shape, ""});
    }
    return e;
}

bool same_frame_and_choices(const Expectation& a, const Expectation& b) {
    const auto same = [](const ExpectedPass& x, const ExpectedPass& y) { return x.label == y.label && x.choice == y.choice; };
    return a.frame == b.frame && a.samples == b.samples && a.forced == b.forced && std::ranges::equal(a.passes, b.passes, same);
}

std::string as_json(const Expectation& e) {
    const ExpectationKeys keys = expectation_keys(expectation_version);
    ordered_json json{{"schema", schema},   {"schema_version", expectation_version},
                      {"frame", e.frame},   {"samples", e.samples},
                      {"forced", e.forced}, {"on", json_of(e.on)},
                      {"tool", e.tool},     {keys.passes, ordered_json::array()}};
    if (e.also) json["also"] = true;
    for (const ExpectedPass& pass : e.passes) {
        ordered_json images = ordered_json::array();
        for (const ExpectedImage& image : pass.images) images.push_back(json_of(image));
        json[keys.passes].push_back({{keys.pass, pass.label}, {"choice", pass.choice}, {"images", std::move(images)}});
    }
    return json.dump();
}

Result<Expectation> parse_expectation(std::string_view json) {
    try {
        return expectation_from(ordered_json::parse(json));
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& problem) {
        return fail(Fault::bad_input, "expectation.cannot_read", "an expectation cannot be read: {reason}", problem.what());
    }
}

Result<std::vector<Expectation>> expectations_of(const Capture& capture) {
    std::vector<Expectation> all;
    for (const std::string& json : capture.expectations()) {
        auto parsed = parse_expectation(json);
        if (!parsed) return parsed.error();
        all.push_back(*std::move(parsed));
    }
    return all;
}

std::string short_json(const Expectation& e) {
    ordered_json json{{"frame", e.frame}, {"on", json_of(e.on)}};
    for (const ExpectedPass& pass : e.passes)
        for (const ExpectedImage& image : pass.images) json["hashes"][pass.label][image.name] = image.hash;
    return json.dump();
}

}  // namespace strata
