#include "passes/lighting/mode_search.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <tuple>

namespace strata::lighting {
namespace {

constexpr std::uint64_t step_budget = 60'000'000;  // of branch and bound: spectra looked at; about half a second

/// A problem's cost: what is minimized, and between equals of that the sum over scenes.
struct Total {
    double aimed = 0, sum = 0;
};

/// A problem as numbers: spectra, candidates and costs evaluated once.
class Instance {
public:
    explicit Instance(const ModeProblem& problem) : problem_(problem) {
        for (const Scene& scene : problem.scenes)
            for (const auto& [spectrum, tiles] : scene.tiles) spectra_.push_back(spectrum);
        std::ranges::sort(spectra_);
        spectra_.erase(std::unique(spectra_.begin(), spectra_.end()), spectra_.end());
        // A sum over scenes is one scene with all their tiles.
        weights_.assign(problem.aim == Aim::sum ? 1 : std::max<std::size_t>(1, problem.scenes.size()),
                        std::vector<double>(spectra_.size()));
        dispatches_.resize(weights_.size());
        for (std::size_t i = 0; i < problem.scenes.size(); ++i) {
            const Scene& scene = problem.scenes[i];
            const std::size_t row = problem.aim == Aim::sum ? 0 : i;
            dispatches_[row] += scene.weight * problem.dispatch;
            for (const auto& [spectrum, tiles] : scene.tiles) {
                const auto at = static_cast<std::size_t>(std::ranges::lower_bound(spectra_, spectrum) - spectra_.begin());
                weights_[row][at] += scene.weight * double(tiles);
            }
        }
        add(problem.full);
        for (const std::uint32_t mode : candidates(problem))
            if (mode != problem.full) add(mode);
        tolerance_ = 1e-12 * (1 + total(per_spectrum({}), 0).sum);
    }

    std::size_t size() const { return modes_.size(); }  ///< candidates; the full mode is 0
    const Mode& mode(std::size_t candidate) const { return modes_[candidate]; }
    double dispatch(std::size_t scene) const { return dispatches_[scene]; }  ///< what a mode costs
    std::size_t scenes() const { return weights_.size(); }
    std::size_t spectra() const { return spectra_.size(); }

    /// The cost of a tile of each spectrum with these modes and the full one.
    std::vector<double> per_spectrum(std::span<const std::size_t> chosen) const {
        std::vector<double> costs(spectra_.size(), modes_[0].cost);
        for (const std::size_t one : chosen) lower(costs, one);
        return costs;
    }
    void lower(std::vector<double>& costs, std::size_t candidate) const {
        for (const std::uint32_t s : served_[candidate]) costs[s] = std::min(costs[s], modes_[candidate].cost);
    }
    /// Of so many modes beside the full one.
    Total total(const std::vector<double>& costs, std::size_t chosen) const {
        Total sum{.aimed = -std::numeric_limits<double>::infinity()};
        for (std::size_t scene = 0; scene < scenes(); ++scene) {
            const double cost = scene_total(costs, chosen, scene);
            sum.aimed = std::max(sum.aimed, cost);
            sum.sum += cost;
        }
        return sum;
    }
    double scene_total(const std::vector<double>& costs, std::size_t chosen, std::size_t scene) const {
        double cost = dispatches_[scene] * double(chosen + 1);
        for (std::size_t s = 0; s < costs.size(); ++s) cost += weights_[scene][s] * costs[s];
        return cost;
    }
    /// What a mode more takes off a scene's cost, its dispatch not counted.
    double saving(const std::vector<double>& costs, std::size_t candidate, std::size_t scene) const {
        double saved = 0;
        for (const std::uint32_t s : served_[candidate])
            saved += weights_[scene][s] * std::max(0., costs[s] - modes_[candidate].cost);
        return saved;
    }
    bool is_better(const Total& a, const Total& b) const {
        if (std::abs(a.aimed - b.aimed) > tolerance_) return a.aimed < b.aimed;
        return a.sum < b.sum - tolerance_;
    }
    /// The register target.
    bool may_join(std::size_t candidate, std::span<const std::size_t> chosen) const {
        if (!problem_.waves) return true;
        const auto fits = [&](std::size_t other) {
            const std::uint32_t a = modes_[candidate].features, b = modes_[other].features;
            return waves_[candidate] != waves_[other] || (!serves(a, b) && !serves(b, a));
        };
        return fits(0) && std::ranges::all_of(chosen, fits);
    }

private:
    void add(std::uint32_t features) {
        modes_.push_back({features, problem_.cost(features)});
        if (problem_.waves) waves_.push_back(problem_.waves(features));
        served_.emplace_back();
        for (std::uint32_t s = 0; s < spectra_.size(); ++s)
            if (serves(features, spectra_[s])) served_.back().push_back(s);
    }

    const ModeProblem& problem_;
    std::vector<std::uint32_t> spectra_;
    std::vector<std::vector<double>> weights_;  ///< [scene][spectrum]
    std::vector<double> dispatches_;            ///< of one mode, by scene
    std::vector<Mode> modes_;
    std::vector<std::uint32_t> waves_;
    std::vector<std::vector<std::uint32_t>> served_;  ///< spectra by candidate
    double tolerance_ = 0;
};

struct Solution {
    std::vector<std::size_t> chosen;  ///< candidates beside the full mode
    Total total;
};

Solution greedy(const Instance& instance, std::size_t most) {
    Solution solution;
    std::vector<double> costs = instance.per_spectrum({});
    solution.total = instance.total(costs, 0);
    while (solution.chosen.size() < most) {
        std::size_t best = 0;
        Total least = solution.total;
        for (std::size_t c = 1; c < instance.size(); ++c) {
            if (!instance.may_join(c, solution.chosen)) continue;
            std::vector<double> lowered = costs;
            instance.lower(lowered, c);
            const Total total = instance.total(lowered, solution.chosen.size() + 1);
            if (!instance.is_better(total, least)) continue;
            least = total;
            best = c;
        }
        if (best == 0) break;
        solution.chosen.push_back(best);
        solution.total = least;
        instance.lower(costs, best);
    }
    return solution;
}

/// The best exchange of one chosen mode for another; false when none helps.
bool swap_one(const Instance& instance, Solution& solution) {
    Solution best = solution;
    for (std::size_t out = 0; out < solution.chosen.size(); ++out) {
        std::vector<std::size_t> rest = solution.chosen;
        rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(out));
        const std::vector<double> costs = instance.per_spectrum(rest);
        for (std::size_t in = 1; in < instance.size(); ++in) {
            if (std::ranges::count(solution.chosen, in) > 0 || !instance.may_join(in, rest)) continue;
            std::vector<double> lowered = costs;
            instance.lower(lowered, in);
            const Total total = instance.total(lowered, solution.chosen.size());
            if (!instance.is_better(total, best.total)) continue;
            best = {rest, total};
            best.chosen.push_back(in);
        }
    }
    if (!instance.is_better(best.total, solution.total)) return false;
    solution = std::move(best);
    return true;
}

/// Sets of candidates, each looked at once; a branch is left when even the sum of its best single savings, which no set of so
/// many modes exceeds (savings are submodular), would not reach the best set known.
class BranchAndBound {
public:
    BranchAndBound(const Instance& instance, std::size_t most, Solution start)
        : instance_(instance), most_(most), best_(std::move(start)) {
        std::vector<std::size_t> all;
        for (std::size_t c = 1; c < instance.size(); ++c) all.push_back(c);
        visit(all, instance.per_spectrum({}));
    }
    const Solution& best() const { return best_; }
    bool came_to_an_end() const { return steps_ <= step_budget; }

private:
    struct Branch {
        std::size_t candidate = 0;
        std::vector<double> savings;  ///< by scene
        double sum = 0;
    };

    std::vector<Branch> branches(const std::vector<std::size_t>& left, const std::vector<double>& costs) {
        std::vector<Branch> found;
        for (const std::size_t c : left) {
            if (!instance_.may_join(c, chosen_)) continue;
            Branch branch{.candidate = c, .savings = {}};
            for (std::size_t scene = 0; scene < instance_.scenes(); ++scene) {
                branch.savings.push_back(instance_.saving(costs, c, scene));
                branch.sum += branch.savings.back();
            }
            steps_ += instance_.spectra() * instance_.scenes();
            if (branch.sum > 0) found.push_back(std::move(branch));
        }
        std::ranges::stable_sort(found, std::greater(), &Branch::sum);
        return found;
    }

    /// What no set can be below that has what is chosen and any of the branches from `first` on.
    Total bound(std::span<const Branch> branches, const std::vector<double>& costs) const {
        const std::size_t room = most_ - chosen_.size();
        Total least{.aimed = -std::numeric_limits<double>::infinity()};
        std::vector<double> savings;
        for (std::size_t scene = 0; scene < instance_.scenes(); ++scene) {
            savings.clear();
            for (const Branch& branch : branches) savings.push_back(branch.savings[scene] - instance_.dispatch(scene));
            const std::size_t kept = std::min(room, savings.size());
            std::ranges::partial_sort(savings, savings.begin() + static_cast<std::ptrdiff_t>(kept), std::greater());
            double reached = instance_.scene_total(costs, chosen_.size(), scene);
            for (std::size_t i = 0; i < kept; ++i) reached -= std::max(0., savings[i]);
            least.aimed = std::max(least.aimed, reached);
            least.sum += reached;
        }
        return least;
    }

    void visit(const std::vector<std::size_t>& left, const std::vector<double>& costs) {
        if (const Total total = instance_.total(costs, chosen_.size()); instance_.is_better(total, best_.total))
            best_ = {chosen_, total};
        if (chosen_.size() == most_) return;
        const std::vector<Branch> found = branches(left, costs);
        for (std::size_t i = 0; i < found.size() && came_to_an_end(); ++i) {
            steps_ += (found.size() - i) * instance_.scenes();
            if (!instance_.is_better(bound(std::span(found).subspan(i), costs), best_.total)) return;
            std::vector<std::size_t> rest;
            for (std::size_t j = i + 1; j < found.size(); ++j) rest.push_back(found[j].candidate);
            std::vector<double> lowered = costs;
            instance_.lower(lowered, found[i].candidate);
            chosen_.push_back(found[i].candidate);
            visit(rest, lowered);
            chosen_.pop_back();
        }
    }

    const Instance& instance_;
    std::size_t most_;
    std::vector<std::size_t> chosen_;
    Solution best_;
    std::uint64_t steps_ = 0;
};

/// Leaves out what a better mode chosen later has made useless, or not worth its dispatch.
void drop_useless(const Instance& instance, Solution& solution) {
    for (std::size_t i = 0; i < solution.chosen.size();) {
        std::vector<std::size_t> rest = solution.chosen;
        rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(i));
        const Total total = instance.total(instance.per_spectrum(rest), rest.size());
        if (instance.is_better(solution.total, total)) ++i;
        else solution = {std::move(rest), total};
    }
}

/// Greedy, then swaps; returns how many.
std::size_t search_locally(const Instance& instance, std::size_t most, Solution& solution) {
    solution = greedy(instance, most);
    std::size_t swaps = 0;
    while (swap_one(instance, solution)) ++swaps;
    drop_useless(instance, solution);
    return swaps;
}

ModeSet mode_set(const Instance& instance, const Solution& solution) {
    ModeSet set{.modes = {instance.mode(0)}, .cost = solution.total.aimed};
    for (const std::size_t one : solution.chosen) set.modes.push_back(instance.mode(one));
    std::ranges::sort(set.modes, {},
                      [](const Mode& mode) { return std::tuple(mode.cost, std::popcount(mode.features), mode.features); });
    return set;
}

/// Of the modes that serve the spectrum; its own is among them.
double least_cost(std::span<const Mode> modes, std::uint32_t spectrum) {
    double least = std::numeric_limits<double>::infinity();
    for (const Mode& mode : modes)
        if (serves(mode.features, spectrum)) least = std::min(least, mode.cost);
    return least;
}

/// Modes beside the full one.
std::size_t most_of(const ModeProblem& problem) { return std::max<std::size_t>(1, problem.modes) - 1; }

}  // namespace

double cost_of(const ModeProblem& problem, std::span<const std::uint32_t> features) {
    std::vector<Mode> modes{{problem.full, problem.cost(problem.full)}};
    for (const std::uint32_t one : features)
        if (std::ranges::count(modes, one, &Mode::features) == 0) modes.push_back({one, problem.cost(one)});
    double aimed = 0;
    for (const Scene& scene : problem.scenes) {
        double cost = problem.dispatch * double(modes.size());
        for (const auto& [spectrum, tiles] : scene.tiles) cost += double(tiles) * modes[choose(modes, spectrum)].cost;
        cost *= scene.weight;
        aimed = problem.aim == Aim::sum ? aimed + cost : std::max(aimed, cost);
    }
    return aimed;
}

double ideal_cost(const ModeProblem& problem) {
    std::vector<Mode> modes;
    for (const std::uint32_t one : candidates(problem)) modes.push_back({one, problem.cost(one)});
    double aimed = 0;
    for (const Scene& scene : problem.scenes) {
        double cost = 0;
        for (const auto& [spectrum, tiles] : scene.tiles) cost += scene.weight * double(tiles) * least_cost(modes, spectrum);
        aimed = problem.aim == Aim::sum ? aimed + cost : std::max(aimed, cost);
    }
    return aimed;
}

ModeSet greedy_modes(const ModeProblem& problem) {
    const Instance instance(problem);
    return mode_set(instance, greedy(instance, most_of(problem)));
}

ModeSet swapped_modes(const ModeProblem& problem) {
    const Instance instance(problem);
    Solution solution;
    const std::size_t swaps = search_locally(instance, most_of(problem), solution);
    ModeSet set = mode_set(instance, solution);
    set.swaps = swaps;
    return set;
}

ModeSet best_modes(const ModeProblem& problem) {
    const Instance instance(problem);
    Solution solution;
    const std::size_t swaps = search_locally(instance, most_of(problem), solution);
    const BranchAndBound search(instance, most_of(problem), std::move(solution));
    ModeSet set = mode_set(instance, search.best());
    set.swaps = swaps;
    set.proven = search.came_to_an_end();
    return set;
}

}  // namespace strata::lighting
