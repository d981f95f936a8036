// Writes layout F of docs/algorithms/deferred.md 2.1, as pack.glsl packs it.
#include "passes/gbuffer/compact/pack.glsl"
#include "passes/gbuffer/targets.glsl"

void encode(MaterialPoint m) {
    const GBufferWords words = pack_compact(m);
    gbuffer0 = words.g0;
    gbuffer1 = words.g1;
}
