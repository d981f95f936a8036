// A plan whose shaders also mark what they read and write: of each image and buffer that a frame makes, how much is written, and
// how much of that anybody reads. One mechanism for all stages: techniques declare nothing for it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "capture_format/result.h"
#include "passes/graph/plan.h"

namespace strata {

/// An image or a buffer that steps of a plan write, counted in units: samples of texels, words of 4 bytes.
struct ProductUse {
    std::string name;
    bool is_image = false;
    std::uint32_t maker = 0;  ///< scope of the first step that writes it, in Plan::scopes
    std::uint64_t unit_bytes = 4;
    std::uint64_t units = 0;                  ///< that it has room for
    std::uint64_t made = 0;                   ///< written by a step; clears make nothing
    std::uint64_t read = 0;                   ///< of those made
    std::vector<std::uint32_t> readers = {};  ///< scopes that read what is made, in their order
    bool is_picture = false;                  ///< read by the host when the frame is done
    bool is_remembered = false;               ///< left to the next frame (Graph::remember)
    std::vector<std::size_t> writers = {};    ///< steps, by index in Plan::steps
};

/// Reads and writes of shaders are marked as they happen. Attachments are written and, where they are tested or blended, read all
/// over the area drawn; what is copied, and arguments and indices of draws, all over. Reading does not count for the technique
/// that makes a product in a step that also writes it: sums are no readers. Counters are no products.
class WatchedPlan {
public:
    /// Of a plan that is not from the memo. Fails where a shader cannot be watched.
    static Result<WatchedPlan> of(const Plan&);
    WatchedPlan(WatchedPlan&&) noexcept;
    WatchedPlan& operator=(WatchedPlan&&) noexcept;
    ~WatchedPlan();

    /// To be executed once `uploads` are imported.
    const Plan& plan() const;
    struct Upload {
        ImportId id;
        std::vector<std::byte> bytes;
    };
    std::span<const Upload> uploads() const;
    /// The buffer that the plan keeps for uses().
    Buffer marks() const;
    /// In the order in which they are first written. `marks` as the frame left them; nothing where no step of it marks.
    std::vector<ProductUse> uses(std::span<const std::byte> marks) const;

private:
    struct Parts;
    explicit WatchedPlan(std::unique_ptr<Parts>);
    std::unique_ptr<Parts> parts_;
};

}  // namespace strata
