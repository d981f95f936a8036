// Normalized moments on [0, 1], so that 16 bits hold them: odd and even power moments through the transforms of Muenstermann et
// al. 2018 (docs/algorithms/transparency.md 4.3), and back through their inverses. Mind the order: here every transform is matrix
// times column.
#ifndef PASSES_TRANSPARENCY_MOMENTS_QUANTIZATION_GLSL
#define PASSES_TRANSPARENCY_MOMENTS_QUANTIZATION_GLSL
#include "passes/transparency/moments/warp.glsl"

// Written by rows: GLSL's constructors take columns.
mat2 rows(vec2 a, vec2 b) { return transpose(mat2(a, b)); }
mat3 rows(vec3 a, vec3 b, vec3 c) { return transpose(mat3(a, b, c)); }
mat4 rows(vec4 a, vec4 b, vec4 c, vec4 d) { return transpose(mat4(a, b, c, d)); }

const float even_offset6 = 0.018888946;
const vec4 even_offset8 = vec4(0.972481993925964, 1.0, 0.999179192513328, 0.991778293073131);

void split(float moments[8], out vec4 odd, out vec4 even) {
    odd = vec4(moments[0], moments[2], moments[4], moments[6]);
    even = vec4(moments[1], moments[3], moments[5], moments[7]);
}

void join(vec4 odd, vec4 even, out float moments[8]) {
    for (uint i = 0u; i < 4u; ++i) {
        moments[2u * i] = odd[i];
        moments[2u * i + 1u] = even[i];
    }
}

// In and out: odd and even ones in turns, as the moments themselves.
void quantize(inout float moments[8]) {
    vec4 odd, even;
    split(moments, odd, even);
    if (trigonometric) {
        odd = 0.5 * odd + 0.5;
        even = 0.5 * even + 0.5;
    } else if (roots == 2u) {
        odd.xy = rows(vec2(1.5, -2.0), vec2(0.866025403784439, -0.384900179459751)) * odd.xy + 0.5;
        even.xy = rows(vec2(4.0, -4.0), vec2(0.5, 0.5)) * even.xy;
    } else if (roots == 3u) {
        odd.xyz = rows(vec3(2.5, -10.0, 8.0), vec3(-1.8749986445, 4.20757543111, -1.83257678661),
                       vec3(1.26583039016, -1.47644882902, 0.71061660238)) * odd.xyz + 0.5;
        even.xyz = rows(vec3(4.0, -4.0, 0.0), vec3(9.0, -24.0, 16.0),
                        vec3(-0.57759806484, 4.61936647543, -3.07953906655)) * even.xyz;
        even.z += even_offset6;
    } else {
        odd = rows(vec4(3.48044635732474, -27.5760737514826, 55.1267384344761, -31.5311110403183),
                   vec4(1.26797185782836, -0.928755808743913, -2.07520453231032, 1.23598848322588),
                   vec4(-2.1671560004294, 6.17950199592966, -0.276515571579297, -4.23583042392097),
                   vec4(0.974332879165755, -0.443426830933027, -0.360491648368785, 0.310149466050223)) * odd + 0.5;
        even = rows(vec4(0.280504133158527, -0.757633844606942, 0.392179589334688, -0.887531871812237),
                    vec4(-2.01362265883247, 0.221551373038988, -1.06107954265125, 2.83887201588367),
                    vec4(-7.31010494985321, 13.9855979699139, -0.114305766176437, -7.4361899359832),
                    vec4(-15.8954215629556, 79.6186327084103, -127.457278992502, 63.7349456687829)) * even + even_offset8;
    }
    join(odd, even, moments);
}

void dequantize(inout float moments[8]) {
    vec4 odd, even;
    split(moments, odd, even);
    if (trigonometric) {
        odd = 2.0 * odd - 1.0;
        even = 2.0 * even - 1.0;
    } else if (roots == 2u) {
        odd.xy = rows(vec2(-0.333333333333333, 1.73205080756888), vec2(-0.75, 1.29903810567668)) * (odd.xy - 0.5);
        even.xy = rows(vec2(0.125, 1.0), vec2(-0.125, 1.0)) * even.xy;
    } else if (roots == 3u) {
        odd.xyz = rows(vec3(-0.0287778919197791, 0.476355504212326, 1.55242808971373),
                       vec3(0.0999523570602445, 0.845325809306934, 1.05472570759816),
                       vec3(0.258933537550237, 0.907796166567316, 0.833273356462154)) * (odd.xyz - 0.5);
        even.z -= even_offset6;
        even.xyz = rows(vec3(1.25304360764078e-05, 0.166684941860532, 0.866025405794346),
                        vec3(-0.249987469563924, 0.166684941860532, 0.866025405794346),
                        vec3(-0.374988252716178, 0.218767132994248, 0.8118988179322)) * even.xyz;
    } else {
        odd = rows(vec4(-0.00482399708502399, -0.423201508674234, 0.034831238260512, 1.67179208266593),
                   vec4(-0.0233402218644408, -0.832829097046478, 0.0193406040499625, 1.21021509068975),
                   vec4(-0.010888537031885, -0.926393772997063, -0.117233944147789, 0.983723301818275),
                   vec4(-0.0308713357806732, -0.937989172670244, -0.218033377677099, 0.845991731322995)) * (odd - 0.5);
        even = rows(vec4(-0.97622027889104, -0.456139260269401, -0.0504335521016744, 0.000838800390651067),
                    vec4(-1.048283417783, -0.229726640510149, 0.0259608334616091, -0.00133632693205862),
                    vec4(-1.03115268628604, -0.077844420809897, 0.00443408851014256, -0.0103744938457406),
                    vec4(-0.996038443434636, 0.0175438624416783, -0.0361414253243963, -0.00317839994022725)) * (even - even_offset8);
    }
    join(odd, even, moments);
}

#endif
