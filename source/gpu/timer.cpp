#include "gpu/timer.h"

namespace strandlab {

Timer::Timer(const DeviceState& state)
    : pool_(state.device, vk::QueryPoolCreateInfo({}, vk::QueryType::eTimestamp, 2)),
      period_(double(state.info.timestamp_period)),
      valid_bits_(state.physical.getQueueFamilyProperties()[state.queue_family].timestampValidBits) {}

void Timer::begin(const vk::raii::CommandBuffer& commands) const {
    commands.resetQueryPool(*pool_, 0, 2);
    commands.writeTimestamp(vk::PipelineStageFlagBits::eAllCommands, *pool_, 0);
}

void Timer::end(const vk::raii::CommandBuffer& commands) const {
    commands.writeTimestamp(vk::PipelineStageFlagBits::eAllCommands, *pool_, 1);
}

double Timer::milliseconds() const {
    const auto [result, ticks] =
        pool_.getResults<uint64_t>(0, 2, 2 * sizeof(uint64_t), sizeof(uint64_t),
                                   vk::QueryResultFlagBits::e64 | vk::QueryResultFlagBits::eWait);
    const uint64_t mask = valid_bits_ >= 64 ? ~uint64_t(0) : (uint64_t(1) << valid_bits_) - 1;
    return double((ticks[1] - ticks[0]) & mask) * period_ * 1e-6;
}

}  // namespace strandlab
