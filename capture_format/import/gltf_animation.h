// One animation of a glTF, sampled at any time. After its last key it begins again; before its first key the first one holds.
#pragma once

#include <string>
#include <vector>

#include "capture_format/import/gltf_document.h"
#include "capture_format/import/gltf_nodes.h"
#include "capture_format/memory_budget.h"
#include "capture_format/result.h"

namespace strata::gltf {

enum class Path { translation, rotation, scale, weights };
enum class Interpolation { linear, step, cubic };

/// The keys of one property of one node.
struct Track {
    int node = -1;
    Path path = Path::translation;
    Interpolation interpolation = Interpolation::linear;
    std::size_t width = 0;       ///< numbers per value: 3, 4 for rotations (x y z w), one per morph target
    std::vector<double> times;   ///< seconds, never falling
    std::vector<double> values;  ///< width per key; cubic ones have in-tangent, value and out-tangent
};

/// The value at a time between or beyond the keys. Rotations turn the short way round (slerp) and are unit.
std::vector<double> value_at(const Track&, double time);

/// The index of the animation that a name or, when no animation has it, a number stands for; the first one for an empty text.
/// -1 when there is none and none was asked for.
Result<int> find_animation(const Document&, const std::string& wanted);

class Clip {
public:
    /// Fails when keys are broken or lead to nodes that do not exist.
    static Result<Clip> read(const Document&, const Animation&, MemoryBudget&);

    /// The pose of every node, seconds after the clip's first beginning.
    NodePose pose(const Document&, double time) const;
    /// The time of the last key in seconds.
    double duration() const { return duration_; }
    /// Which nodes have a property that the clip sets.
    std::vector<bool> animated(std::size_t nodes) const;
    const std::vector<std::string>& warnings() const { return warnings_; }

private:
    std::vector<Track> tracks_;
    double duration_ = 0;
    std::vector<std::string> warnings_;
};

}  // namespace strata::gltf
