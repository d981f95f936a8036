// Which subsamples a fragment covers, in integers only: the same on every device and in the model, with no state anywhere.
// Alphas are fixed-point numbers of 24 bits.
#ifndef PASSES_TRANSPARENCY_STOCHASTIC_SUBSET_SHARED_H
#define PASSES_TRANSPARENCY_STOCHASTIC_SUBSET_SHARED_H
#include "passes/shaders/hash.shared.h"
#ifdef __cplusplus
namespace strata::transparency {
inline uint fragment_key(uint seed, uvec3 place, uint draw, uint triangle);
inline uint random_24_bits(uint key, uint number);
inline uint subset_size(uint key, uint alpha, uint subsamples);
inline bool is_selected(uint key, uint subsample, uint wanted, uint left);
#endif

// One number per fragment of a sample (x, y, sample). Pairs of triangles share one: the halves of a quad meet without a seam,
// and which of them a sample between them belongs to makes no difference.
uint fragment_key(uint seed, uvec3 place, uint draw, uint triangle) {
    return hashed(hashed(hashed(seed), place), uvec3(draw, triangle / 2u, 0u));
}

uint random_24_bits(uint key, uint number) { return hashed(key + number) >> 8u; }

// floor(alpha S + xi): how many subsamples a stratified subset has. 64 is the largest S, so the product fits.
uint subset_size(uint key, uint alpha, uint subsamples) { return (alpha * subsamples + random_24_bits(key, subsamples)) >> 24u; }

// Selection sampling (Knuth, algorithm 3.4.2 S): the next of `left` subsamples is one of the `wanted` with probability
// wanted / left, which makes every subset of that size equally likely.
bool is_selected(uint key, uint subsample, uint wanted, uint left) {
    return (((random_24_bits(key, subsample) >> 8u) * left) >> 16u) < wanted;
}

#ifdef __cplusplus
}  // namespace strata::transparency
#endif
#endif
