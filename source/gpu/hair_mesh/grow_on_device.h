// Optional: strands of a hair mesh that grow on the device. Nothing uses it unless asked to
// (`generate --device`); grow_hair_mesh on the host is the reference.
#pragma once

#include "gpu/device.h"
#include "strands/curves.h"
#include "strands/hair_mesh/hair_mesh.h"

#include <cstdint>

namespace strandlab {

/// Curves that lie on the device and were never on the host.
struct DeviceCurves {
    Buffer records;  // Curve[]: 64 bytes each, strand after strand
    uint32_t strand_count = 0, curves_per_strand = 0;
    uint64_t table_bytes = 0;  // mesh, style and root samples: all that was uploaded
    double upload_ms = 0;      // host clock: making and uploading the tables
    double device_ms = 0;      // device clock: growing

    uint64_t curve_count() const { return uint64_t(strand_count) * curves_per_strand; }

    /// A copy on the host.
    Curves download() const;
};

/// The curves of grow_hair_mesh(mesh, parameters), written by compute shaders of the same text; points and
/// curves of some strands at a time, so that besides the curves themselves there are but 32 MiB and the
/// tables. To the same bits on devices that divide with correct rounding and keep `precise` (lavapipe; a test
/// compares every bit); elsewhere within the rounding of 1 / w at a strand's tip. Throws Error: usage as
/// make_recipe, OutOfMemory where the curves do not fit one allocation.
DeviceCurves grow_on_device(const Device& device, const HairMesh& mesh, const Parameters& parameters);

}  // namespace strandlab
