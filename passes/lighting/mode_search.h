// Which N shading modes serve the tiles of one or several scenes at the least cost (docs/algorithms/lighting.md 3.5 and 3.7): a
// p-median with coverage. Greedy additions, then swaps of one mode, then a branch and bound that proves the result or beats it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "passes/lighting/mode_costs.h"
#include "passes/lighting/spectra.h"

namespace strata::lighting {

struct Scene {
    Histogram tiles;
    double weight = 1;  ///< how often or how long it is seen
};

/// What is minimized over scenes: the weighted sum of their costs, or the highest of their weighted costs.
enum class Aim { sum, worst };

struct ModeProblem {
    std::vector<Scene> scenes;
    std::size_t modes = 8;  ///< at most so many, the full one included
    ModeCost cost;
    double dispatch = 0;  ///< what a mode costs every frame, used or not, in the unit of cost
    Aim aim = Aim::sum;
    std::uint32_t full = every_light_feature;  ///< the mode that serves whatever comes is always there
    /// The register target of docs/algorithms/lighting.md 3.7: no two modes of a set are one a strict subset of the other and
    /// leave room for as many waves, since the smaller would skip arithmetic only, which uniform branches do nearly as well.
    /// Empty: any set will do.
    ModeWaves waves = {};
};

struct ModeSet {
    std::vector<Mode> modes;  ///< cheapest first, of equal cost the one with fewer, then lower bits first: the full one is last
    double cost = 0;          ///< of all scenes by the problem's aim, dispatches included
    std::size_t swaps = 0;    ///< of the search's second step
    bool proven = false;      ///< that none is better among unions of observed spectra
};

/// Every union of the spectra, themselves included, in ascending order: a mode of an optimal set is the union of the spectra that
/// it serves, where fewer bits cost no more. Empty when there are more than the cap.
std::vector<std::uint32_t> union_closure(std::span<const std::uint32_t> spectra, std::size_t cap);
inline constexpr std::size_t largest_closure = 4096;
/// The closure of the scenes' spectra; where that is too large, the spectra, the unions of pairs of the 64 most frequent, and
/// those met on the way when the two whose union costs least are merged until one is left.
std::vector<std::uint32_t> candidates(const ModeProblem&);

/// What a set of modes costs; the problem's full mode is added.
double cost_of(const ModeProblem&, std::span<const std::uint32_t> modes);
/// What tiles cost if every candidate were a mode, without dispatches: nothing is below.
double ideal_cost(const ModeProblem&);

/// Adds the mode that saves most while one saves more than its dispatch. At least 1 - 1/e of the best possible saving (the sum is
/// monotone and submodular), and visibly less than all of it.
ModeSet greedy_modes(const ModeProblem&);
/// Greedy, then the best exchange of one mode as long as one helps; modes that no tile wants any more are left out.
ModeSet swapped_modes(const ModeProblem&);
/// The same, then branch and bound within a budget of about half a second: `proven` when it came to an
/// end.
ModeSet best_modes(const ModeProblem&);

}  // namespace strata::lighting
