#include "replay/gpu/access_table.h"

#include <algorithm>
#include <iterator>

namespace strata {
namespace {

using PipelineStage = vk::PipelineStageFlagBits2;
using Mask = vk::AccessFlagBits2;
using Layout = vk::ImageLayout;

struct AccessRow {
    Access access;
    DeviceAccess device;
};

// Reads name every shader stage: a plan puts no barrier between equal reads, whichever stages do them. The stages before
// rasterization have one name, because a device without geometry shaders must not be told theirs.
constexpr vk::PipelineStageFlags2 shaders =
    PipelineStage::ePreRasterizationShaders | PipelineStage::eFragmentShader | PipelineStage::eComputeShader;
constexpr vk::PipelineStageFlags2 depth_tests = PipelineStage::eEarlyFragmentTests | PipelineStage::eLateFragmentTests;

// `none` waits for everything: what touched the memory before is another run, or is not known.
constexpr AccessRow access_rows[] = {
    {Access::none, {PipelineStage::eAllCommands, Mask::eMemoryRead | Mask::eMemoryWrite, Layout::eUndefined}},
    {Access::sampled, {shaders, Mask::eShaderSampledRead, Layout::eShaderReadOnlyOptimal}},
    {Access::loaded, {shaders, Mask::eShaderStorageRead | Mask::eUniformRead, Layout::eGeneral}},
    {Access::stored, {shaders, Mask::eShaderStorageWrite, Layout::eGeneral}},
    {Access::updated, {shaders, Mask::eShaderStorageRead | Mask::eShaderStorageWrite, Layout::eGeneral}},
    {Access::color_written,
     {PipelineStage::eColorAttachmentOutput, Mask::eColorAttachmentRead | Mask::eColorAttachmentWrite,
      Layout::eColorAttachmentOptimal}},
    {Access::color_blended,
     {PipelineStage::eColorAttachmentOutput, Mask::eColorAttachmentRead | Mask::eColorAttachmentWrite,
      Layout::eColorAttachmentOptimal}},
    {Access::depth_tested, {depth_tests, Mask::eDepthStencilAttachmentRead, Layout::eDepthStencilReadOnlyOptimal}},
    {Access::depth_written,
     {depth_tests, Mask::eDepthStencilAttachmentRead | Mask::eDepthStencilAttachmentWrite,
      Layout::eDepthStencilAttachmentOptimal}},
    {Access::indirect, {PipelineStage::eDrawIndirect, Mask::eIndirectCommandRead, Layout::eUndefined}},
    {Access::indexed, {PipelineStage::eIndexInput, Mask::eIndexRead, Layout::eUndefined}},
    {Access::copied_from, {PipelineStage::eAllTransfer, Mask::eTransferRead, Layout::eTransferSrcOptimal}},
    {Access::copied_to, {PipelineStage::eAllTransfer, Mask::eTransferWrite, Layout::eTransferDstOptimal}},
};
static_assert(std::size(access_rows) == static_cast<std::size_t>(Access::copied_to) + 1);
static_assert(std::ranges::is_sorted(access_rows, {}, &AccessRow::access));

vk::ImageLayout layout_of(const AccessRow& row, FormatKind kind) {
    const bool is_sampled_depth = row.access == Access::sampled && kind == FormatKind::depth;
    return is_sampled_depth ? Layout::eDepthStencilReadOnlyOptimal : row.device.layout;
}

}  // namespace

DeviceAccess device_access(AccessSet set, FormatKind kind) {
    if (set.empty()) return access_rows[0].device;
    DeviceAccess all{{}, {}, Layout::eUndefined};
    for (const AccessRow& row : access_rows) {
        if (!set.has(row.access)) continue;
        all.stages |= row.device.stages;
        all.mask |= row.device.mask;
        const Layout layout = layout_of(row, kind);
        all.layout = all.layout == Layout::eUndefined || all.layout == layout ? layout : Layout::eGeneral;
    }
    return all;
}

}  // namespace strata
