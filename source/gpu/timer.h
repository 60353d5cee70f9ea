// GPU timestamps around parts of a command buffer.
#pragma once

#include "gpu/device_state.h"

namespace strandlab {

/// A pair of timestamps. Begin and end belong to the same command buffer; read after it has run.
class Timer {
  public:
    explicit Timer(const DeviceState& state);

    void begin(const vk::raii::CommandBuffer& commands) const;
    void end(const vk::raii::CommandBuffer& commands) const;
    /// Milliseconds between the two, in the ticks of the device.
    double milliseconds() const;

  private:
    vk::raii::QueryPool pool_;
    double period_;  // nanoseconds per tick
    uint32_t valid_bits_;
};

}  // namespace strandlab
