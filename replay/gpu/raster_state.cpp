#include "replay/gpu/raster_state.h"

#include <algorithm>
#include <cassert>
#include <iterator>

#include "replay/gpu/format_table.h"

namespace strata {
namespace {

using Factor = vk::BlendFactor;
using Op = vk::BlendOp;

struct BlendRow {
    Blend blend;
    vk::Bool32 enabled;
    Factor source, color, alpha;  ///< of the source; of what is there, for color and for alpha
    Op op;
    Factor source_alpha = source;
};

constexpr BlendRow blend_rows[] = {
    {Blend::none, VK_FALSE, Factor::eOne, Factor::eZero, Factor::eZero, Op::eAdd},
    {Blend::add, VK_TRUE, Factor::eOne, Factor::eOne, Factor::eOne, Op::eAdd},
    {Blend::multiply, VK_TRUE, Factor::eZero, Factor::eSrcColor, Factor::eSrcAlpha, Op::eAdd},
    {Blend::dual_source_over, VK_TRUE, Factor::eOne, Factor::eSrc1Color, Factor::eSrc1Alpha, Op::eAdd},
    {Blend::max, VK_TRUE, Factor::eOne, Factor::eOne, Factor::eOne, Op::eMax},
    {Blend::min, VK_TRUE, Factor::eOne, Factor::eOne, Factor::eOne, Op::eMin},
    {Blend::alpha_over, VK_TRUE, Factor::eOne, Factor::eSrcAlpha, Factor::eOne, Op::eAdd, Factor::eZero},
};
static_assert(std::ranges::is_sorted(blend_rows, {}, &BlendRow::blend));

bool writes_outside(const PlannedStep& planned) {
    return std::ranges::any_of(planned.bindings,
                               [](const PlannedBinding& planned_binding) { return writes(planned_binding.binding.access); });
}

bool is_lone_opaque_color(const RasterState& state) {
    return state.colors.size() == 1 && state.depth == DepthUse::none && state.samples == 1 &&
           state.colors.front().blend == Blend::none;
}

}  // namespace

bool is_depth(const Attachment& attachment) {
    return attachment.access == Access::depth_tested || attachment.access == Access::depth_written;
}

RasterState raster_state(const PlannedStep& planned, const std::vector<ImageRecord>& images, bool on_llvmpipe) {
    const Step& step = planned.step;
    bool can_blend = true;
    RasterState state;
    for (const Attachment& attachment : step.attachments) {
        const Shape& shape = images[attachment.image.id].shape;
        state.samples = shape.samples;
        if (is_depth(attachment)) {
            state.depth = attachment.access == Access::depth_written ? DepthUse::test_and_write : DepthUse::test;
        } else {
            state.colors.push_back({device_format(shape.format), attachment.blend});
            can_blend &= row(shape.format).kind == FormatKind::real;
        }
    }
    if (const auto* draw = std::get_if<DrawWork>(&step.work)) {
        assert(!draw->at_equal_depth || state.depth == DepthUse::test);
        state.cull = draw->cull;
        state.alpha_to_coverage = draw->alpha_to_coverage;
        if (draw->at_equal_depth) state.depth = DepthUse::test_equal;
    }
    state.keeps_side_effects = on_llvmpipe && can_blend && is_lone_opaque_color(state) && writes_outside(planned);
    return state;
}

vk::PipelineColorBlendAttachmentState blend_state(const RasterState& state, Blend blend) {
    using Bit = vk::ColorComponentFlagBits;
    const BlendRow& row = blend_rows[static_cast<std::uint32_t>(blend)];
    const vk::Bool32 enabled = row.enabled || state.keeps_side_effects;
    return {enabled, row.source, row.color, row.op, row.source_alpha, row.alpha, row.op, Bit::eR | Bit::eG | Bit::eB | Bit::eA};
}

}  // namespace strata
