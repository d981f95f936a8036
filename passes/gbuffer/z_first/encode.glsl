// Writes layout B' of docs/algorithms/deferred.md 2.1, as pack.glsl packs it.
#include "passes/gbuffer/z_first/pack.glsl"
#include "passes/gbuffer/targets.glsl"

void encode(MaterialPoint m) {
    const GBufferWords words = pack_z_first(m);
    gbuffer0 = words.g0;
    gbuffer1 = words.g1;
}
