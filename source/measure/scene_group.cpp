#include "measure/scene_group.h"

#include "base/log.h"

#include <algorithm>
#include <fstream>
#include <string>
#include <unistd.h>

namespace strandlab {
namespace {

/// Memory that the system could give, bytes; 0: not known.
uint64_t available_memory() {
    std::ifstream file("/proc/meminfo");
    for (std::string key, unit; file >> key;) {
        uint64_t value = 0;
        file >> value;
        std::getline(file, unit);
        if (key == "MemAvailable:") return value * 1024;
    }
    return 0;
}

}  // namespace

GroupLimits group_limits(const DeviceInfo& device, size_t primitives) {
    // A processor's memory holds models, references and the system as well.
    if (device.kind == "cpu") return {available_memory() / 2, primitives};
    return {device.memory / 10 * 8, primitives};
}

SceneGroups::SceneGroups(const CaseInput& input, const std::vector<PrimitiveChoice>& choices, size_t baseline,
                         std::vector<size_t> waiting, const GroupLimits& limits)
    : input_(input),
      choices_(choices),
      baseline_index_(baseline),
      waiting_(waiting.begin(), waiting.end()),
      limits_(limits) {
    if (!waiting_.empty()) baseline_ = prepare(make_geometry(input.built(), choices[baseline]));
}

std::optional<PreparedCase> SceneGroups::prepare(HostGeometry geometry) {
    try {
        return prepare_case(input_, std::move(geometry));
    } catch (const OutOfMemory&) {
        return std::nullopt;
    }
}

std::vector<const PreparedCase*> SceneGroups::next() {
    group_.clear();
    std::vector<const PreparedCase*> members;
    uint64_t resident = baseline_ ? baseline_->resident_bytes() : 0;
    while (!waiting_.empty() && (limits_.primitives == 0 || members.size() < limits_.primitives)) {
        const size_t index = waiting_.front();
        if (index == baseline_index_) {
            waiting_.pop_front();
            if (baseline_)
                members.push_back(&*baseline_);
            else
                warn("{}: {} does not fit the device and is left out", input_.scene.name,
                     choices_[index].label());
            continue;
        }
        HostGeometry geometry =
            pending_ ? std::move(*pending_) : make_geometry(input_.built(), choices_[index]);
        pending_.reset();
        if (!group_.empty() && !fits(resident + geometry.device_bytes())) {
            pending_ = std::move(geometry);
            break;
        }
        const uint64_t wanted = geometry.device_bytes();
        auto prepared = prepare(std::move(geometry));
        if (!prepared && !group_.empty()) break;  // once more, without the others
        waiting_.pop_front();
        if (!prepared) {
            warn("{}: {} (up to {} MB while it is built) does not fit the device and is left out",
                 input_.scene.name, choices_[index].label(), wanted / 1'000'000);
            continue;
        }
        resident += prepared->resident_bytes();
        group_.push_back(std::move(*prepared));
        members.push_back(&group_.back());
    }
    if (!waiting_.empty() && !members.empty() && limits_.primitives == 0)
        inform("{}: the device holds {} scenes at a time: their samples alternate in groups",
               input_.scene.name, members.size());
    return members;
}

}  // namespace strandlab
