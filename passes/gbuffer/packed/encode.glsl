// Writes layout B of docs/algorithms/deferred.md 2.1, as pack.glsl packs it.
#include "passes/gbuffer/packed/pack.glsl"
#include "passes/gbuffer/targets.glsl"

void encode(MaterialPoint m) {
    const GBufferWords words = pack_packed(m);
    gbuffer0 = words.g0;
    gbuffer1 = words.g1;
}
