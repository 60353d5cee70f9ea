// A model that grew on the device, for a primitive on its curves: boxes are made there too, so that nothing
// but the mesh is ever uploaded.
#pragma once

#include "gpu/hair_mesh/grow_on_device.h"
#include "trace/gpu_scene.h"

namespace strandlab {

/// The model, and the device time of making its boxes.
struct GrownModel {
    SceneModel model;
    double boxes_ms = 0;
};

/// Takes curves that grew on the device for a primitive whose records are the curves themselves (rocaps,
/// prhi); found out by what it builds of two test strands. ray_extent: as SceneOptions. Throws Error (usage)
/// for other primitives, for options that need a table of leaves, and where the primitive would cut curves
/// that turn far into more leaves than its option says: only the host does that.
GrownModel grown_model(const Device& device, DeviceCurves curves, const PrimitiveChoice& choice,
                       float ray_extent);

}  // namespace strandlab
