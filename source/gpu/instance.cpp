// Opening the Vulkan loader, and the validation layers.
#include "gpu/device_state.h"

#include <algorithm>
#include <cstring>

namespace strandlab {
namespace {

constexpr const char* validation_layer = "VK_LAYER_KHRONOS_validation";

// Debian 13's vulkan.hpp types the callback with its own enums; this C signature fits both through the cast.
VKAPI_ATTR VkBool32 VKAPI_CALL on_message(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                          VkDebugUtilsMessageTypeFlagsEXT,
                                          const VkDebugUtilsMessengerCallbackDataEXT* data, void* user) {
    auto* log = static_cast<MessageLog*>(user);
    const std::lock_guard lock(log->mutex);
    log->messages.emplace_back(data->pMessage);
    return VK_FALSE;
}

vk::DebugUtilsMessengerCreateInfoEXT messenger_info(MessageLog* log) {
    vk::DebugUtilsMessengerCreateInfoEXT info;
    info.messageSeverity =
        vk::DebugUtilsMessageSeverityFlagBitsEXT::eWarning | vk::DebugUtilsMessageSeverityFlagBitsEXT::eError;
    info.messageType = vk::DebugUtilsMessageTypeFlagBitsEXT::eValidation |
                       vk::DebugUtilsMessageTypeFlagBitsEXT::ePerformance;
    // Vulkan-Hpp 1.4 has its own callback type; by way of void (*)() a compiler accepts either.
    info.pfnUserCallback =
        reinterpret_cast<decltype(info.pfnUserCallback)>(reinterpret_cast<void (*)()>(&on_message));
    info.pUserData = log;
    return info;
}

void require_validation_layer(const vk::raii::Context& context) {
    const auto layers = context.enumerateInstanceLayerProperties();
    const bool found = std::any_of(layers.begin(), layers.end(), [](const vk::LayerProperties& layer) {
        return std::strcmp(layer.layerName, validation_layer) == 0;
    });
    if (!found)
        fail(ExitCode::no_device,
             "--validation: {} is not installed; run tools/setup (package vulkan-validationlayers)",
             validation_layer);
}

}  // namespace

InstanceState::InstanceState(bool validation) {
    const vk::ApplicationInfo application("strandlab", 1, "strandlab", 1, VK_API_VERSION_1_2);
    vk::InstanceCreateInfo info({}, &application);
    std::vector<const char*> layers, extensions;
    vk::DebugUtilsMessengerCreateInfoEXT messages = messenger_info(log.get());
    const vk::ValidationFeatureEnableEXT synchronization =
        vk::ValidationFeatureEnableEXT::eSynchronizationValidation;
    vk::ValidationFeaturesEXT features(synchronization);
    if (validation) {
        require_validation_layer(context);
        layers.push_back(validation_layer);
        extensions = {VK_EXT_DEBUG_UTILS_EXTENSION_NAME, VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME};
        messages.pNext = &features;
        info.pNext = &messages;
    }
    info.setPEnabledLayerNames(layers).setPEnabledExtensionNames(extensions);
    instance = vk::raii::Instance(context, info);
    if (validation) messenger = vk::raii::DebugUtilsMessengerEXT(instance, messenger_info(log.get()));
}

std::unique_ptr<InstanceState> make_instance(bool validation) {
    try {
        return std::make_unique<InstanceState>(validation);
    } catch (const Error&) {
        throw;
    } catch (const std::exception& error) {
        // No loader, or no driver at all.
        fail(
            ExitCode::no_device,
            "Vulkan cannot be opened ({}); install a driver, or Mesa's lavapipe for any machine: tools/setup "
            "(packages libvulkan1 and mesa-vulkan-drivers)",
            error.what());
    }
}

}  // namespace strandlab
