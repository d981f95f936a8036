#include "replay/report/needs.h"

#include <algorithm>
#include <set>
#include <tuple>

#include <fmt/format.h>

#include "passes/stages.h"
#include "replay/session/eye_move.h"

namespace strata {
namespace {

std::string stage_label(const Scope& scope) {
    if (scope.kind == ScopeKind::frame) return "frame";
    return std::string(name(scope.stage));
}

/// Times of a product's steps, repeat by repeat.
std::optional<Spread> time_of(const std::vector<std::size_t>& steps, const Run& timed) {
    std::vector<double> sums;
    for (const std::size_t step : steps) {
        if (step >= timed.steps.size()) continue;
        const std::vector<double>& each = timed.steps[step].ms_by_repeat;
        sums.resize(std::max(sums.size(), each.size()));
        for (std::size_t i = 0; i < each.size(); ++i) sums[i] += each[i];
    }
    return sums.empty() ? std::nullopt : std::optional(spread_of(sums));
}

std::string readers_of(const ProductUse& use, const std::vector<Scope>& scopes) {
    std::string text;
    std::set<std::string> named;
    const auto add = [&](const std::string& reader) {
        if (named.insert(reader).second) text += (text.empty() ? "" : ", ") + reader;
    };
    for (const std::uint32_t scope : use.readers) add(stage_label(scopes[scope]));
    if (use.is_picture) add("the picture");
    if (use.is_remembered) add("the next frame");
    return text;
}

NeedsRow row_of(const ProductUse& use, const std::vector<Scope>& scopes, const Run* timed) {
    const Scope& maker = scopes[use.maker];
    return {.stage = stage_label(maker),
            .technique = maker.technique,
            .product = use.name,
            .made = use.made * use.unit_bytes,
            .read = use.read * use.unit_bytes,
            .room = use.units * use.unit_bytes,
            .ms = timed ? time_of(use.writers, *timed) : std::nullopt,
            .readers = readers_of(use, scopes)};
}

/// Techniques of which steps run, in the order of the frame.
std::vector<StageNeeds> stages_of(const Needs& needs, const ProductUses& uses, const Run* timed) {
    std::vector<StageNeeds> stages;
    const auto find = [&](const std::string& stage) -> StageNeeds& {
        const auto found = std::ranges::find(stages, stage, &StageNeeds::stage);
        if (found != stages.end()) return *found;
        return stages.emplace_back(StageNeeds{.stage = stage});
    };
    for (const Scope& scope : uses.scopes)
        if (scope.kind == ScopeKind::pass) find(stage_label(scope));
    for (const NeedsRow& row : needs.rows) {
        StageNeeds& stage = find(row.stage);
        stage.made += row.made;
        stage.read += row.read;
        (row.left_out.empty() ? stage.products : stage.left_out) += 1;
    }
    if (timed)
        for (StageNeeds& stage : stages)
            if (const auto ms = timed->stage_ms.find(stage.stage); ms != timed->stage_ms.end()) stage.ms = ms->second;
    return stages;
}

void sort_rows(std::vector<NeedsRow>& rows, const std::vector<Scope>& scopes) {
    const auto place = [&](const NeedsRow& row) {
        return std::ranges::find_if(scopes, [&](const Scope& scope) { return stage_label(scope) == row.stage; }) - scopes.begin();
    };
    const auto unread = [](const NeedsRow& row) { return row.made - row.read; };
    std::ranges::stable_sort(rows, [&](const NeedsRow& a, const NeedsRow& b) {
        const auto key = [&](const NeedsRow& row) { return std::tuple(place(row), !row.left_out.empty(), ~unread(row)); };
        return key(a) < key(b);
    });
}

}  // namespace

Result<Needs> measure_needs(Session& session, const Request& request, std::size_t repeats, const Progress& progress) {
    if (progress) progress("watching what is read", 0);
    const auto uses = product_uses(session, request);
    if (!uses) return uses.error();
    std::vector<Run> timed;
    if (repeats > 0) {
        auto runs = session.time(std::span(&request, 1), repeats, progress);
        if (!runs) return runs.error();
        timed = *std::move(runs);
    }
    Needs needs{.device = session.device(),
                .capture_name = {},
                .capture_id = session.capture_id(),
                .view = text(request.variant.eye),
                .frame = request.variant.frame,
                .width = uses->run.width,
                .height = uses->run.height,
                .samples = uses->run.samples};
    const Run* run = timed.empty() ? nullptr : &timed.front();
    for (const ProductUse& use : uses->products) needs.rows.push_back(row_of(use, uses->scopes, run));
    for (const CulledStep& culled : uses->left_out)
        needs.rows.push_back({.stage = stage_label(culled.scope),
                              .technique = culled.scope.technique,
                              .product = culled.name,
                              .left_out = culled.reason});
    sort_rows(needs.rows, uses->scopes);
    needs.stages = stages_of(needs, *uses, run);
    return needs;
}

std::optional<double> unread_share(std::uint64_t made, std::uint64_t read) {
    return made == 0 ? std::nullopt : std::optional(double(made - read) / double(made));
}

}  // namespace strata
