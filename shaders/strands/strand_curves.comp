#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference2 : require
#extension GL_EXT_buffer_reference_uvec2 : require
// One curve of a strand: through its styled points, or a layer of its unstyled blend.
#include "strands/growth.glsl"

// Curve k of those through every stride-th point of a strand whose first is `first`.
CurveRecord curve_through(uint first, uint stride, uint k, uint count) {
    PointBuffer points = PointBuffer(parameters.points);
    return curve_between(points.items[first + (k > 0u ? k - 1u : 0u) * stride], points.items[first + k * stride],
                         points.items[first + (k + 1u) * stride], points.items[first + min(k + 2u, count) * stride],
                         k == 0u, k + 1u == count);
}

vec4 layer_point(GrowthTables tables, GrowthFace face, vec4 weights, uint k) {
    uint last = 3u * tables.layers;
    precise float part = float(k) * tables.point_step;
    float x = k == last ? 1.0 : part;
    return vec4(blended(tables.controls, last + 1u, k, face, weights), between(face.root_radius, face.tip_radius, x));
}

CurveRecord layer_curve(GrowthTables tables, uint strand, uint layer) {
    uint face_index = face_of(tables, strand);
    GrowthFace face = FaceBuffer(tables.faces).items[face_index];
    vec2 root = root_of(tables, face, combine(tables.seed, face_index), strand - face.first_strand);
    vec4 weights = corner_weights(root, face.is_triangle != 0u);
    CurveRecord record;
    record.b0 = layer_point(tables, face, weights, 3u * layer);
    record.b1 = layer_point(tables, face, weights, 3u * layer + 1u);
    record.b2 = layer_point(tables, face, weights, 3u * layer + 2u);
    record.b3 = layer_point(tables, face, weights, 3u * layer + 3u);
    return record;
}

void main() {
    GrowthTables tables = TablesBuffer(parameters.tables).tables;
    if (gl_GlobalInvocationID.x >= parameters.strand_count * tables.pieces) return;
    uint strand = gl_GlobalInvocationID.x / tables.pieces;
    uint k = gl_GlobalInvocationID.x % tables.pieces;
    CurveRecord record;
    if (tables.is_styled == 0u) {
        record = layer_curve(tables, parameters.first_strand + strand, k);
    } else {
        uint first = strand * (tables.pieces + 1u);
        record = curve_through(first, 1u, k, tables.pieces);
        if (tables.morph > 0.0)
            record = morphed(record, curve_through(first, 2u, k / 2u, tables.pieces / 2u), k % 2u == 1u, tables.morph);
    }
    CurveBuffer(parameters.curves).items[gl_GlobalInvocationID.x] = record;
}
