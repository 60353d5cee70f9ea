#include "trace/grown_model.h"

#include "base/error.h"
#include "gpu/compute_pipeline.h"
#include "gpu/embedded_shaders.h"
#include "shaders/strands/box_parameters.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace strandlab {
namespace {

constexpr uint32_t group_size = 64, longest_row = 32768;

/// How a primitive keeps curves.
struct RecordForm {
    uint32_t splits = 1;
    bool marks_ends = false;       // by the sign of their radii
    bool divides_turning = false;  // into more leaves than `splits`
    std::vector<Constant> constants;
};

/// One strand of two curves: a straight one, or one that turns by more than a right angle everywhere.
Curves test_strand(bool turning) {
    const auto curve = [](glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 d) {
        return Curve{glm::vec4(a, 0.1f), glm::vec4(b, 0.1f), glm::vec4(c, 0.1f), glm::vec4(d, 0.1f)};
    };
    if (turning)
        return {{curve({0, 0, 0}, {3, 0, 0}, {-2, 0, 0}, {1, 0, 0}),
                 curve({1, 0, 0}, {4, 0, 0}, {-1, 0, 0}, {2, 0, 0})},
                {{0, 2}}};
    return {{curve({0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}),
             curve({3, 0, 0}, {4, 0, 0}, {5, 0, 0}, {6, 0, 0})},
            {{0, 2}}};
}

RecordForm record_form(const PrimitiveChoice& choice) {
    const Curves strand = test_strand(false);
    const Geometry geometry = choice.primitive->build(strand, choice.options);
    const auto refuse = [&] {
        fail(ExitCode::usage,
             "{}: only primitives whose records are the curves grow on devices, such as rocaps and prhi",
             choice.label());
    };
    if (geometry.is_triangles() || geometry.leaf_records.stride != 0 ||
        geometry.shading_records.stride != 0 || geometry.curve_records.stride != sizeof(Curve) ||
        geometry.uniform_pieces == 0)
        refuse();
    std::vector<Curve> records(strand.curves.size());
    std::memcpy(records.data(), geometry.curve_records.bytes.data(), records.size() * sizeof(Curve));
    RecordForm form{geometry.uniform_pieces, std::signbit(records[0][0].w), false, geometry.constants};
    if (std::signbit(records[1][3].w) != form.marks_ends) refuse();
    for (Curve& record : records)
        for (glm::vec4& point : record) point.w = std::abs(point.w);
    if (records != strand.curves) refuse();
    const Geometry turning = choice.primitive->build(test_strand(true), choice.options);
    form.divides_turning = turning.leaf_count() > geometry.leaf_count();
    return form;
}

}  // namespace

GrownModel grown_model(const Device& device, DeviceCurves curves, const PrimitiveChoice& choice,
                       float ray_extent) {
    const RecordForm form = record_form(choice);
    const uint64_t leaves = curves.curve_count() * form.splits;
    GrownModel grown;
    grown.model.geometry.constants = form.constants;
    grown.model.geometry.uniform_pieces = form.splits;
    grown.model.on_device = std::make_shared<DeviceLeaves>();
    DeviceLeaves& there = *grown.model.on_device;
    there.count = leaves;
    there.boxes = Buffer(device, std::max<uint64_t>(1, leaves) * sizeof(Box), Buffer::Use::build_input);
    const std::vector<uint32_t> none(4, 0);
    const Buffer counter = make_buffer(device, std::span<const uint32_t>(none), Buffer::Use::storage);
    const layout::BoxParameters push{curves.records.address(),
                                     there.boxes.address(),
                                     counter.address(),
                                     static_cast<uint32_t>(curves.curve_count()),
                                     form.splits,
                                     std::max(1u, curves.curves_per_strand),
                                     form.marks_ends ? 1u : 0u,
                                     ray_extent,
                                     0};
    const ComputePipeline pipeline(device, embedded_shader("curve_boxes.comp"), {}, sizeof push);
    const uint32_t groups = (push.curve_count + group_size - 1) / group_size;
    const ComputePipeline::Dispatch dispatch{std::as_bytes(std::span(&push, 1)),
                                             std::min(std::max(1u, groups), longest_row),
                                             (groups + longest_row - 1) / longest_row};
    grown.boxes_ms = pipeline.run({&dispatch, 1});
    uint32_t turning = 0;
    counter.download(std::as_writable_bytes(std::span(&turning, 1)));
    if (turning > 0 && form.divides_turning)
        fail(ExitCode::usage,
             "{}: {} of {} leaves turn by more than a right angle, which only the host divides; ask for more "
             "points or "
             "splits",
             choice.label(), turning, leaves);
    there.curve_records = std::move(curves.records);
    return grown;
}

}  // namespace strandlab
