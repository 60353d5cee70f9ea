// The only way in which this folder includes Vulkan: Vulkan-Hpp with RAII handles and exceptions, the
// loader opened at run time.
#pragma once

#define VK_NO_PROTOTYPES
#define VULKAN_HPP_DISPATCH_LOADER_DYNAMIC 1
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wconversion"
#include <vulkan/vulkan_raii.hpp>
#pragma GCC diagnostic pop
