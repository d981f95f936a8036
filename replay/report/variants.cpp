#include "replay/report/variants.h"

#include <algorithm>
#include <set>
#include <sstream>

#include <fmt/ranges.h>

#include "passes/registry.h"
#include "passes/stages.h"
#include "passes/technique.h"
#include "replay/session/choice_text.h"

namespace strata {
namespace {

/// "key=value" on top of what the variant has.
Variant with(Variant variant, std::string_view setting) {
    variant.request.choices.settings.push_back(*parse_setting(*variant.technique, setting));
    variant.settings += fmt::format("{}{}", variant.settings.empty() ? "" : " ", setting);
    return variant;
}

Variant at_settings(Variant variant, std::string_view point) {
    std::istringstream settings{std::string(point)};
    for (std::string setting; settings >> setting;) variant = with(std::move(variant), setting);
    return variant;
}

/// Every value of a sweep that one of the techniques has must be one of its values: known before the first row is measured.
Result<void> check_sweeps(std::span<const Variant> swept, std::span<const Sweep> sweeps) {
    for (const Variant& variant : swept)
        for (const Sweep& sweep : sweeps) {
            if (!has_param(*variant.technique, sweep.key)) continue;
            Settings settings(variant.technique->params);
            for (const std::string& value : sweep.values)
                if (const auto fits = settings.set(sweep.key, value); !fits)
                    return within(fits.error(), "--sweep {setting}={value}: {technique}", sweep.key, value,
                                  variant.technique->name);
        }
    return {};
}

std::vector<Variant> swept(const Variant& defaults, std::span<const Sweep> sweeps) {
    std::vector<Variant> variants{defaults};
    for (const Sweep& sweep : sweeps) {
        if (!has_param(*defaults.technique, sweep.key)) continue;
        std::vector<Variant> multiplied;
        for (const Variant& variant : variants)
            for (const std::string& value : sweep.values) multiplied.push_back(with(variant, sweep.key + "=" + value));
        variants = std::move(multiplied);
    }
    return variants;
}

/// The technique with every parameter, given or by default: what tells rows apart.
std::string whole_choice(const Variant& variant) {
    Settings settings(variant.technique->params);
    for (const SettingChange& change : variant.request.choices.settings) {
        if ((change.technique && change.technique != variant.technique) || !has_param(*variant.technique, change.key)) continue;
        const auto kept = std::visit([&](const auto& value) { return settings.set(change.key, value); }, change.value);
        static_cast<void>(kept);  // what is out of range is refused where the row is made
    }
    return fmt::format("{} {}", variant.technique->name, fmt::join(settings.lines(), " "));
}

Result<void> check_rows_differ(std::span<const Variant> rows) {
    std::set<std::string> known;
    for (const Variant& row : rows)
        if (!known.insert(whole_choice(row)).second)
            return fail(Fault::usage, "report.row_given_twice", "--techniques and --sweep give the row '{row}' twice",
                        label(row.technique->name, row.settings));
    return {};
}

/// Times are multiples of the time unit's: it is measured, asked for or not.
std::vector<Variant> with_the_time_unit(std::vector<Variant> listed, const ReportRequest& wanted) {
    for (const Technique* technique : techniques_of(wanted.stage)) {
        const auto is_listed = [&](const Variant& variant) { return variant.technique == technique && variant.settings.empty(); };
        if (!technique->abilities.is_time_unit || std::ranges::any_of(listed, is_listed)) continue;
        Variant unit{technique, wanted.base, ""};
        unit.request.choices.use(*technique);
        listed.push_back(std::move(unit));
    }
    return listed;
}

}  // namespace

std::string label(std::string_view technique, std::string_view settings) {
    return fmt::format("{}{}{}", technique, settings.empty() ? "" : " ", settings);
}

std::string below_stage(std::string_view label) { return std::string(label.substr(label.find('/') + 1)); }

Result<Variant> variant_of(const Technique& technique, std::string_view way, const Request& base) {
    const std::string_view first = way.substr(0, way.find(' '));
    const bool is_own = first.empty() || first.find('=') != first.npos;
    const auto found =
        is_own ? Result<const Technique*>(&technique) : find_technique(fmt::format("{}/{}", name(technique.stage), first));
    if (!found) return found.error();
    Variant defaults{*found, base, ""};
    defaults.request.choices.use(**found);
    return at_settings(defaults, is_own ? way : way.substr(first.size()));
}

Result<void> check_has_techniques(Stage stage) {
    if (!techniques_of(stage).empty()) return {};
    return fail(Fault::usage, "stage.no_technique", "the stage {stage} has no technique yet", name(stage));
}

Result<std::vector<Variant>> variants(const ReportRequest& wanted) {
    const auto techniques = techniques_of(wanted.stage);
    for (const Sweep& sweep : wanted.sweeps)
        if (std::ranges::none_of(techniques, [&](const Technique* technique) { return has_param(*technique, sweep.key); }))
            return fail(Fault::usage, "settings.unknown", "no technique of the stage {stage} has a parameter '{setting}'",
                        name(wanted.stage), sweep.key);
    std::vector<Variant> all;
    for (const std::string& text : wanted.techniques) {
        auto variant = parse_variant(wanted.stage, text);
        if (!variant) return variant.error();
        Variant listed{variant->technique, wanted.base, variant->text};
        listed.request.choices.use(*variant->technique);
        std::ranges::move(variant->settings, std::back_inserter(listed.request.choices.settings));
        std::ranges::move(swept(listed, wanted.sweeps), std::back_inserter(all));
    }
    if (const auto fits = check_sweeps(all, wanted.sweeps); !fits) return fits.error();
    if (const auto differ = check_rows_differ(all); !differ) return differ.error();
    if (!wanted.techniques.empty()) return with_the_time_unit(std::move(all), wanted);
    for (const Technique* technique : techniques) {
        Variant defaults{technique, wanted.base, ""};
        defaults.request.choices.use(*technique);
        std::ranges::move(swept(defaults, wanted.sweeps), std::back_inserter(all));
        if (!wanted.sweeps.empty() || wanted.defaults_only) continue;
        for (const std::string_view point : technique->variants) all.push_back(at_settings(defaults, point));
    }
    if (const auto fits = check_sweeps(all, wanted.sweeps); !fits) return fits.error();
    if (!wanted.sweeps.empty())
        if (const auto differ = check_rows_differ(all); !differ) return differ.error();
    return all;
}

}  // namespace strata
