// Cells of view space on the CPU and what a blocker's shadow does to them (docs/algorithms/lighting.md 2.3), in float, operation
// by operation as blocker_cells.glsl has it, or in double.
#pragma once

#include <array>
#include <cstdint>

#include <glm/glm.hpp>

#include "passes/shaders/scene/lights.shared.h"

namespace strata::lighting {

/// The part of a tile between two view depths. Order of corners and planes: passes/lighting/cell.glsl.
template <typename Real>
struct Cell {
    std::array<glm::vec<3, Real>, 8> corners;
    std::array<glm::vec<4, Real>, 6> planes;  ///< inward
    Real z_near = 0, z_far = 0;
};

/// Rays (x, y, 1) through a tile's edges, +y up.
template <typename Real>
struct TileRays {
    Real left = 0, right = 0, bottom = 0, top = 0;
};

template <typename Real>
Cell<Real> cell_between(const TileRays<Real>&, Real z_near, Real z_far);

/// `none` and `full` hold for every point of a cell and of its surfaces' offsets; `partial` is all else.
enum class Reach : std::uint32_t { none, partial, full };

/// Of a blocker or portal_rectangle() whose light is (position, 1) or (towards it, 0).
template <typename Real>
Reach classify(const BlockerRecord&, const glm::vec<4, Real>& light, const Cell<Real>&);

/// A portal as a rectangle of its own, in the plane of its blocker.
BlockerRecord portal_rectangle(const BlockerRecord&, const BlockerPortalRecord&);

extern template Cell<float> cell_between(const TileRays<float>&, float, float);
extern template Cell<double> cell_between(const TileRays<double>&, double, double);
extern template Reach classify(const BlockerRecord&, const glm::vec<4, float>&, const Cell<float>&);
extern template Reach classify(const BlockerRecord&, const glm::vec<4, double>&, const Cell<double>&);

}  // namespace strata::lighting
