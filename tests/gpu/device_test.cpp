// Choosing devices, and that the validation layers really listen.
#include "gpu/device_state.h"
#include "gpu_fixture.h"

namespace strandlab {
namespace {

using DeviceTest = GpuTest;

TEST_F(DeviceTest, AnUnknownDeviceIsNamedWithWhatThereIs) {
    try {
        const Device none({.selector = "no such device"});
        FAIL() << "opened";
    } catch (const Error& error) {
        EXPECT_EQ(error.code, ExitCode::no_device);
        EXPECT_NE(std::string(error.what()).find("--device no such device"), std::string::npos)
            << error.what();
        EXPECT_NE(std::string(error.what()).find(device().info().name), std::string::npos) << error.what();
    }
}

TEST_F(DeviceTest, IsListedAndOpensByPartOfItsName) {
    bool found = false;
    for (const DeviceInfo& info : list_devices()) found |= info.name == device().info().name;
    EXPECT_TRUE(found);
    EXPECT_EQ(Device({.selector = device().info().name.substr(0, 5)}).info().name, device().info().name);
}

TEST_F(DeviceTest, ValidationReportsAMistake) {
    if (!device().has_validation()) GTEST_SKIP() << "without the layers";
    const Device own({.selector = "", .validation = true});
    const vk::raii::Buffer bad(own.state().device,
                               vk::BufferCreateInfo({}, 0, vk::BufferUsageFlagBits::eStorageBuffer));
    EXPECT_FALSE(own.validation_messages().empty());
}

TEST_F(DeviceTest, BuffersReturnWhatWasUploaded) {
    std::vector<uint32_t> numbers(100'000);
    for (uint32_t i = 0; i < numbers.size(); ++i) numbers[i] = i * 2654435761u;
    const Buffer buffer = make_buffer(device(), std::span<const uint32_t>(numbers), Buffer::Use::storage);
    EXPECT_EQ(buffer.address() % 16, 0u);
    std::vector<uint32_t> back(numbers.size());
    buffer.download(std::as_writable_bytes(std::span(back)));
    EXPECT_EQ(back, numbers);
}

}  // namespace
}  // namespace strandlab
