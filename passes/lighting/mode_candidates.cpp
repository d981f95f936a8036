// Which modes a search for modes considers.
#include <algorithm>
#include <set>

#include "passes/lighting/mode_search.h"

namespace strata::lighting {
namespace {

constexpr std::size_t paired_spectra = 64;  // docs/algorithms/lighting.md 3.5

/// A union of spectra and how many tiles it stands for.
struct Merged {
    std::uint32_t features = 0;
    double tiles = 0;
};

/// Weighted tiles by spectrum, most first.
std::vector<Merged> weighted_spectra(const ModeProblem& problem) {
    std::map<std::uint32_t, double> sums;
    for (const Scene& scene : problem.scenes)
        for (const auto& [spectrum, tiles] : scene.tiles) sums[spectrum] += scene.weight * double(tiles);
    std::vector<Merged> spectra;
    for (const auto& [spectrum, tiles] : sums) spectra.push_back({spectrum, tiles});
    std::ranges::stable_sort(spectra, std::greater(), &Merged::tiles);
    return spectra;
}

/// What serving both by their union costs more than serving each by itself.
double price(const ModeProblem& problem, const Merged& a, const Merged& b) {
    const double together = problem.cost(a.features | b.features);
    return a.tiles * (together - problem.cost(a.features)) + b.tiles * (together - problem.cost(b.features));
}

/// Adds the unions met while the cheapest pair is merged until one is left.
void add_merges(const ModeProblem& problem, std::vector<Merged> clusters, std::set<std::uint32_t>& found) {
    while (clusters.size() > 1) {
        std::size_t first = 0, second = 1;
        double least = price(problem, clusters[0], clusters[1]);
        for (std::size_t a = 0; a < clusters.size(); ++a)
            for (std::size_t b = a + 1; b < clusters.size(); ++b)
                if (const double asked = price(problem, clusters[a], clusters[b]); asked < least) {
                    least = asked;
                    first = a;
                    second = b;
                }
        clusters[first].features |= clusters[second].features;
        clusters[first].tiles += clusters[second].tiles;
        clusters.erase(clusters.begin() + static_cast<std::ptrdiff_t>(second));
        found.insert(clusters[first].features);
    }
}

}  // namespace

std::vector<std::uint32_t> union_closure(std::span<const std::uint32_t> spectra, std::size_t cap) {
    std::set<std::uint32_t> closure;
    for (const std::uint32_t spectrum : spectra) {
        std::vector<std::uint32_t> unions{spectrum};
        for (const std::uint32_t known : closure) unions.push_back(known | spectrum);
        closure.insert(unions.begin(), unions.end());
        if (closure.size() > cap) return {};
    }
    return {closure.begin(), closure.end()};
}

std::vector<std::uint32_t> candidates(const ModeProblem& problem) {
    std::vector<Merged> spectra = weighted_spectra(problem);
    std::vector<std::uint32_t> observed;
    for (const Merged& one : spectra) observed.push_back(one.features);
    if (auto closure = union_closure(observed, largest_closure); !closure.empty() || observed.empty()) return closure;
    std::set<std::uint32_t> found(observed.begin(),
                                  observed.begin() + std::ptrdiff_t(std::min(observed.size(), largest_closure)));
    spectra.resize(std::min(spectra.size(), paired_spectra));
    for (std::size_t a = 0; a < spectra.size(); ++a)
        for (std::size_t b = a + 1; b < spectra.size(); ++b) found.insert(spectra[a].features | spectra[b].features);
    add_merges(problem, std::move(spectra), found);
    return {found.begin(), found.end()};
}

}  // namespace strata::lighting
