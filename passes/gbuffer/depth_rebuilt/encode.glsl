// Writes layout E of docs/algorithms/deferred.md 2.1, as pack.glsl packs it.
#include "passes/gbuffer/depth_rebuilt/pack.glsl"
#include "passes/gbuffer/targets.glsl"

layout(location = 3) out vec4 gbuffer2;

void encode(MaterialPoint m) {
    const GBufferWords words = pack_depth_rebuilt(m);
    gbuffer0 = words.g0;
    gbuffer1 = words.g1;
    gbuffer2 = words.g2;
}
