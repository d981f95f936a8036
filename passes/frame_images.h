// The images handed from stage to stage, and the scene's draw lists. Member names are the names that `--outputs`, models,
// truths and the report use; the table frame_image_names is the only list of them.
//
// Every image but those a raster step draws with several samples is an array with one layer per sample, so that one compute
// shader serves 1 and 4 samples: image2DArray, z = sample. `spread` and `gather` go between the two forms.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>

#include "passes/capability.h"
#include "passes/graph/step.h"
#include "passes/shadow_filter.h"

namespace strata {

class Features;    // capture_format/frame_features.h
class Graph;       // passes/graph/graph.h
class SceneFacts;  // passes/scene/scene_facts.h
struct Frame;      // capture_format/frame.h

struct FrameImages {
    // What is recorded.
    const Frame* recorded = nullptr;
    const Features* features = nullptr;
    const SceneFacts* facts = nullptr;  ///< derived from `recorded`: what declarations ask instead of walking the frame
    Extent extent;                      ///< of the view; depth 1
    std::uint32_t samples = 1;          ///< 1 or 4
    bool makes_unused = false;          ///< also products without a reader in view (passes/scene/readers.h)
    // What it is drawn on.
    Capabilities capabilities;

    // Draw lists of the scene, all triangles over the offered scene buffers (passes/shaders/scene.shared.h).
    DrawList all_opaque;   ///< opaque and masked draws, before culling
    DrawList opaque;       ///< after the culling stage
    DrawList casters;      ///< opaque and masked draws that cast shadows
    DrawList transparent;  ///< transparent draws in submission order, then emitters
    DrawList numbered;  ///< the same, where each triangle begins with a vertex of its own: for in_triangle (numbered_draw.vert)
    DrawList separate;  ///< the same, where triangles share no vertices: for vertex shaders that ask for the whole triangle
    DrawList back_to_front;  ///< the same, sorted by object; particles sorted within their emitter

    // culling
    Image visible;  ///< r32ui, 1024 wide: 1 where the opaque draw (y * 1024 + x of all_opaque) is drawn
    // shadows
    Image shadow_maps;           ///< d32f, maps in its layers (ShadowRecord of scene.shared.h), 0 nothing, 1 at the light
    ShadowFilter shadow_filter;  ///< how they are looked up: fixes the constants of passes/shaders/shadow_filter.glsl
    Image shadow_bounds;  ///< rg32f or rgba32f, layers as shadow_maps: bounds of blocks of texels; none unless a technique makes
                          ///< them
    Image visibility;     ///< r16f, layer = LightRecord::visibility_layer + sample: 1 lit, 0 shadowed
    // gbuffer
    Image depth;                         ///< d32f, `samples` samples: reversed, near / z
    Image depth_layers;                  ///< r32f array, layer = sample: the same depth for shaders to read
    Image gbuffer0, gbuffer1, gbuffer2;  ///< arrays, layer = sample; what is in them is the technique's (its decode.glsl)
    std::uint32_t gbuffer_layout = 0;    ///< the technique that wrote them and how (gbuffer/layout.shared.h)
    Image emission;  ///< rgba16f array: radiance of emissive and unlit surfaces; a is 1 on a surface, 0 on background
    // what the G-buffer holds, decoded; computed only when somebody asks for it (passes/gbuffer/surfaces.comp)
    Image surface_normal;    ///< rgba32f array: view-space normal xyz, view z (0: no surface)
    Image surface_color;     ///< rgba32f array: base color, roughness
    Image surface_material;  ///< rgba32f array: lighting model, metallic, occlusion, place (reference/place_code.h)
    // edges
    Image edges;  ///< r8ui: 1 where every sample of the pixel is shaded alone; none at 1 sample
    // occlusion, indirect
    Image occlusion;  ///< r16f array: ambient visibility; none when the stage is left out (1 everywhere)
    Image indirect;   ///< rgba16f array: irradiance / pi from the indirect stage; none when left out
    // lighting
    Image light;  ///< rgba16f array: radiance reflected from lights; none when left out
    // sun_shafts
    Image shafts;  ///< rgba16f: sunlight that the air before the surface scatters to the eye; none when left out
    // combine, transparency
    Image color;  ///< rgba32f array: linear radiance, per sample
    // lens
    Image exposure;  ///< r32f, one texel: what the recorded exposure is multiplied by; none where it does not adapt
    // film end
    Image display;  ///< rgba16f, one layer: resolved, exposed, tone mapped, linear display light
    // What indirect leaves to stages that light places without a surface of the G-buffer (passes/indirect/volume_light.glsl).
    Image volume_light;                 ///< rgba32f, in records: the grids of light volumes; none where there are none
    std::uint32_t light_grids = 0;      ///< in volume_light: fixes "light_grids"
    std::uint32_t light_grid_rule = 0;  ///< irradiance_* of passes/indirect/light_grid.shared.h: fixes "irradiance"
};

/// What an image's numbers are, and so how two of them are compared.
enum class Content : std::uint32_t {
    numbers,   ///< normals, factors, whatever else
    radiance,  ///< linear light of any brightness
    display,   ///< linear light from 0 to 1
    depth,
    coded,  ///< what is in it is the technique's own
};

/// A member of FrameImages by its name.
struct FrameImageRow {
    std::string_view name;
    Image FrameImages::*member;
    std::string_view help;  ///< what a texel is, for people
    Content content = Content::numbers;
    std::array<std::string_view, 3> channels = {};  ///< what the first three channels are, where they are no color
};
std::span<const FrameImageRow> frame_images();
/// Null when there is no such image.
const FrameImageRow* find_frame_image(std::string_view name);

/// Fixed as `sample_near` by shaders that read `sample` varyings: the near plane where these must be taken to the sample, else 0.
float sample_near(const FrameImages&);
/// Fixed as `tells_helpers` by shaders that include passes/shaders/helper_invocations.glsl.
std::uint32_t tells_helpers(const FrameImages&);

/// The samples of a multisampled image as layers: a copy in general, the image itself where it has one sample and is no
/// depth. Depth always becomes an r32f copy.
Image spread(Graph&, const Image& multisampled, std::string_view name);
/// The layers of an image as the samples of a multisampled one with the same format; at one sample the image itself.
Image gather(Graph&, const Image& layered, std::string_view name);

}  // namespace strata
