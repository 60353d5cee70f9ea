// As many primitives' scenes on the device at a time as it holds.
#pragma once

#include "measure/bench_case.h"

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

namespace strandlab {

/// How much of a device the scenes of one group may take together.
struct GroupLimits {
    uint64_t bytes = 0;     // on the device; 0: not known, no limit
    size_t primitives = 0;  // at a time; 0: no limit
};
GroupLimits group_limits(const DeviceInfo& device, size_t primitives);

/// Hands out the primitives of a scene in groups whose structures fit the device together, so that their
/// traces can alternate. The baseline stays there throughout.
class SceneGroups {
  public:
    /// baseline: index into choices. waiting: indices of the choices to hand out, in that order.
    SceneGroups(const CaseInput& input, const std::vector<PrimitiveChoice>& choices, size_t baseline,
                std::vector<size_t> waiting, const GroupLimits& limits);

    /// The baseline's scene; nullptr where it does not fit even alone.
    const PreparedCase* baseline() const { return baseline_ ? &*baseline_ : nullptr; }

    /// The next group (the scenes of the last one are freed); empty when all have been handed out. A
    /// primitive that does not fit beside the baseline alone is left out, with a warning.
    std::vector<const PreparedCase*> next();

  private:
    std::optional<PreparedCase> prepare(HostGeometry geometry);
    bool fits(uint64_t bytes) const { return limits_.bytes == 0 || bytes <= limits_.bytes; }

    const CaseInput& input_;
    const std::vector<PrimitiveChoice>& choices_;
    size_t baseline_index_;
    std::deque<size_t> waiting_;
    GroupLimits limits_;
    std::optional<PreparedCase> baseline_;
    std::deque<PreparedCase> group_;
    std::optional<HostGeometry> pending_;  // of the first waiting one, which did not fit the last group
};

}  // namespace strandlab
