// What a compiler made of pipelines, in its own words: statistics by name, and the code where it shows it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "capture_format/result.h"

namespace strata {

struct CompilerStatistic {
    std::string name;
    double value = 0;
};

/// A text form of what was compiled: "Assembly", "ACO IR", "NIR Shader(s)".
struct CompilerText {
    std::string name, text;
};

/// One program of a pipeline: a shader stage, or several that the device has merged.
struct Executable {
    std::string stage;  ///< "compute", "vertex", "fragment", "vertex + geometry"
    std::uint32_t wave_lanes = 0;
    std::vector<CompilerStatistic> statistics;
    std::vector<CompilerText> texts;  ///< when they were asked for

    /// By any of the names that drivers use for it.
    std::optional<double> statistic(std::initializer_list<std::string_view> names) const;
    /// The assembly, which drivers give last; where RADV has no disassembler (gfx6 and gfx7 without clrxdisasm) its own last
    /// form. Null where there is no text.
    const CompilerText* code() const;
};

struct CompiledPipeline {
    std::vector<Executable> executables;
    std::string failure;  ///< why there are none
};

struct Compilation {
    std::string device, driver;
    std::vector<CompiledPipeline> pipelines;  ///< in the order of the requests
};

std::string as_json(const Compilation&);
Result<Compilation> compilation_from_json(const std::string&);

}  // namespace strata
