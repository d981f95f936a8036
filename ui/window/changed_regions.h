// Where a frame of the inspector differs from the one before: only that is drawn anew. Most frames differ by a tooltip, a clock
// or the pointer, and on a CPU driver a whole one takes the cores from the replay.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <imgui.h>

namespace strata::ui {

/// In pixels; right and bottom are the first that are out of it.
struct Region {
    std::int32_t left = 0, top = 0, right = 0, bottom = 0;
    bool is_empty() const { return right <= left || bottom <= top; }
    friend bool operator==(const Region&, const Region&) = default;
};

Region intersection(const Region&, const Region&);
/// Where a command may draw.
Region clip_of(const ImDrawCmd&, ImVec2 extent);

class ChangedRegions {
public:
    /// What a texture shows, by its ImTextureID: equal numbers look equal.
    using LookOf = std::function<std::uint64_t(ImTextureID)>;

    /// Those in which the frame differs from the one given before; outside of them the same triangles cover each pixel in the
    /// same order. Few, which may overlap; the whole frame at first and where the extent is another.
    std::vector<Region> next(const ImDrawData&, const LookOf&);
    /// What was drawn is lost.
    void forget() { extent_ = {}; }

private:
    struct Triangle {
        std::array<ImDrawVert, 3> corners;
        Region clip;
        std::uint64_t look = 0;
        bool operator==(const Triangle&) const;
        Region region() const;
    };
    struct List {
        std::string window;
        std::vector<Triangle> triangles;
    };
    static List list_of(const ImDrawList&, ImVec2 extent, const LookOf&);
    static void add_changes(std::vector<Region>&, const List& before, const List& now);

    ImVec2 extent_;
    std::vector<List> lists_;
};

}  // namespace strata::ui
