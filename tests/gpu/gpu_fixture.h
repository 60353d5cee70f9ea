// Tests on a device: skipped, saying so, where there is none; a validation message is a failure.
#pragma once

#include "base/error.h"
#include "gpu/device.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <optional>
#include <string>

namespace strandlab {

/// One device for all tests of a suite, opened as Kind::options() says and closed after them.
template <class Kind>
class DeviceTest : public testing::Test {
  protected:
    static void SetUpTestSuite() {
        if (device_ || !why_none_.empty()) return;
        DeviceOptions options = Kind::options();
        // STRANDLAB_NO_VALIDATION runs the tests on machines without the layers.
        options.validation = std::getenv("STRANDLAB_NO_VALIDATION") == nullptr;
        try {
            device_.emplace(options);
        } catch (const Error& error) {
            why_none_ = error.what();
        }
    }
    /// Not at the program's end: by then the validation layers may have destroyed what they need.
    static void TearDownTestSuite() { device_.reset(); }
    void SetUp() override {
        if (!device_) GTEST_SKIP() << why_none_;
    }
    void TearDown() override {
        if (!device_) return;
        for (const std::string& message : device_->validation_messages()) ADD_FAILURE() << message;
    }
    static const Device& device() { return *device_; }

  private:
    static inline std::optional<Device> device_;
    static inline std::string why_none_;
};

struct PlainDevice {
    static DeviceOptions options() { return {}; }
};
using GpuTest = DeviceTest<PlainDevice>;

/// What a test of a primitive may be called.
inline std::string test_name(std::string label) {
    for (char& c : label)
        if (c == ':' || c == '=') c = '_';
    return label;
}

}  // namespace strandlab
