// How our values are called in what tests print.
#pragma once

#include <iosfwd>
#include <string>

#include <gtest/gtest.h>

#include "passes/technique.h"
#include "tests/support/errors.h"

namespace strata {

void PrintTo(const Technique&, std::ostream*);

/// A technique's name, or a text that begins with one, as part of a test's name: "transparency_voxel".
std::string as_identifier(std::string text);

/// What a suite of tests over techniques is instantiated with.
std::string technique_test_name(const testing::TestParamInfo<Technique>&);

}  // namespace strata
