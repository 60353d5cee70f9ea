#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference2 : require
#extension GL_EXT_buffer_reference_uvec2 : require
// The styled points of one strand: what source/strands/hair_mesh/grow.cpp does, to the same bits.
#include "strands/growth.glsl"

uint nearest_clump(GrowthTables tables, GrowthFace face, uint face_id, vec2 root) {
    uint best = 0u;
    float least = uintBitsToFloat(0x7F800000u);
    for (uint i = 0u; i < tables.clumps; ++i) {
        float squared = squared_distance(root_of(tables, face, face_id, i), root);
        if (squared < least) {
            least = squared;
            best = i;
        }
    }
    return best;
}

float blended_w(GrowthTables tables, GrowthFace face, uint layer, vec4 weights) {
    uint count = tables.layers + 1u;
    Numbers w = Numbers(tables.w);
    precise float first = w.items[face.corners[0] * count + layer] * weights.x +
                          w.items[face.corners[1] * count + layer] * weights.y;
    precise float second = w.items[face.corners[2] * count + layer] * weights.z +
                           w.items[face.corners[3] * count + layer] * weights.w;
    precise float result = first + second;
    return result;
}

vec3 root_uv(GrowthTables tables, GrowthFace face, vec4 weights) {
    return blend(vec3(pair_at(tables.uv, face.corners[0]), 0.0), vec3(pair_at(tables.uv, face.corners[1]), 0.0),
                 vec3(pair_at(tables.uv, face.corners[2]), 0.0), vec3(pair_at(tables.uv, face.corners[3]), 0.0),
                 weights);
}

// One layer of the strand, of its clump's middle, and the directions below and above.
struct Layer {
    vec3 own[4];
    vec3 middle[4];
    vec3 u[2];
    vec3 v[2];
    float w[2];
};

void blend_layer(GrowthTables tables, GrowthFace face, uint index, vec4 weights, vec4 middle_weights, bool is_drawn,
                 out Layer layer) {
    uint controls = 3u * tables.layers + 1u;
    for (uint i = 0u; i < 4u; ++i) {
        layer.own[i] = blended(tables.controls, controls, 3u * index + i, face, weights);
        layer.middle[i] = layer.own[i];
        if (is_drawn) layer.middle[i] = blended(tables.controls, controls, 3u * index + i, face, middle_weights);
    }
    for (uint i = 0u; i < 2u; ++i) {
        layer.u[i] = blended(tables.u, tables.layers + 1u, index + i, face, weights);
        layer.v[i] = blended(tables.v, tables.layers + 1u, index + i, face, weights);
        layer.w[i] = blended_w(tables, face, index + i, weights);
    }
}

// What noise is between, made anew only where the strand enters the next cell.
struct Knots {
    bool is_known;
    int cell;
    vec4 below;
    vec4 above;
};

const Knots no_knots = Knots(false, 0, vec4(0.0), vec4(0.0));

// Noise that strands beside each other share, at a place along the hair; where it is across them.
vec2 shared_noise(inout Knots knots, StrandStyle style, StrandTraits traits, float w) {
    if (!(style.noise > 0.0)) return vec2(0.0);
    precise float across_u = traits.u * style.noise_across;
    precise float across_v = traits.v * style.noise_across;
    precise float z = w * style.noise_along;
    int cell = floor_of(z);
    if (!knots.is_known || cell != knots.cell) {
        knots.below = knots.is_known && cell == knots.cell + 1
                          ? knots.above : noise_plane(traits.noise_seed, across_u, across_v, cell);
        knots.above = noise_plane(traits.noise_seed, across_u, across_v, cell + 1);
    }
    knots.is_known = true;
    knots.cell = cell;
    precise float f = z - float(cell);
    return noise_between(knots.below, knots.above, f);
}

// Noise of the strand alone.
vec2 own_noise(inout Knots knots, StrandStyle style, StrandTraits traits, float w) {
    if (!(style.frizz > 0.0)) return vec2(0.0);
    precise float z = w * style.frizz_frequency;
    int cell = floor_of(z);
    if (!knots.is_known || cell != knots.cell) {
        knots.below = noise_knot(traits.frizz_seed, cell);
        knots.above = noise_knot(traits.frizz_seed, cell + 1);
    }
    knots.is_known = true;
    knots.cell = cell;
    precise float f = z - float(cell);
    return noise_between(knots.below, knots.above, f);
}

void main() {
    if (gl_GlobalInvocationID.x >= parameters.strand_count) return;
    uint strand = parameters.first_strand + gl_GlobalInvocationID.x;
    GrowthTables tables = TablesBuffer(parameters.tables).tables;
    StrandStyle style = StyleBuffer(tables.style).style;
    uint face_index = face_of(tables, strand);
    GrowthFace face = FaceBuffer(tables.faces).items[face_index];
    uint index = strand - face.first_strand;
    uint face_id = combine(tables.seed, face_index);
    bool is_triangle = face.is_triangle != 0u;
    vec2 root = root_of(tables, face, face_id, index);
    vec4 weights = corner_weights(root, is_triangle);
    uint clump = nearest_clump(tables, face, face_id, root);
    uint clump_id = combine(combine(face_id, 13u), clump);
    bool is_drawn = style.clump > 0.0;
    vec4 middle_weights = weights;
    if (is_drawn) middle_weights = corner_weights(root_of(tables, face, face_id, clump), is_triangle);
    vec3 uv = root_uv(tables, face, weights);
    float tip_w = blended_w(tables, face, tables.layers, weights);
    StrandTraits traits = strand_traits(style, tables.seed, combine(face_id, index), clump_id, uv.x, uv.y, tip_w);
    precise float range = traits.kept * float(tables.layers);

    Layer layer;
    uint known_layer = 0xFFFFFFFFu;
    Knots shared_knots = no_knots;
    Knots own_knots = no_knots;
    PointBuffer points = PointBuffer(parameters.points);
    for (uint k = 0u; k <= tables.pieces; ++k) {
        precise float part = float(k) * tables.point_step;
        float x = k == tables.pieces ? 1.0 : part;
        precise float place = range * x;
        uint at = min(uint(place), tables.layers - 1u);
        precise float s = place - float(at);
        if (at != known_layer) blend_layer(tables, face, at, weights, middle_weights, is_drawn, layer);
        known_layer = at;
        float w = between(layer.w[0], layer.w[1], s);
        vec2 offset = displacement(style, traits, w, shared_noise(shared_knots, style, traits, w),
                                   own_noise(own_knots, style, traits, w));
        float weight = is_drawn ? clump_weight(style, traits, w) : 0.0;
        vec3 own = cubic_point(layer.own[0], layer.own[1], layer.own[2], layer.own[3], s);
        vec3 middle = cubic_point(layer.middle[0], layer.middle[1], layer.middle[2], layer.middle[3], s);
        vec3 p = styled_point(own, middle, weight, offset, layer.u[0], layer.u[1], layer.v[0], layer.v[1], s);
        points.items[gl_GlobalInvocationID.x * (tables.pieces + 1u) + k] =
            vec4(p, between(face.root_radius, face.tip_radius, x));
    }
}
