#include "ui/window/changed_regions.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <span>

namespace strata::ui {
namespace {

constexpr std::size_t most_regions = 8;
// Two regions become one that has so many more pixels, of which a driver that draws in tiles of 64 x 64 would draw most anyway.
constexpr std::int64_t pixels_to_spare = 64 * 64;

std::int64_t area(const Region& region) { return std::int64_t{region.right - region.left} * (region.bottom - region.top); }

Region both(const Region& a, const Region& b) {
    return {std::min(a.left, b.left), std::min(a.top, b.top), std::max(a.right, b.right), std::max(a.bottom, b.bottom)};
}

std::int64_t growth(const Region& a, const Region& b) { return area(both(a, b)) - area(a) - area(b); }

/// Adds it to the one that grows the least by it, where that is worth it, or there is no room for another.
void add(std::vector<Region>& regions, Region region) {
    if (region.is_empty()) return;
    while (!regions.empty()) {
        const auto nearest = std::ranges::min_element(regions, {}, [&](const Region& each) { return growth(each, region); });
        if (growth(*nearest, region) > pixels_to_spare && regions.size() < most_regions) break;
        region = both(*nearest, region);
        regions.erase(nearest);
    }
    regions.push_back(region);
}

}  // namespace

Region intersection(const Region& a, const Region& b) {
    return {std::max(a.left, b.left), std::max(a.top, b.top), std::min(a.right, b.right), std::min(a.bottom, b.bottom)};
}

Region clip_of(const ImDrawCmd& command, ImVec2 extent) {
    const auto inside = [](float at, float end) { return static_cast<std::int32_t>(std::clamp(at, 0.0f, end)); };
    return {inside(command.ClipRect.x, extent.x), inside(command.ClipRect.y, extent.y), inside(command.ClipRect.z, extent.x),
            inside(command.ClipRect.w, extent.y)};
}

bool ChangedRegions::Triangle::operator==(const Triangle& other) const {
    return look == other.look && clip == other.clip && std::memcmp(corners.data(), other.corners.data(), sizeof corners) == 0;
}

/// A pixel more at each side than it can cover.
Region ChangedRegions::Triangle::region() const {
    const auto [a, b, c] = corners;
    const auto below = [](float x, float y, float z) { return static_cast<std::int32_t>(std::floor(std::min({x, y, z}))) - 1; };
    const auto above = [](float x, float y, float z) { return static_cast<std::int32_t>(std::ceil(std::max({x, y, z}))) + 1; };
    return intersection(clip, {below(a.pos.x, b.pos.x, c.pos.x), below(a.pos.y, b.pos.y, c.pos.y),
                               above(a.pos.x, b.pos.x, c.pos.x), above(a.pos.y, b.pos.y, c.pos.y)});
}

ChangedRegions::List ChangedRegions::list_of(const ImDrawList& drawn, ImVec2 extent, const LookOf& look_of) {
    List list{.window = drawn._OwnerName ? drawn._OwnerName : "", .triangles = {}};
    list.triangles.reserve(static_cast<std::size_t>(drawn.IdxBuffer.Size) / 3);
    for (const ImDrawCmd& command : drawn.CmdBuffer) {
        const Region clip = clip_of(command, extent);
        if (clip.is_empty()) continue;
        const std::uint64_t look = look_of(command.TextureId);
        const ImDrawVert* const vertices = drawn.VtxBuffer.Data + command.VtxOffset;
        const std::span indices(drawn.IdxBuffer.Data + command.IdxOffset, command.ElemCount);
        for (std::size_t i = 0; i + 2 < indices.size(); i += 3)
            list.triangles.push_back({{vertices[indices[i]], vertices[indices[i + 1]], vertices[indices[i + 2]]}, clip, look});
    }
    return list;
}

void ChangedRegions::add_changes(std::vector<Region>& regions, const List& before, const List& now) {
    const auto [old_first, new_first] = std::ranges::mismatch(before.triangles, now.triangles);
    const std::span old_rest(old_first, before.triangles.end()), new_rest(new_first, now.triangles.end());
    const auto [old_last, new_last] = std::mismatch(old_rest.rbegin(), old_rest.rend(), new_rest.rbegin(), new_rest.rend());
    const std::span old_changed(old_rest.begin(), old_last.base()), new_changed(new_rest.begin(), new_last.base());
    const bool is_in_step = old_changed.size() == new_changed.size();
    for (std::size_t i = 0; i < std::max(old_changed.size(), new_changed.size()); ++i) {
        if (is_in_step && old_changed[i] == new_changed[i]) continue;
        if (i < old_changed.size()) add(regions, old_changed[i].region());
        if (i < new_changed.size()) add(regions, new_changed[i].region());
    }
}

std::vector<Region> ChangedRegions::next(const ImDrawData& data, const LookOf& look_of) {
    std::vector<List> lists;
    for (const ImDrawList* list : std::span(data.CmdLists, static_cast<std::size_t>(data.CmdListsCount)))
        lists.push_back(list_of(*list, data.DisplaySize, look_of));
    std::vector<Region> regions;
    if (data.DisplaySize.x != extent_.x || data.DisplaySize.y != extent_.y) {
        extent_ = data.DisplaySize;
        regions.push_back({0, 0, static_cast<std::int32_t>(extent_.x), static_cast<std::int32_t>(extent_.y)});
    } else {
        // Windows that are drawn in another order are all drawn anew, from the first that is.
        std::size_t same = 0;
        while (same < std::min(lists_.size(), lists.size()) && lists_[same].window == lists[same].window) ++same;
        for (std::size_t i = 0; i < same; ++i) add_changes(regions, lists_[i], lists[i]);
        for (std::size_t i = same; i < lists_.size(); ++i) add_changes(regions, lists_[i], {});
        for (std::size_t i = same; i < lists.size(); ++i) add_changes(regions, {}, lists[i]);
    }
    lists_ = std::move(lists);
    return regions;
}

}  // namespace strata::ui
