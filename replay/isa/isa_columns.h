// What a report of compilers says of each of its rows: the one list of columns for every format.
#pragma once

#include <span>

#include "replay/isa/isa_report.h"
#include "replay/tables/sheet.h"

namespace strata {

Sheet programs_of(const IsaOfGpu&);
Sheet isa_steps_of(const IsaOfGpu&);
Sheet variants_of(const TileWaves&);
Sheet sheet_of(std::span<const GpuModel>);

}  // namespace strata
