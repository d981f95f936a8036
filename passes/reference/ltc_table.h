// The fitted table of linearly transformed cosines (passes/shaders/ltc.shared.h): data, read by shaders and references alike.
// `fit_ltc` writes it: cmake --build BUILD --target fit_ltc && BUILD/fit_ltc > passes/reference/ltc_table.inc
#pragma once

#include <span>

#include <glm/glm.hpp>

#include "capture_format/frame/material.h"
#include "passes/shaders/ltc.shared.h"

namespace strata {

/// ltc_edge x ltc_edge records, roughness by roughness.
std::span<const LtcRecord> ltc_table();

/// The record between four of them; roughness and cosine in 0..1.
struct Ltc {
    double m11 = 1, m13 = 0, m22 = 1, m31 = 0, m33 = 1, albedo = 0, fresnel = 0;
};
Ltc ltc_at(double roughness, double eye_cosine);

/// The share of light from everywhere that the lobe reflects; of many bounces by Turquin 2019, with the table's albedo.
glm::dvec3 reflectance(const Ltc&, LightingModel, const glm::dvec3& f0);

}  // namespace strata
