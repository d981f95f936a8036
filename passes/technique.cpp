#include "passes/technique.h"

#include <algorithm>
#include <cassert>
#include <charconv>
#include <cmath>

#include "capture_format/nearest_name.h"
#include "capture_format/result.h"
#include "passes/graph/step.h"
#include "passes/stages.h"

namespace strata {
namespace {

struct Range {
    double low = 0, high = 0;
};

Range range_of(const Param& param) {
    if (param.choices.empty()) return {param.low, param.high};
    return {0, static_cast<double>(param.choices.size() - 1)};
}

std::string choices_text(const Param& param) {
    std::string text;
    for (const std::string_view choice : param.choices) text += (text.empty() ? "" : ", ") + std::string(choice);
    return text;
}

std::optional<double> number_in(std::string_view text) {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return value;
}

Result<double> checked(const Param& param, double value) {
    const Range range = range_of(param);
    const bool whole = param.scalar == Scalar::real || value == std::floor(value);
    if (value >= range.low && value <= range.high && whole) return value;
    if (!param.choices.empty())
        return fail(Fault::usage, "settings.not_a_choice", "{setting} is one of {choices}, not {value}", param.name,
                    choices_text(param), value);
    if (!whole)
        return fail(Fault::usage, "settings.not_whole", "{setting} is a whole number from {low} to {high}, not {value}",
                    param.name, range.low, range.high, value);
    return fail(Fault::usage, "settings.out_of_range", "{setting} is from {low} to {high}, not {value}", param.name, range.low,
                range.high, value);
}

Result<double> parsed(const Param& param, std::string_view text) {
    for (std::size_t i = 0; i < param.choices.size(); ++i)
        if (param.choices[i] == text) return static_cast<double>(i);
    if (const auto number = number_in(text)) return checked(param, *number);
    if (!param.choices.empty())
        return fail(Fault::usage, "settings.not_a_choice", "{setting} is one of {choices}, not {value}{suggestion}", param.name,
                    choices_text(param), text, did_you_mean(text, param.choices));
    return fail(Fault::usage, "settings.not_a_number", "{setting} is a number from {low} to {high}, not '{value}'", param.name,
                param.low, param.high, text);
}

Result<std::size_t> find_param(std::span<const Param> params, std::string_view name) {
    std::vector<std::string_view> known;
    for (std::size_t i = 0; i < params.size(); ++i) {
        if (params[i].name == name) return i;
        known.push_back(params[i].name);
    }
    return fail(Fault::usage, "settings.unknown", "no parameter {setting}{suggestion}", name, did_you_mean(name, known));
}

template <typename T>
void place(std::span<std::byte> block, std::size_t offset, T value) {
    assert(offset + sizeof value <= block.size());
    std::memcpy(block.data() + offset, &value, sizeof value);
}

}  // namespace

std::string text_of(const Param& param, double value) {
    if (!param.choices.empty()) return std::string(param.choices[static_cast<std::size_t>(value)]);
    if (param.scalar == Scalar::integer) return fmt::format("{}", static_cast<std::int64_t>(value));
    return fmt::format("{}", value);
}

std::string_view name(ModelKind kind) { return kind == ModelKind::mirror ? "mirror" : "paper"; }

Settings::Settings(std::span<const Param> params) : params_(params) {
    for (const Param& param : params) values_.push_back(param.fallback);
}

Result<void> Settings::set(std::string_view name, std::string_view value) {
    const auto at = find_param(params_, name);
    if (!at) return at.error();
    const auto number = parsed(params_[*at], value);
    if (!number) return number.error();
    values_[*at] = *number;
    return {};
}

Result<void> Settings::set(std::string_view name, double value) {
    const auto at = find_param(params_, name);
    if (!at) return at.error();
    const auto number = checked(params_[*at], value);
    if (!number) return number.error();
    values_[*at] = *number;
    return {};
}

double Settings::get(std::string_view name) const {
    const auto at = find_param(params_, name);
    assert(at && "Settings::get: a technique asks for a parameter it does not have");
    return at ? values_[*at] : 0;
}

std::vector<std::string> Settings::lines() const {
    std::vector<std::string> all;
    for (std::size_t i = 0; i < values_.size(); ++i)
        all.push_back(fmt::format("{}={}", params_[i].name, text_of(params_[i], values_[i])));
    return all;
}

void Settings::write(std::span<std::byte> block) const {
    for (std::size_t i = 0; i < values_.size(); ++i) {
        const Param& param = params_[i];
        if (param.scalar == Scalar::real) place(block, param.offset, static_cast<float>(values_[i]));
        else  // int32 and uint32 have the same bits where both can hold the value
            place(block, param.offset, static_cast<std::uint32_t>(static_cast<std::int64_t>(values_[i])));
    }
}

Tolerance tolerance_at(const Tolerance& tolerance, std::string_view settings, std::string_view scenario) {
    for (const ToleranceException& row : tolerance.exceptions)
        if (row.settings == settings && row.scenario == scenario) return {row.rmse, row.worst, row.because};
    return tolerance;
}

TruthRow truth_of(const Technique& technique, const Settings& settings) {
    const StageInfo& stage = info(technique.stage);
    const std::string_view name = technique.approximates ? technique.approximates(settings) : std::string_view();
    if (name.empty()) return {.make = stage.truth, .is = stage.truth_is};
    const auto row = std::ranges::find(stage.other_truths, name, &TruthRow::name);
    assert(row != stage.other_truths.end());
    return *row;
}

}  // namespace strata
